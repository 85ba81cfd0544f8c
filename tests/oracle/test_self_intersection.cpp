// The pairs of intersecting faces beside those that CGAL finds by testing all pairs with exact predicates under the
// same rules, and its does_self_intersect on clean meshes. CGAL's own self_intersections cannot hold soups, and reports
// collinear faces otherwise.
#include <meshtool/meshtool.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/intersections.h>

#include <cstdio>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Pairs = std::set<std::pair<mt_index, mt_index>>;

namespace
{

int passed = 0, failed = 0;

void judge(bool agrees, const std::string &what)
{
    agrees ? passed++ : failed++;
    if (!agrees) {
        std::printf("FAILED %s\n", what.c_str());
    }
}

struct Triangle {
    mt_index vertices[3];
    Point points[3];
    mt_index face;
};

bool joined(const Triangle &a, int i, const Triangle &b, int j)
{
    Kernel::Segment_3 opposite_a(a.points[(i + 1) % 3], a.points[(i + 2) % 3]);
    Kernel::Segment_3 opposite_b(b.points[(j + 1) % 3], b.points[(j + 2) % 3]);
    return CGAL::do_intersect(opposite_a, Kernel::Triangle_3(b.points[0], b.points[1], b.points[2])) ||
           CGAL::do_intersect(opposite_b, Kernel::Triangle_3(a.points[0], a.points[1], a.points[2]));
}

bool adjacent(const Triangle &a, int i, const Triangle &b, int j)
{
    const Point &p = a.points[(i + 1) % 3], &q = a.points[(i + 2) % 3];
    return CGAL::coplanar(p, q, a.points[i], b.points[j]) &&
           CGAL::coplanar_orientation(p, q, a.points[i], b.points[j]) == CGAL::POSITIVE;
}

bool intersect(const Triangle &a, const Triangle &b)
{
    std::vector<std::pair<int, int>> shared;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            if (a.vertices[i] == b.vertices[j]) {
                shared.emplace_back(i, j);
            }
        }
    }
    switch (shared.size()) {
    case 0:
        return CGAL::do_intersect(Kernel::Triangle_3(a.points[0], a.points[1], a.points[2]),
                                  Kernel::Triangle_3(b.points[0], b.points[1], b.points[2]));
    case 1:
        return joined(a, shared[0].first, b, shared[0].second);
    case 2:
        return adjacent(a, 3 - shared[0].first - shared[1].first, b, 3 - shared[0].second - shared[1].second);
    default:
        return false;
    }
}

std::vector<Triangle> triangles_of(mt_context *context, const mt_mesh *mesh)
{
    mt_triangulation triangulation;
    mt_triangulation_init(context, mesh, &triangulation);
    std::vector<Triangle> triangles;
    for (mt_index t = 0; t < triangulation.triangle_count; t++) {
        Triangle triangle;
        bool finite = true;
        for (mt_index side = 0; side < 3; side++) {
            mt_index v = mesh->corner_vertices[mt_triangulation_corner(&triangulation, t, side)];
            mt_vec3 p = mt_mesh_position(mesh, v);
            finite = finite && mt_vec3_is_finite(p);
            triangle.vertices[side] = v;
            triangle.points[side] = Point(p.x, p.y, p.z);
        }
        triangle.face = mt_triangulation_face(&triangulation, t);
        if (finite && !CGAL::collinear(triangle.points[0], triangle.points[1], triangle.points[2])) {
            triangles.push_back(triangle);
        }
    }
    mt_triangulation_release(context, &triangulation);
    return triangles;
}

bool boxes_apart(const Triangle &a, const Triangle &b)
{
    for (int axis = 0; axis < 3; axis++) {
        auto low = [axis](const Triangle &t) {
            return std::min({t.points[0][axis], t.points[1][axis], t.points[2][axis]});
        };
        auto high = [axis](const Triangle &t) {
            return std::max({t.points[0][axis], t.points[1][axis], t.points[2][axis]});
        };
        if (high(a) < low(b) || high(b) < low(a)) {
            return true;
        }
    }
    return false;
}

Pairs pairs_by_cgal(mt_context *context, const mt_mesh *mesh)
{
    Pairs pairs;
    std::vector<Triangle> triangles = triangles_of(context, mesh);
    for (std::size_t i = 0; i < triangles.size(); i++) {
        for (std::size_t j = i + 1; j < triangles.size(); j++) {
            const Triangle &a = triangles[i], &b = triangles[j];
            if (a.face != b.face && !boxes_apart(a, b) && intersect(a, b)) {
                pairs.insert(std::minmax(a.face, b.face));
            }
        }
    }
    return pairs;
}

