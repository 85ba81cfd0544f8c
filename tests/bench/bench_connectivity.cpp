// Each connectivity structure from an indexed array, beside the add_face loops of OpenMesh and CGAL.
#include "tests/bench/bench.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstdio>

namespace bench
{
namespace
{

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

// A structure of ours: builds and drops it, and returns the bytes that it held.
struct Builder {
    const char *name;
    std::uint64_t (*build)(mt_context *, const mt_mesh *);
};

template <typename Structure, auto create, auto size, auto destroy>
std::uint64_t build(mt_context *context, const mt_mesh *mesh)
{
    Structure *structure = nullptr;
    require(context, create(context, mesh, &structure));
    std::uint64_t bytes = size(structure);
    destroy(context, structure);
    return bytes;
}

const Builder builders[] = {
    {"half-edges", build<mt_halfedge_mesh, mt_halfedge_create, mt_halfedge_size, mt_halfedge_destroy>},
    {"winged edges", build<mt_winged_edge_mesh, mt_winged_edge_create, mt_winged_edge_size, mt_winged_edge_destroy>},
    {"triangle neighbours", build<mt_triangle_neighbor_mesh, mt_triangle_neighbor_create, mt_triangle_neighbor_size,
                                  mt_triangle_neighbor_destroy>},
};

void build_openmesh(const mt_mesh *mesh)
{
    OpenMeshMesh built;
    built.reserve(mesh->vertex_count, mesh->corner_count / 2, mesh->face_count);
    std::vector<OpenMeshMesh::VertexHandle> handles(mesh->vertex_count);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        handles[v] = built.add_vertex(OpenMeshMesh::Point(float(p.x), float(p.y), float(p.z)));
    }
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        built.add_face(handles[corner[0]], handles[corner[1]], handles[corner[2]]);
    }
}

void build_cgal(const mt_mesh *mesh)
{
    CgalMesh built;
    built.reserve(mesh->vertex_count, mesh->corner_count / 2, mesh->face_count);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(CgalMesh::Point(p.x, p.y, p.z));
    }
    using Vertex = CgalMesh::Vertex_index;
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        built.add_face(Vertex(corner[0]), Vertex(corner[1]), Vertex(corner[2]));
    }
}

std::string bytes_note(std::uint64_t bytes, const mt_mesh *mesh)
{
    char text[64];
    std::snprintf(text, sizeof text, "holds %.1f bytes a triangle", double(bytes) / mesh->face_count);
    return text;
}

void compare_on(std::uint64_t size, bool shuffled, bool with_cgal)
{
    mt_mesh *mesh = wavy_torus(size, false, shuffled);
    for (const Builder &builder : builders) {
        Row row;
        row.name = builder.name;
        row.mesh = shuffled ? "torus shuffled" : "torus";
        row.faces = mesh->face_count;
        row.note = bytes_note(builder.build(shared_context(), mesh), mesh);
        auto ours = [mesh, &builder](mt_context *context) { builder.build(context, mesh); };
        row.peer = "OpenMesh";
        compare(row, ours, [mesh] { build_openmesh(mesh); });
        if (with_cgal) {
            row.peer = "CGAL";
            compare(row, ours, [mesh] { build_cgal(mesh); });
        }
    }
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_connectivity()
{
    for (std::uint64_t size : sizes) {
        compare_on(size, false, true);
    }
    compare_on(5000000, false, false);
    compare_on(1000000, true, true);
}

} // namespace bench
