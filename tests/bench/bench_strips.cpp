// Strips, fast and thorough, beside meshoptimizer's stripify (after its vertex cache order for strips, which is timed
// with it, and in file order) and OpenMesh's StripifierT on its built mesh. All are counted by one rule: the indices of
// one buffer, with a restart between each two strips, over the triangles that are drawn. Triangles are lost when the
// strips draw fewer of them than the mesh has, orientation kept.
#include "tests/bench/bench.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Utils/StripifierT.hh>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

namespace bench
{
namespace
{

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using Triangle = std::array<unsigned, 3>;
using Strips = std::vector<std::vector<unsigned>>;

const char *const corpus[] = {"spot",           "cow",    "fandisk", "rocker-arm", "homer",
                              "stanford-bunny", "beetle", "suzanne", "teapot",     "woody"};
const std::uint64_t fewest_triangles = 300;

struct Length {
    double indices_per_triangle = 0;
    std::uint64_t lost = 0;
};

// One row of the table of lengths.
struct Lengths {
    std::string mesh;
    std::uint64_t triangles = 0;
    Length fast, thorough, cache_order, file_order, openmesh;
    double fast_seconds = 0, thorough_seconds = 0, cache_order_seconds = 0, openmesh_seconds = 0;
};

std::vector<unsigned> triangles_of(const mt_mesh *mesh)
{
    mt_triangulation triangulation{};
    require(shared_context(), mt_triangulation_init(shared_context(), mesh, &triangulation));
    std::vector<unsigned> vertices;
    for (mt_index t = 0; t < triangulation.triangle_count; t++) {
        for (mt_index side = 0; side < 3; side++) {
            vertices.push_back(mesh->corner_vertices[mt_triangulation_corner(&triangulation, t, side)]);
        }
    }
    mt_triangulation_release(shared_context(), &triangulation);
    return vertices;
}

void add_triangle(std::vector<Triangle> &list, unsigned a, unsigned b, unsigned c)
{
    if (a != b && b != c && c != a) {
        Triangle triangle{a, b, c};
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        list.push_back(triangle);
    }
}

std::vector<Triangle> drawn_by(const Strips &strips)
{
    std::vector<Triangle> list;
    for (const auto &strip : strips) {
        for (std::size_t i = 2; i < strip.size(); i++) {
            bool odd = i % 2;
            add_triangle(list, strip[odd ? i - 1 : i - 2], strip[odd ? i - 2 : i - 1], strip[i]);
        }
    }
    std::sort(list.begin(), list.end());
    return list;
}

Length measure(const std::vector<unsigned> &vertices, const Strips &strips)
{
    std::vector<Triangle> wanted, drawn = drawn_by(strips), lost;
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        add_triangle(wanted, vertices[i], vertices[i + 1], vertices[i + 2]);
    }
    std::sort(wanted.begin(), wanted.end());
    std::set_difference(wanted.begin(), wanted.end(), drawn.begin(), drawn.end(), std::back_inserter(lost));
    std::size_t indices = strips.size() - 1;
    for (const auto &strip : strips) {
        indices += strip.size();
    }
    return {double(indices) / double(wanted.size() - lost.size()), lost.size()};
}

Strips cut_at_restarts(const std::vector<unsigned> &buffer)
{
    Strips strips(1);
    for (unsigned index : buffer) {
        if (index == MT_STRIP_RESTART) {
            strips.emplace_back();
        } else {
            strips.back().push_back(index);
        }
    }
    return strips;
}

// ---- Ours and theirs ----

mt_strips *make_ours(mt_context *context, const mt_mesh *mesh, bool thorough)
{
    mt_strip_options options{};
    options.thorough = thorough;
    mt_strips *strips = nullptr;
    require(context, mt_strips_create(context, mesh, &options, &strips));
    return strips;
}

Ours run_ours(const mt_mesh *mesh, bool thorough)
{
    return [=](mt_context *context) { mt_strips_destroy(context, make_ours(context, mesh, thorough)); };
}

Length measure_ours(const mt_mesh *mesh, const std::vector<unsigned> &vertices, bool thorough)
{
    mt_strips *ours = make_ours(shared_context(), mesh, thorough);
    Strips strips;
    for (mt_index i = 0; i < ours->strip_count; i++) {
        strips.emplace_back(ours->indices + ours->offsets[i], ours->indices + ours->offsets[i + 1]);
    }
    mt_strips_destroy(shared_context(), ours);
    return measure(vertices, strips);
}

std::vector<unsigned> stripify(const std::vector<unsigned> &vertices, std::size_t vertex_count, bool order)
{
    std::vector<unsigned> ordered, buffer(meshopt_stripifyBound(vertices.size()));
    if (order) {
        ordered.resize(vertices.size());
        meshopt_optimizeVertexCacheStrip(ordered.data(), vertices.data(), vertices.size(), vertex_count);
    }
    const unsigned *from = order ? ordered.data() : vertices.data();
    buffer.resize(meshopt_stripify(buffer.data(), from, vertices.size(), vertex_count, MT_STRIP_RESTART));
    return buffer;
}

std::unique_ptr<OpenMeshMesh> build_openmesh(const mt_mesh *mesh, const std::vector<unsigned> &vertices)
{
    omerr().disable(); // it tells of each face that it refuses
    auto built = std::make_unique<OpenMeshMesh>();
    std::vector<OpenMeshMesh::VertexHandle> handles;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        handles.push_back(built->add_vertex(OpenMeshMesh::Point(0, 0, 0)));
    }
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        built->add_face(handles[vertices[i]], handles[vertices[i + 1]], handles[vertices[i + 2]]);
    }
    return built;
}

