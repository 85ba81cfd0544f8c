// check-manifold, beside CGAL's check of a polygon soup and admesh's exact facet check. Both look at less.
#include "tests/bench/bench.hpp"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <admesh/stl.h>

#include <cstdlib>

namespace bench
{
namespace
{

std::vector<std::vector<std::size_t>> soup_of(const mt_mesh *mesh)
{
    std::vector<std::vector<std::size_t>> soup(mesh->face_count);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        soup[face].assign(mesh->corner_vertices + mt_mesh_face_begin(mesh, face),
                          mesh->corner_vertices + mt_mesh_face_end(mesh, face));
    }
    return soup;
}

void check_with(mt_context *context, const mt_mesh *mesh, const mt_manifold_options &options)
{
    mt_manifold_report report;
    require(context, mt_check_manifold(context, mesh, &options, &report));
    if (report.manifold_class != MT_MANIFOLD) {
        std::fprintf(stderr, "bench: the torus is not manifold\n");
        std::exit(1);
    }
    mt_manifold_report_release(context, &report);
}

void check_ours(mt_context *context, const mt_mesh *mesh)
{
    check_with(context, mesh, {});
}

// The command line asks for this too: here no vertices coincide, which is what has to be found out.
void check_as_welded(mt_context *context, const mt_mesh *mesh)
{
    mt_manifold_options options{};
    options.as_welded = true;
    check_with(context, mesh, options);
}

// admesh works on facets with float corners; its loading is not measured.
void fill_stl(stl_file *stl, const mt_mesh *mesh)
{
    stl_initialize(stl);
    stl->stats.type = inmemory;
    stl->stats.number_of_facets = static_cast<int>(mesh->face_count);
    stl->stats.original_num_facets = stl->stats.number_of_facets;
    stl_allocate(stl);
    bool first = true;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        stl_facet facet{};
        for (int side = 0; side < 3; side++) {
            mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[3 * std::size_t(face) + std::size_t(side)]);
            facet.vertex[side] = {float(p.x), float(p.y), float(p.z)};
        }
        stl->facet_start[face] = facet;
        stl_facet_stats(stl, facet, first);
        first = false;
    }
    stl->stats.size.x = stl->stats.max.x - stl->stats.min.x;
    stl->stats.size.y = stl->stats.max.y - stl->stats.min.y;
    stl->stats.size.z = stl->stats.max.z - stl->stats.min.z;
    stl->stats.shortest_edge = 0;
}

void compare_on(std::uint64_t size)
{
    mt_mesh *mesh = wavy_torus(size, false, false);
    Row row;
    row.name = "check-manifold";
    row.mesh = "torus";
    row.faces = mesh->face_count;
    auto ours = [mesh](mt_context *context) { check_ours(context, mesh); };
    auto soup = soup_of(mesh);
    row.peer = "CGAL";
    double differs = 0;
    row.verdict = &differs;
    row.note = "verdicts that differ";
    compare(row, ours, [&soup, &differs] {
        differs = CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(soup) ? 0 : 1;
    });
    row.name = "check-manifold and as welded";
    compare(
        row, [mesh](mt_context *context) { check_as_welded(context, mesh); },
        [&soup] { CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(soup); });
    soup = {};
    row.name = "check-manifold";
    stl_file stl;
    fill_stl(&stl, mesh);
    row.peer = "admesh";
    row.verdict = nullptr;
    row.note = "edges matched bit by bit; nothing else";
    compare(row, ours, [&stl] { stl_check_facets_exact(&stl); });
    stl_close(&stl);
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_check()
{
    for (std::uint64_t size : sizes) {
        compare_on(size);
    }
    compare_on(large_size);
}

} // namespace bench