Pairs pairs_by_us(mt_context *context, const mt_mesh *mesh)
{
    Pairs pairs;
    mt_self_intersections found;
    mt_find_self_intersections(context, mesh, nullptr, &found);
    for (std::uint64_t i = 0; i < found.pair_count; i++) {
        pairs.insert({found.pairs[i].a, found.pairs[i].b});
    }
    judge(pairs.size() == found.pair_count, "each pair once");
    mt_self_intersections_release(context, &found);
    return pairs;
}

mt_mesh *random_soup(mt_context *context, std::mt19937_64 &random, bool polygons)
{
    mt_mesh_layout layout{};
    layout.vertex_count = 10 + random() % 30;
    layout.face_count = 5 + random() % 40;
    layout.face_size = polygons ? 4 + mt_index(random() % 2) : 3;
    layout.position_type = MT_F64;
    mt_mesh *mesh = nullptr;
    mt_mesh_create(context, &layout, &mesh);
    std::uint64_t grid = 2 + random() % 9;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v,
                             mt_vec3_make(double(random() % grid), double(random() % grid), double(random() % 4)));
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mesh->corner_vertices[c] = mt_index(random() % mesh->vertex_count);
    }
    return mesh;
}

void move_and_scale(mt_mesh *mesh, double offset, double scale)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        mt_mesh_set_position(mesh, v, mt_vec3_scale(mt_vec3_add(p, mt_vec3_make(offset, -offset, offset)), scale));
    }
}

void test_soups(mt_context *context)
{
    std::mt19937_64 random(2024);
    std::size_t total = 0;
    for (int round = 0; round < 3000; round++) {
        mt_mesh *mesh = random_soup(context, random, round % 4 == 3);
        if (round % 3 == 1) {
            move_and_scale(mesh, 1e7, 1);
        } else if (round % 3 == 2) {
            move_and_scale(mesh, 0, round % 2 ? 1e30 : 1e-30);
        }
        Pairs ours = pairs_by_us(context, mesh), theirs = pairs_by_cgal(context, mesh);
        total += theirs.size();
        judge(ours == theirs, "soup " + std::to_string(round));
        mt_mesh_destroy(context, mesh);
    }
    std::printf("%zu pairs in 3000 soups\n", total);
}

std::vector<std::string> mesh_files()
{
    std::vector<std::string> files;
    for (const char *folder : {"meshes/valid", "meshes/non_manifold", "../shared/corpus"}) {
        if (!std::filesystem::is_directory(folder)) {
            std::printf("skipped %s: not here\n", folder);
            continue;
        }
        for (const auto &entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() != ".md") {
                files.push_back(entry.path().string());
            }
        }
    }
    return files;
}

// CGAL's answer for a whole mesh, where its structure holds all faces.
bool cgal_says(const std::vector<Triangle> &triangles, mt_index vertex_count, const mt_mesh *mesh, bool &answer)
{
    Surface surface;
    for (mt_index v = 0; v < vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        surface.add_vertex(Point(p.x, p.y, p.z));
    }
    for (const Triangle &t : triangles) {
        using Vertex = Surface::Vertex_index;
        auto face = surface.add_face(Vertex(t.vertices[0]), Vertex(t.vertices[1]), Vertex(t.vertices[2]));
        if (face == Surface::null_face()) {
            return false;
        }
    }
    answer = CGAL::Polygon_mesh_processing::does_self_intersect(surface);
    return true;
}

void test_file(mt_context *context, const std::string &path)
{
    mt_mesh *mesh = nullptr;
    if (mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr) != MT_OK) {
        judge(false, path + ": " + mt_context_error(context)->message);
        mt_context_clear_error(context);
        return;
    }
    Pairs ours = pairs_by_us(context, mesh);
    std::vector<Triangle> triangles = triangles_of(context, mesh);
    bool answer = false;
    if (triangles.size() < 8000) {
        judge(ours == pairs_by_cgal(context, mesh), path + ": all pairs");
    }
    bool is_triangles = mesh->face_size == 3;
    if (is_triangles && cgal_says(triangles, mesh->vertex_count, mesh, answer)) {
        judge(answer == !ours.empty(), path + ": does_self_intersect");
    } else {
        std::printf("%s: CGAL's structure cannot hold it; pairs alone compared\n", path.c_str());
    }
    std::printf("%s: %zu pairs\n", path.c_str(), ours.size());
    mt_mesh_destroy(context, mesh);
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    test_soups(context);
    for (const std::string &path : mesh_files()) {
        test_file(context, path);
    }
    mt_context_destroy(context);
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