Strips strips_of_openmesh(OpenMeshMesh &mesh)
{
    OpenMesh::StripifierT<OpenMeshMesh> stripifier(mesh);
    stripifier.stripify();
    Strips strips;
    for (auto strip = stripifier.begin(); strip != stripifier.end(); ++strip) {
        strips.emplace_back(strip->begin(), strip->end());
    }
    return strips;
}

// ---- One mesh ----

std::string note(const Length &ours, const Length &theirs)
{
    char text[96];
    std::snprintf(text, sizeof text, "%.4f indices a triangle, theirs %.4f; %llu lost, theirs %llu",
                  ours.indices_per_triangle, theirs.indices_per_triangle, static_cast<unsigned long long>(ours.lost),
                  static_cast<unsigned long long>(theirs.lost));
    return text;
}

double best_peer(const Lengths &row)
{
    return std::min(
        {row.cache_order.indices_per_triangle, row.file_order.indices_per_triangle, row.openmesh.indices_per_triangle});
}

void time_on(Lengths &lengths, const mt_mesh *mesh, const std::vector<unsigned> &vertices, OpenMeshMesh &openmesh)
{
    Row row;
    row.mesh = lengths.mesh;
    row.faces = lengths.triangles;
    row.name = "strips fast, " + lengths.mesh;
    row.peer = "mo cache";
    row.note = note(lengths.fast, lengths.cache_order);
    compare(row, run_ours(mesh, false), [&] { stripify(vertices, mesh->vertex_count, true); });
    lengths.fast_seconds = rows().back().ours.seconds;
    lengths.cache_order_seconds = rows().back().theirs.seconds;
    row.peer = "mo file";
    row.note = note(lengths.fast, lengths.file_order);
    compare(row, run_ours(mesh, false), [&] { stripify(vertices, mesh->vertex_count, false); });
    row.peer = "OpenMesh";
    row.note = note(lengths.fast, lengths.openmesh);
    compare(row, run_ours(mesh, false), [&] { strips_of_openmesh(openmesh); });
    lengths.openmesh_seconds = rows().back().theirs.seconds;
    row.name = "strips thorough, " + lengths.mesh;
    row.note = note(lengths.thorough, lengths.openmesh);
    compare_once(row, run_ours(mesh, true), [&] { strips_of_openmesh(openmesh); });
    lengths.thorough_seconds = rows().back().ours.seconds;
}

