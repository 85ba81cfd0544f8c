// Self-intersection of a clean mesh, beside CGAL's does_self_intersect with exact predicates.
#include "tests/bench/bench.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstdlib>

namespace bench
{
namespace
{

using CgalMesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

void search_ours(mt_context *context, const mt_mesh *mesh)
{
    mt_self_intersections found;
    require(context, mt_find_self_intersections(context, mesh, nullptr, &found));
    if (found.pair_count) {
        std::fprintf(stderr, "bench: the torus intersects itself\n");
        std::exit(1);
    }
    mt_self_intersections_release(context, &found);
}

CgalMesh cgal_of(const mt_mesh *mesh)
{
    CgalMesh built;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(CgalMesh::Point(p.x, p.y, p.z));
    }
    using Vertex = CgalMesh::Vertex_index;
    const mt_index *corner = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++, corner += 3) {
        built.add_face(Vertex(corner[0]), Vertex(corner[1]), Vertex(corner[2]));
    }
    return built;
}

void compare_on(std::uint64_t size)
{
    mt_mesh *mesh = wavy_torus(size, false, false);
    CgalMesh cgal = cgal_of(mesh);
    double differs = 0;
    Row row;
    row.name = "self-intersection";
    row.mesh = "torus, clean";
    row.faces = mesh->face_count;
    row.peer = "CGAL";
    row.verdict = &differs;
    row.note = "verdicts that differ";
    compare(
        row, [mesh](mt_context *context) { search_ours(context, mesh); },
        [&cgal, &differs] { differs = CGAL::Polygon_mesh_processing::does_self_intersect(cgal) ? 1 : 0; });
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_self_intersection()
{
    for (std::uint64_t size : sizes) {
        compare_on(size);
    }
    compare_on(large_size);
}

} // namespace bench
