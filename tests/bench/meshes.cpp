// Inputs made here, so that the table can be made anywhere.
#include "tests/bench/bench.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace bench
{
namespace
{

mt_vec3 torus_point(double u, double v)
{
    double a = 2 * MT_PI * u, b = 2 * MT_PI * v;
    double r = 0.4 + 0.05 * std::sin(7 * a) * std::cos(5 * b);
    double ring = 1 + r * std::cos(b);
    return mt_vec3_make(ring * std::cos(a), ring * std::sin(a), r * std::sin(b));
}

void fill_faces(mt_mesh *mesh, mt_index columns, mt_index rows, bool quads, const std::vector<mt_index> &order)
{
    mt_index *corner = mesh->corner_vertices;
    for (mt_index i = 0; i < columns; i++) {
        for (mt_index j = 0; j < rows; j++) {
            mt_index i1 = (i + 1) % columns, j1 = (j + 1) % rows;
            mt_index a = order[i * rows + j], b = order[i1 * rows + j], c = order[i1 * rows + j1],
                     d = order[i * rows + j1];
            const mt_index quad[] = {a, b, c, d}, triangles[] = {a, b, c, a, c, d};
            corner = quads ? std::copy(quad, quad + 4, corner) : std::copy(triangles, triangles + 6, corner);
        }
    }
}

void shuffle_faces(mt_mesh *mesh, std::mt19937 &random)
{
    std::vector<mt_index> order(mesh->face_count),
        old(mesh->corner_vertices, mesh->corner_vertices + mesh->corner_count);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        auto from = old.begin() + static_cast<std::ptrdiff_t>(order[face]) * mesh->face_size;
        std::copy(from, from + mesh->face_size, mesh->corner_vertices + std::size_t(face) * mesh->face_size);
    }
}

} // namespace

mt_mesh *wavy_torus(std::uint64_t faces, bool quads, bool shuffled)
{
    mt_index rows = static_cast<mt_index>(std::lround(std::sqrt(static_cast<double>(quads ? faces : faces / 2) / 2)));
    mt_index columns = 2 * rows;
    mt_mesh_layout layout{};
    layout.vertex_count = std::uint64_t(columns) * rows;
    layout.face_count = layout.vertex_count * (quads ? 1 : 2);
    layout.face_size = quads ? 4 : 3;
    layout.position_type = MT_F64;
    mt_mesh *mesh = nullptr;
    require(shared_context(), mt_mesh_create(shared_context(), &layout, &mesh));
    std::mt19937 random(12345);
    std::vector<mt_index> order(mesh->vertex_count);
    std::iota(order.begin(), order.end(), 0u);
    if (shuffled) {
        std::shuffle(order.begin(), order.end(), random);
    }
    for (mt_index i = 0; i < columns; i++) {
        for (mt_index j = 0; j < rows; j++) {
            mt_mesh_set_position(mesh, order[i * rows + j], torus_point(double(i) / columns, double(j) / rows));
        }
    }
    fill_faces(mesh, columns, rows, quads, order);
    if (shuffled) {
        shuffle_faces(mesh, random);
    }
    return mesh;
}

} // namespace bench
