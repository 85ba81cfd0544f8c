// One level of Catmull-Clark, beside OpenMesh and CGAL. The error is the largest distance between the moved old
// vertices, whose order all three keep.
#include "tests/bench/bench.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>

#include <algorithm>

namespace bench
{
namespace
{

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

OpenMeshMesh openmesh_of(const mt_mesh *mesh)
{
    OpenMeshMesh built;
    std::vector<OpenMeshMesh::VertexHandle> handles;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(OpenMeshMesh::Point(p.x, p.y, p.z));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        handles.clear();
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            handles.emplace_back(static_cast<int>(mesh->corner_vertices[c]));
        }
        built.add_face(handles);
    }
    return built;
}

CgalMesh cgal_of(const mt_mesh *mesh)
{
    CgalMesh built;
    std::vector<CgalMesh::Vertex_index> corners;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(CgalMesh::Point(p.x, p.y, p.z));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        corners.clear();
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            corners.emplace_back(mesh->corner_vertices[c]);
        }
        built.add_face(corners);
    }
    return built;
}

void refine_openmesh(OpenMeshMesh &mesh)
{
    OpenMesh::Subdivider::Uniform::CatmullClarkT<OpenMeshMesh, double> subdivider;
    subdivider.attach(mesh);
    subdivider(1);
    subdivider.detach();
}

void refine_cgal(CgalMesh &mesh)
{
    CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
}

template <class Position> double largest_distance(const mt_mesh *refined, mt_index old_count, Position position)
{
    double largest = 0;
    for (mt_index v = 0; v < old_count; v++) {
        mt_vec3 p = mt_mesh_position(refined, v);
        auto q = position(v);
        largest = std::max({largest, std::abs(p.x - q[0]), std::abs(p.y - q[1]), std::abs(p.z - q[2])});
    }
    return largest;
}

void compare_on(std::uint64_t size)
{
    mt_context *context = shared_context();
    mt_mesh *mesh = wavy_torus(size, true, false), *refined = nullptr;
    require(context, mt_subdivide(context, mesh, nullptr, &refined));
    Row row;
    row.name = "Catmull-Clark, 1 level";
    row.mesh = "torus of quads";
    row.faces = mesh->face_count;
    row.note = "the peer's mesh is built beforehand";
    auto ours = [mesh](mt_context *with) {
        mt_mesh *result = nullptr;
        require(with, mt_subdivide(with, mesh, nullptr, &result));
        mt_mesh_destroy(with, result);
    };
    OpenMeshMesh openmesh = openmesh_of(mesh), openmesh_refined = openmesh;
    refine_openmesh(openmesh_refined);
    row.peer = "OpenMesh";
    row.error = largest_distance(refined, mesh->vertex_count, [&](mt_index v) {
        return openmesh_refined.point(OpenMeshMesh::VertexHandle(static_cast<int>(v)));
    });
    // A fresh copy each run: the copy is part of the peer's time, as the new mesh is of ours.
    compare(row, ours, [&openmesh] {
        OpenMeshMesh copy = openmesh;
        refine_openmesh(copy);
    });
    CgalMesh cgal = cgal_of(mesh), cgal_refined = cgal;
    refine_cgal(cgal_refined);
    row.peer = "CGAL";
    row.error = largest_distance(refined, mesh->vertex_count,
                                 [&](mt_index v) { return cgal_refined.point(CgalMesh::Vertex_index(v)); });
    compare(row, ours, [&cgal] {
        CgalMesh copy = cgal;
        refine_cgal(copy);
    });
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
}

} // namespace

void run_subdivision()
{
    for (std::uint64_t size : {2500, 25000, 250000}) {
        compare_on(size);
    }
}

} // namespace bench
