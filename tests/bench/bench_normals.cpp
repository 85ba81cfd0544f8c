// Vertex normals by area from the indexed mesh, with nothing prebuilt and the result allocated, beside those of peers
// on meshes that they have built before the clock runs: a hand-written area-weighted loop over OpenMesh's faces, its
// update_normals and CGAL's compute_vertex_normals, whose weights are others; and beside a copy of as many bytes as are
// read and written, whose ratio is our share of what the memory can do.
#include "tests/bench/bench.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace bench
{
namespace
{

struct Doubles : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<Doubles>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

template <typename Mesh> std::unique_ptr<Mesh> build_openmesh(const mt_mesh *mesh)
{
    auto built = std::make_unique<Mesh>();
    built->reserve(mesh->vertex_count, mesh->corner_count / 2, mesh->face_count);
    std::vector<typename Mesh::VertexHandle> handles(mesh->vertex_count);
    using Scalar = typename Mesh::Scalar;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        handles[v] = built->add_vertex(typename Mesh::Point(Scalar(p.x), Scalar(p.y), Scalar(p.z)));
    }
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        built->add_face(handles[corner[0]], handles[corner[1]], handles[corner[2]]);
    }
    built->request_face_normals();
    built->request_vertex_normals();
    return built;
}

CgalMesh build_cgal(const mt_mesh *mesh)
{
    CgalMesh built;
    built.reserve(mesh->vertex_count, mesh->corner_count / 2, mesh->face_count);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex({p.x, p.y, p.z});
    }
    using Vertex = CgalMesh::Vertex_index;
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        built.add_face(Vertex(corner[0]), Vertex(corner[1]), Vertex(corner[2]));
    }
    return built;
}

template <typename Mesh> void area_weighted_loop(Mesh &mesh)
{
    typename Mesh::Normal zero(0, 0, 0);
    for (auto vertex : mesh.vertices()) {
        mesh.set_normal(vertex, zero);
    }
    for (auto face : mesh.faces()) {
        auto h = mesh.halfedge_handle(face);
        auto a = mesh.to_vertex_handle(h);
        h = mesh.next_halfedge_handle(h);
        auto b = mesh.to_vertex_handle(h);
        auto c = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
        auto n = (mesh.point(b) - mesh.point(a)) % (mesh.point(c) - mesh.point(a));
        mesh.set_normal(a, mesh.normal(a) + n);
        mesh.set_normal(b, mesh.normal(b) + n);
        mesh.set_normal(c, mesh.normal(c) + n);
    }
    for (auto vertex : mesh.vertices()) {
        mesh.set_normal(vertex, mesh.normal(vertex).normalized());
    }
}

void add_normals(mt_context *context, mt_mesh *mesh)
{
    require(context, mt_mesh_add_normals(context, mesh, nullptr, nullptr));
    mt_mesh_remove_attribute(context, mesh, mesh->attribute_count - 1);
}

template <typename Mesh> double largest_difference(mt_mesh *mesh, const Mesh &theirs)
{
    require(shared_context(), mt_mesh_add_normals(shared_context(), mesh, nullptr, nullptr));
    const mt_attribute *normals = &mesh->attributes[mesh->attribute_count - 1];
    double largest = 0;
    for (auto vertex : theirs.vertices()) {
        for (unsigned axis = 0; axis < 3; axis++) {
            double ours = mt_attribute_get(normals, mt_index(vertex.idx()), axis);
            largest = std::max(largest, std::abs(ours - double(theirs.normal(vertex)[axis])));
        }
    }
    mt_mesh_remove_attribute(shared_context(), mesh, mesh->attribute_count - 1);
    return largest;
}

template <typename Mesh> void compare_openmesh(Row row, mt_mesh *mesh)
{
    auto theirs = build_openmesh<Mesh>(mesh);
    auto ours = [&](mt_context *context) { add_normals(context, mesh); };
    row.peer = "OM loop";
    area_weighted_loop(*theirs);
    row.error = largest_difference(mesh, *theirs);
    compare(row, ours, [&] { area_weighted_loop(*theirs); });
    row.peer = "OM update";
    row.error = -1;
    row.note = "not area-weighted";
    compare(row, ours, [&] { theirs->update_normals(); });
}

void compare_cgal(Row row, mt_mesh *mesh)
{
    CgalMesh theirs = build_cgal(mesh);
    auto normals = theirs.add_property_map<CgalMesh::Vertex_index, Kernel::Vector_3>("v:normal").first;
    row.peer = "CGAL";
    row.note = "not area-weighted";
    compare(
        row, [&](mt_context *context) { add_normals(context, mesh); },
        [&] { CGAL::Polygon_mesh_processing::compute_vertex_normals(theirs, normals); });
}

void compare_copy(Row row, mt_mesh *mesh)
{
    std::size_t reals = 6 * std::size_t(mesh->vertex_count) * mt_type_size(mesh->position_type);
    std::size_t half = (reals + 4 * std::size_t(mesh->corner_count)) / 2; // as much is written as read
    std::vector<char> from(half, 1), to(half, 2);
    row.peer = "memcpy";
    row.note = "the ratio is the share of the copy's bandwidth";
    compare(
        row, [&](mt_context *context) { add_normals(context, mesh); },
        [&] { std::memcpy(to.data(), from.data(), half); });
}

void compare_on(const char *name, mt_mesh *mesh, mt_type type)
{
    require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, type, nullptr));
    Row row;
    row.name = std::string("vertex normals ") + (type == MT_F64 ? "f64" : "f32") + name;
    row.mesh = *name ? name + 2 : "torus";
    row.faces = mesh->face_count;
    if (type == MT_F64) {
        compare_openmesh<DoubleMesh>(row, mesh);
        compare_cgal(row, mesh);
    } else {
        compare_openmesh<FloatMesh>(row, mesh);
    }
    compare_copy(row, mesh);
}

// In the order in which subdivision leaves a model: new vertices lie far from the old ones. Null where it is not there.
mt_mesh *subdivided_bunny()
{
    const char *path = "../shared/corpus/stanford-bunny.obj";
    mt_mesh *mesh = nullptr, *fine = nullptr;
    if (!std::filesystem::exists(path)) {
        std::printf("%-22s skipped: %s is not there\n", "vertex normals", path);
        return nullptr;
    }
    require(shared_context(), mt_mesh_read_file(shared_context(), path, nullptr, &mesh, nullptr));
    mt_subdivide_options options{};
    options.level_count = 2;
    options.scheme = MT_SUBDIVIDE_SCHEME_LOOP;
    require(shared_context(), mt_subdivide(shared_context(), mesh, &options, &fine));
    mt_mesh_destroy(shared_context(), mesh);
    return fine;
}

// f64 first: rounding once to f32 loses nothing then.
void compare_both(const char *name, mt_mesh *mesh)
{
    compare_on(name, mesh, MT_F64);
    compare_on(name, mesh, MT_F32);
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_normals()
{
    compare_both("", wavy_torus(1000000, false, false));
    compare_both(", shuffled", wavy_torus(1000000, false, true));
    if (mt_mesh *bunny = subdivided_bunny()) {
        compare_both(", bunny", bunny);
    }
}

} // namespace bench
