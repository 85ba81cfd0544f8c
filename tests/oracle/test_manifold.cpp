// The manifold check beside CGAL: verdict and orientability of every mesh and of random soups, and on what CGAL's
// half-edges can hold also the counts, boundary loops, components, area and volume. Soups whose faces name a vertex
// twice are skipped where CGAL forbids them.
#include "tests/oracle/mesh_files.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <random>

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

namespace
{

Tally tally;

std::vector<Point> points_of(const mt_mesh *mesh)
{
    std::vector<Point> points;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        points.emplace_back(p.x, p.y, p.z);
    }
    return points;
}

std::size_t count_components(Surface &surface)
{
    auto map = surface.add_property_map<Surface::Face_index, std::size_t>("f:component", 0).first;
    return PMP::connected_components(surface, map);
}

bool near(double ours, double theirs, double size)
{
    return std::abs(ours - theirs) <= 1e-10 * size;
}

void compare_measures(const mt_manifold_report &report, const Surface &surface, const std::string &name)
{
    double area = PMP::area(surface);
    tally.expect(near(report.area, area, area), name + ": area");
    if (report.has_volume) {
        tally.expect(near(report.volume, PMP::volume(surface), std::pow(area, 1.5)), name + ": volume");
    }
}

void compare_surfaces(const mt_mesh *mesh, const mt_manifold_report &report, const std::string &name)
{
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points_of(mesh), polygons_of(mesh), surface);
    tally.expect_equal(report.edge_count, surface.number_of_edges(), name + ": edges");
    std::size_t border = 0;
    for (auto edge : surface.edges()) {
        border += surface.is_border(edge);
    }
    tally.expect_equal(report.defect_counts[MT_DEFECT_BOUNDARY_EDGE], border, name + ": boundary edges");
    std::vector<Surface::Halfedge_index> cycles;
    PMP::extract_boundary_cycles(surface, std::back_inserter(cycles));
    tally.expect_equal(report.boundary_loop_count, cycles.size(), name + ": boundary loops");
    tally.expect_equal(report.component_count, count_components(surface), name + ": components");
    std::size_t isolated = 0;
    for (auto vertex : surface.vertices()) {
        isolated += surface.is_isolated(vertex);
    }
    tally.expect_equal(report.defect_counts[MT_DEFECT_ISOLATED_VERTEX], isolated, name + ": isolated vertices");
    if (CGAL::is_triangle_mesh(surface)) {
        compare_measures(report, surface, name);
    }
}

// CGAL turns faces; it says no when it had to double a point, because nothing else could hold or orient the soup.
void compare_orientability(const mt_mesh *mesh, const mt_manifold_report &report, const std::string &name)
{
    if (report.defect_counts[MT_DEFECT_DEGENERATE_FACE]) {
        std::printf("skipped: orientability of %s, a face names a vertex twice\n", name.c_str());
        return;
    }
    std::vector<Point> points = points_of(mesh);
    Polygons polygons = polygons_of(mesh);
    bool oriented = PMP::orient_polygon_soup(points, polygons);
    bool expected = report.manifold_class != MT_NON_MANIFOLD && report.orientable == MT_YES;
    tally.expect_equal(expected, oriented, name + ": orientable manifold");
}

void compare(mt_context *context, const mt_mesh *mesh, const std::string &name)
{
    mt_manifold_report report;
    tally.expect(mt_check_manifold(context, mesh, nullptr, &report) == MT_OK, name + ": the check runs");
    bool valid = report.manifold_class != MT_NON_MANIFOLD && report.oriented == MT_YES;
    bool theirs = PMP::is_polygon_soup_a_polygon_mesh(polygons_of(mesh));
    tally.expect_equal(valid, theirs, name + ": oriented manifold");
    compare_orientability(mesh, report, name);
    if (valid && theirs) {
        compare_surfaces(mesh, report, name);
    }
    mt_manifold_report_release(context, &report);
}

mt_mesh *random_soup(mt_context *context, std::mt19937 &random)
{
    mt_mesh_layout layout{};
    layout.vertex_count = 4 + random() % 6;
    layout.face_count = 1 + random() % 9;
    layout.face_size = 3 + random() % 2;
    layout.position_type = MT_F64;
    mt_mesh *mesh = nullptr;
    mt_mesh_create(context, &layout, &mesh);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_make(random() % 4, random() % 4, random() % 4));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index *corners = mesh->corner_vertices + std::size_t(face) * mesh->face_size;
        for (mt_index i = 0; i < mesh->face_size; i++) {
            corners[i] = static_cast<mt_index>(random() % mesh->vertex_count);
        }
        if (face && random() % 2) { // beside an earlier face, so that some edges pair well
            const mt_index *beside = mesh->corner_vertices + std::size_t(random() % face) * mesh->face_size;
            corners[0] = beside[1];
            corners[1] = beside[0];
        }
    }
    return mesh;
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    for (const std::string &path : mesh_files()) {
        mt_mesh *mesh = nullptr;
        tally.expect(mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr) == MT_OK, path + ": reads");
        compare(context, mesh, path);
        mt_mesh_destroy(context, mesh);
    }
    std::mt19937 random(2024);
    for (int i = 0; i < 4000; i++) {
        mt_mesh *mesh = random_soup(context, random);
        mt_index degenerate = 0;
        std::vector<uint8_t> flags(mesh->face_count);
        mt_find_degenerate_faces(context, mesh, flags.data(), &degenerate);
        if (!degenerate) {
            compare(context, mesh, "soup " + std::to_string(i));
        }
        mt_mesh_destroy(context, mesh);
    }
    mt_context_destroy(context);
    return tally.conclude();
}