// Empty where the mesh is too small to tell anything.
std::vector<Lengths> compare_on(const std::string &name, const mt_mesh *mesh)
{
    std::vector<unsigned> vertices = triangles_of(mesh);
    Lengths lengths;
    lengths.mesh = name;
    lengths.triangles = vertices.size() / 3;
    if (lengths.triangles < fewest_triangles) {
        return {};
    }
    auto openmesh = build_openmesh(mesh, vertices);
    lengths.fast = measure_ours(mesh, vertices, false);
    lengths.thorough = measure_ours(mesh, vertices, true);
    lengths.cache_order = measure(vertices, cut_at_restarts(stripify(vertices, mesh->vertex_count, true)));
    lengths.file_order = measure(vertices, cut_at_restarts(stripify(vertices, mesh->vertex_count, false)));
    lengths.openmesh = measure(vertices, strips_of_openmesh(*openmesh));
    time_on(lengths, mesh, vertices, *openmesh);
    return {lengths};
}

std::vector<Lengths> compare_file(const std::string &path)
{
    mt_mesh *mesh = nullptr;
    if (!std::filesystem::exists(path)) {
        std::printf("%-22s skipped: %s is not there\n", "strips", path.c_str());
        return {};
    }
    require(shared_context(), mt_mesh_read_file(shared_context(), path.c_str(), nullptr, &mesh, nullptr));
    std::string file = std::filesystem::path(path).filename();
    auto found = compare_on(path.rfind("meshes/", 0) == 0 ? file : file.substr(0, file.rfind('.')), mesh);
    mt_mesh_destroy(shared_context(), mesh);
    return found;
}

// ---- The table ----

std::string formatted(const char *format, double number)
{
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

void write_length(std::ostream &out, const Length &length)
{
    out << ' ' << formatted("%.4f", length.indices_per_triangle);
    if (length.lost) {
        out << " (" << length.lost << " lost)";
    }
    out << " |";
}

void write_lengths(std::ostream &out, const Lengths &row)
{
    out << "| " << row.mesh << " | " << row.triangles << " |";
    for (const Length *length : {&row.thorough, &row.fast, &row.cache_order, &row.file_order, &row.openmesh}) {
        write_length(out, *length);
    }
    out << ' ' << formatted("%.1f %%", 100 * (1 - row.thorough.indices_per_triangle / best_peer(row))) << " |";
    for (double seconds : {row.thorough_seconds, row.fast_seconds, row.cache_order_seconds, row.openmesh_seconds}) {
        out << ' ' << formatted(seconds < 0.1 ? "%.2f" : "%.0f", 1e3 * seconds) << " |";
    }
    out << '\n';
}

std::vector<Lengths> table;

} // namespace

void run_strips()
{
    std::vector<std::string> paths;
    for (const char *name : corpus) {
        paths.push_back("../shared/corpus/" + std::string(name) + ".obj");
    }
    std::vector<std::string> own;
    for (const auto &entry : std::filesystem::directory_iterator("meshes/valid")) {
        own.push_back("meshes/valid/" + entry.path().filename().string());
    }
    std::sort(own.begin(), own.end());
    paths.insert(paths.end(), own.begin(), own.end());
    for (const std::string &path : paths) {
        auto found = compare_file(path);
        table.insert(table.end(), found.begin(), found.end());
    }
}

void write_strips(const std::string &path)
{
    if (table.empty()) {
        return;
    }
    std::ofstream out(path);
    out << "| mesh | triangles | thorough | fast | meshoptimizer, its cache order | meshoptimizer, file order | "
           "OpenMesh "
           "| thorough under the best peer | ms thorough | ms fast | ms meshoptimizer, its cache order | ms OpenMesh "
           "|\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Lengths &row : table) {
        write_lengths(out, row);
    }
}

} // namespace bench
