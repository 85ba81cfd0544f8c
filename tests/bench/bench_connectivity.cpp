// Edge pairing and half-edges from an indexed array, beside the add_face loops of OpenMesh and CGAL.
#include "tests/bench/bench.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace bench
{
namespace
{

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

void build_ours(mt_context *context, const mt_mesh *mesh)
{
    mt_halfedge_mesh *structure = nullptr;
    require(context, mt_halfedge_create(context, mesh, &structure));
    mt_halfedge_destroy(context, structure);
}

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

void compare_on(std::uint64_t size, bool shuffled)
{
    mt_mesh *mesh = wavy_torus(size, false, shuffled);
    Row row;
    row.name = "half-edges";
    row.mesh = shuffled ? "torus shuffled" : "torus";
    row.faces = mesh->face_count;
    row.peer = "OpenMesh";
    auto ours = [mesh](mt_context *context) { build_ours(context, mesh); };
    compare(row, ours, [mesh] { build_openmesh(mesh); });
    row.peer = "CGAL";
    compare(row, ours, [mesh] { build_cgal(mesh); });
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_connectivity()
{
    for (std::uint64_t size : sizes) {
        compare_on(size, false);
    }
    compare_on(1000000, true);
}

} // namespace bench
