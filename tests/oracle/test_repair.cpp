// Repair beside CGAL: each step alone against CGAL's function for it, all of them against CGAL's verdict, on every
// mesh, on random soups and patches, and on those moved far away and scaled to the ends of what floats hold.
#include "tests/oracle/mesh_files.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <initializer_list>
#include <numeric>
#include <random>
#include <set>

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Rational = CGAL::Exact_rational;

namespace
{

Tally tally;
mt_context *context;

// A mesh mended by some steps, with the account of it.
struct Mended {
    mt_mesh *mesh = nullptr;
    mt_repair_report report{};

    Mended(const mt_mesh *given, std::initializer_list<mt_repair_step> steps)
    {
        mt_repair_options options{};
        for (mt_repair_step step : steps) {
            options.steps[step] = true;
        }
        tally.expect(mt_repair(context, given, &options, &report, &mesh) == MT_OK, "a repair runs");
    }
    ~Mended()
    {
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, mesh);
    }
    Mended(const Mended &) = delete;
    Mended &operator=(const Mended &) = delete;
};

const std::initializer_list<mt_repair_step> all_steps = {
    MT_REPAIR_WELD,   MT_REPAIR_DROP_DEGENERATE, MT_REPAIR_DROP_DUPLICATES, MT_REPAIR_SPLIT,
    MT_REPAIR_ORIENT, MT_REPAIR_FILL_HOLES,      MT_REPAIR_DROP_ISOLATED};

std::vector<Point> points_of(const mt_mesh *mesh)
{
    std::vector<Point> points;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        points.emplace_back(p.x, p.y, p.z);
    }
    return points;
}

bool is_finite(const mt_mesh *mesh)
{
    return mt_mesh_bounds(mesh).non_finite_count == 0;
}

// Each face's corners as places, so that two meshes are compared whatever the numbers of their vertices.
std::vector<std::vector<Point>> corners_of(const std::vector<Point> &points, const Polygons &polygons)
{
    std::vector<std::vector<Point>> corners;
    for (const auto &polygon : polygons) {
        corners.emplace_back();
        for (std::size_t v : polygon) {
            corners.back().push_back(points[v]);
        }
    }
    return corners;
}

void compare_weld(const mt_mesh *mesh, const std::string &name)
{
    Mended ours(mesh, {MT_REPAIR_WELD});
    std::vector<Point> points = points_of(mesh);
    Polygons polygons = polygons_of(mesh);
    PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
    tally.expect_equal(ours.mesh->vertex_count, points.size(), name + ": vertices after welding");
    tally.expect(corners_of(points_of(ours.mesh), polygons_of(ours.mesh)) == corners_of(points, polygons),
                 name + ": faces after welding");
}

bool names_twice(const std::vector<std::size_t> &polygon)
{
    return std::set<std::size_t>(polygon.begin(), polygon.end()).size() < polygon.size();
}

bool is_on_a_line(const std::vector<Point> &points, const std::vector<std::size_t> &polygon)
{
    for (std::size_t i : polygon) {
        for (std::size_t j : polygon) {
            for (std::size_t k : polygon) {
                if (!CGAL::collinear(points[i], points[j], points[k])) {
                    return false;
                }
            }
        }
    }
    return true;
}

void compare_degenerate(const mt_mesh *mesh, const std::string &name)
{
    Mended ours(mesh, {MT_REPAIR_DROP_DEGENERATE});
    std::vector<Point> points = points_of(mesh);
    Polygons kept;
    for (const auto &polygon : polygons_of(mesh)) {
        bool large = polygon.size() > 60; // cubic time
        if (!names_twice(polygon) && (large || !is_on_a_line(points, polygon))) {
            kept.push_back(polygon);
        }
    }
    tally.expect(polygons_of(ours.mesh) == kept, name + ": faces left by dropping degenerate ones");
}

void compare_duplicates(const mt_mesh *given, const std::string &name)
{
    Mended simple(given, {MT_REPAIR_DROP_DEGENERATE});
    Mended ours(simple.mesh, {MT_REPAIR_DROP_DUPLICATES});
    std::vector<Point> points = points_of(simple.mesh);
    Polygons polygons = polygons_of(simple.mesh);
    PMP::merge_duplicate_polygons_in_polygon_soup(points, polygons);
    Polygons mine = polygons_of(ours.mesh);
    tally.expect_equal(mine.size(), polygons.size(), name + ": faces left by dropping duplicates");
    auto sets_of = [](const Polygons &from) {
        std::multiset<std::set<std::size_t>> sets;
        for (const auto &polygon : from) {
            sets.emplace(polygon.begin(), polygon.end());
        }
        return sets;
    };
    tally.expect(sets_of(mine) == sets_of(polygons), name + ": which faces are left by dropping duplicates");
}

mt_manifold_report check(const mt_mesh *mesh, mt_manifold_options options = {})
{
    mt_manifold_report report{};
    tally.expect(mt_check_manifold(context, mesh, &options, &report) == MT_OK, "a check runs");
    mt_manifold_report counts = report;
    mt_manifold_report_release(context, &report);
    counts.defects = nullptr;
    return counts;
}

// Whether a face of `now` runs as it did in `before`.
bool runs_alike(const std::vector<std::size_t> &before, const std::vector<std::size_t> &now)
{
    auto at = std::find(now.begin(), now.end(), before[0]);
    return at != now.end() && now[std::size_t(at - now.begin() + 1) % now.size()] == before[1];
}

std::vector<mt_index> components_of(const mt_mesh *mesh, mt_index *count)
{
    mt_edge_pairs *pairs = nullptr;
    mt_components *components = nullptr;
    tally.expect(mt_edge_pairs_create(context, mesh, &pairs) == MT_OK &&
                     mt_components_create(context, mesh, pairs, true, &components) == MT_OK,
                 "components");
    std::vector<mt_index> result(components->face_component, components->face_component + mesh->face_count);
    *count = components->component_count;
    mt_components_destroy(context, components);
    mt_edge_pairs_destroy(context, pairs);
    return result;
}

// About the first corner, as repair's volumes are.
Rational volume_of(const std::vector<Point> &points, const std::vector<std::size_t> &polygon)
{
    auto exact = [&points](std::size_t v) {
        return std::array<Rational, 3>{Rational(points[v].x()), Rational(points[v].y()), Rational(points[v].z())};
    };
    Rational volume(0);
    auto a = exact(polygon[0]);
    for (std::size_t i = 1; i + 1 < polygon.size(); i++) {
        auto b = exact(polygon[i]), c = exact(polygon[i + 1]);
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume;
}

void expect_outward(const mt_mesh *mesh, const std::string &name)
{
    mt_index count = 0;
    std::vector<mt_index> component = components_of(mesh, &count);
    std::vector<Rational> volumes(count, Rational(0));
    std::vector<Point> points = points_of(mesh);
    Polygons polygons = polygons_of(mesh);
    for (std::size_t face = 0; face < polygons.size(); face++) {
        volumes[component[face]] += volume_of(points, polygons[face]);
    }
    for (mt_index i = 0; i < count; i++) {
        tally.expect(volumes[i] >= 0, name + ": component " + std::to_string(i) + " looks outwards");
    }
}

// CGAL says no when it had to double a point, because nothing else could hold or orient the soup.
void compare_orient(const mt_mesh *given, const std::string &name)
{
    Mended simple(given, {MT_REPAIR_DROP_DEGENERATE, MT_REPAIR_DROP_DUPLICATES, MT_REPAIR_SPLIT});
    Mended ours(simple.mesh, {MT_REPAIR_ORIENT});
    std::vector<Point> points = points_of(simple.mesh);
    Polygons before = polygons_of(simple.mesh), theirs = before, mine = polygons_of(ours.mesh);
    bool oriented = PMP::orient_polygon_soup(points, theirs);
    mt_manifold_report after = check(ours.mesh);
    tally.expect_equal(after.oriented == MT_YES, oriented, name + ": oriented");
    tally.expect_equal(ours.report.results[MT_REPAIR_ORIENT].left_count > 0, !oriented, name + ": left unoriented");
    if (!oriented) {
        return;
    }
    mt_index count = 0;
    std::vector<mt_index> component = components_of(simple.mesh, &count);
    std::vector<int> relation(count, -1);
    for (std::size_t face = 0; face < before.size(); face++) {
        int same = runs_alike(before[face], mine[face]) == runs_alike(before[face], theirs[face]);
        int &known = relation[component[face]];
        tally.expect(known == -1 || known == same, name + ": faces turned alike");
        known = same;
    }
    if (after.manifold_class == MT_MANIFOLD) {
        expect_outward(ours.mesh, name);
    }
}

// Every face apart, and welded again.
mt_mesh *explode(const mt_mesh *mesh)
{
    mt_mesh_layout layout{};
    layout.vertex_count = layout.corner_count = mesh->corner_count;
    layout.face_count = mesh->face_count;
    layout.face_size = mesh->face_offsets ? 0 : mesh->face_size;
    layout.position_type = mesh->position_type;
    mt_mesh *apart = nullptr;
    tally.expect(mt_mesh_create(context, &layout, &apart) == MT_OK, "a mesh is made");
    for (mt_index face = 0; apart->face_offsets && face <= mesh->face_count; face++) {
        apart->face_offsets[face] = mesh->face_offsets[face];
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        apart->corner_vertices[c] = c;
        mt_mesh_set_position(apart, c, mt_mesh_position(mesh, mesh->corner_vertices[c]));
    }
    return apart;
}

std::size_t border_count(const Surface &surface)
{
    std::size_t count = 0;
    for (auto edge : surface.edges()) {
        count += surface.is_border(edge);
    }
    return count;
}

void compare_stitch(const mt_mesh *mesh, const std::string &name)
{
    mt_manifold_report report = check(mesh, {1, false, false, true});
    if (report.manifold_class == MT_NON_MANIFOLD || report.oriented != MT_YES ||
        report.as_welded.vertex_count < report.vertex_count) {
        return; // there is more than one way to stitch those
    }
    mt_mesh *apart = explode(mesh);
    Mended ours(apart, {MT_REPAIR_WELD, MT_REPAIR_SPLIT});
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points_of(apart), polygons_of(apart), surface);
    PMP::stitch_borders(surface);
    mt_manifold_report after = check(ours.mesh);
    tally.expect_equal(after.defect_counts[MT_DEFECT_BOUNDARY_EDGE], border_count(surface), name + ": seams left");
    tally.expect_equal(after.edge_count, surface.number_of_edges(), name + ": edges stitched");
    tally.expect_equal(after.vertex_count, surface.number_of_vertices(), name + ": vertices stitched");
    mt_mesh_destroy(context, apart);
}

double area_of(const Point &a, const Point &b, const Point &c)
{
    return std::sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2;
}

// CGAL minimises the largest dihedral angle first, so that its area may be larger, never smaller.
bool fill(const mt_mesh *mesh, double *area, std::size_t *faces)
{
    Surface surface;
    PMP::polygon_soup_to_polygon_mesh(points_of(mesh), polygons_of(mesh), surface);
    std::vector<Surface::Halfedge_index> cycles;
    PMP::extract_boundary_cycles(surface, std::back_inserter(cycles));
    *area = 0;
    *faces = 0;
    for (auto cycle : cycles) {
        std::vector<Surface::Face_index> added;
        PMP::triangulate_hole(surface, cycle, std::back_inserter(added),
                              CGAL::parameters::use_delaunay_triangulation(false));
        for (auto face : added) {
            auto h = surface.halfedge(face);
            *area += area_of(surface.point(surface.source(h)), surface.point(surface.target(h)),
                             surface.point(surface.target(surface.next(h))));
        }
        *faces += added.size();
        if (added.empty()) {
            return false;
        }
    }
    // Its triangles may take edges that faces have already, which ours must not.
    Polygons filled;
    for (auto face : surface.faces()) {
        filled.emplace_back();
        for (auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
            filled.back().push_back(vertex);
        }
    }
    return !cycles.empty() && PMP::is_polygon_soup_a_polygon_mesh(filled);
}

void compare_fill(const mt_mesh *given, const std::string &name)
{
    Mended simple(given, {MT_REPAIR_WELD, MT_REPAIR_DROP_DEGENERATE, MT_REPAIR_DROP_DUPLICATES, MT_REPAIR_SPLIT,
                          MT_REPAIR_ORIENT, MT_REPAIR_DROP_ISOLATED});
    if (!PMP::is_polygon_soup_a_polygon_mesh(polygons_of(simple.mesh))) {
        return;
    }
    Mended ours(simple.mesh, {MT_REPAIR_FILL_HOLES});
    const mt_repair_result &result = ours.report.results[MT_REPAIR_FILL_HOLES];
    double theirs = 0, mine = 0;
    std::size_t faces = 0;
    if (result.left_count || !result.count || !fill(simple.mesh, &theirs, &faces)) {
        return;
    }
    Polygons polygons = polygons_of(ours.mesh);
    std::vector<Point> points = points_of(ours.mesh);
    for (uint64_t i = 0; i < result.face_count; i++) {
        const auto &polygon = polygons[result.faces[i]];
        mine += area_of(points[polygon[0]], points[polygon[1]], points[polygon[2]]);
    }
    tally.expect_equal(result.face_count, faces, name + ": triangles in holes");
    tally.expect(mine <= theirs * (1 + 1e-9),
                 name + ": area of holes, " + std::to_string(mine) + ", they have " + std::to_string(theirs));
    tally.expect_equal(check(ours.mesh).manifold_class, MT_MANIFOLD, name + ": closed by filling");
}

void compare_all(const mt_mesh *mesh, const std::string &name)
{
    Mended once(mesh, all_steps), twice(once.mesh, all_steps);
    mt_manifold_report after = check(once.mesh, {1, false, true, false});
    bool valid = after.manifold_class != MT_NON_MANIFOLD && after.oriented == MT_YES;
    tally.expect_equal(valid, PMP::is_polygon_soup_a_polygon_mesh(polygons_of(once.mesh)), name + ": repaired");
    tally.expect(after.manifold_class != MT_NON_MANIFOLD, name + ": manifold after repair");
    for (mt_defect_kind kind : {MT_DEFECT_DUPLICATE_FACE, MT_DEFECT_ZERO_AREA_FACE, MT_DEFECT_ISOLATED_VERTEX,
                                MT_DEFECT_INSIDE_OUT_COMPONENT}) {
        tally.expect_equal(after.defect_counts[kind], 0, name + ": " + mt_defect_key(kind));
    }
    tally.expect(after.oriented == MT_YES || once.report.results[MT_REPAIR_ORIENT].left_count,
                 name + ": oriented, or said not to be");
    tally.expect(!after.defect_counts[MT_DEFECT_BOUNDARY_EDGE] || once.report.results[MT_REPAIR_FILL_HOLES].left_count,
                 name + ": closed, or said not to be");
    tally.expect(polygons_of(once.mesh) == polygons_of(twice.mesh) && points_of(once.mesh) == points_of(twice.mesh),
                 name + ": repaired twice as once");
}

void compare(const mt_mesh *mesh, const std::string &name)
{
    compare_weld(mesh, name);
    compare_degenerate(mesh, name);
    compare_duplicates(mesh, name);
    compare_orient(mesh, name);
    compare_stitch(mesh, name);
    compare_all(mesh, name);
}

void change(mt_mesh *mesh, double factor, double offset)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        mt_mesh_set_position(mesh, v,
                             mt_vec3_make(p.x * factor + offset, p.y * factor + offset, p.z * factor + offset));
    }
}

mt_mesh *make_mesh(mt_index vertex_count, const std::vector<std::array<mt_index, 3>> &faces)
{
    mt_mesh_layout layout{};
    layout.vertex_count = vertex_count;
    layout.face_count = faces.size();
    layout.face_size = 3;
    layout.position_type = MT_F64;
    mt_mesh *mesh = nullptr;
    tally.expect(mt_mesh_create(context, &layout, &mesh) == MT_OK, "a mesh is made");
    for (std::size_t face = 0; face < faces.size(); face++) {
        std::copy(faces[face].begin(), faces[face].end(), mesh->corner_vertices + 3 * face);
    }
    return mesh;
}

mt_mesh *random_soup(std::mt19937 &random)
{
    mt_index vertex_count = 4 + random() % 8;
    std::vector<std::array<mt_index, 3>> faces(1 + random() % 12);
    for (std::size_t face = 0; face < faces.size(); face++) {
        for (mt_index &corner : faces[face]) {
            corner = static_cast<mt_index>(random() % vertex_count);
        }
        if (face && random() % 2) { // beside an earlier face, so that some edges pair well
            const auto &beside = faces[random() % face];
            faces[face][0] = beside[1];
            faces[face][1] = beside[0];
        }
    }
    mt_mesh *mesh = make_mesh(vertex_count, faces);
    for (mt_index v = 0; v < vertex_count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_make(random() % 4, random() % 4, random() % 4));
    }
    return mesh;
}

// A bumpy grid, tube or torus with holes, some of its faces turned over.
mt_mesh *random_patch(std::mt19937 &random)
{
    const mt_index columns = 8, rows = 6;
    unsigned kind = random() % 3, holes = random() % 4;
    auto vertex = [=](mt_index column, mt_index row) {
        return (kind == 2 ? row % rows : row) * (columns + 1) + (kind ? column % columns : column);
    };
    std::vector<std::array<mt_index, 3>> faces;
    bool turns = random() % 2;
    auto add = [&](mt_index a, mt_index b, mt_index c) {
        bool turned = turns && random() % 5 == 0;
        faces.push_back({a, turned ? c : b, turned ? b : c});
    };
    for (mt_index row = 0; row < rows; row++) {
        for (mt_index column = 0; column < columns; column++) {
            if (random() % 12 >= holes) {
                mt_index a = vertex(column, row), b = vertex(column + 1, row), c = vertex(column + 1, row + 1);
                add(a, b, c);
                add(a, c, vertex(column, row + 1));
            }
        }
    }
    mt_mesh *mesh = make_mesh((columns + 1) * (rows + 1), faces);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        double noise = double(random() % 1000) / 4000;
        mt_mesh_set_position(mesh, v, mt_vec3_make(v % (columns + 1) + noise, v / (columns + 1) * 1.0, 3 * noise));
    }
    return mesh;
}

void compare_files()
{
    for (const std::string &path : mesh_files()) {
        mt_mesh *mesh = nullptr;
        tally.expect(mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr) == MT_OK, path + ": reads");
        if (is_finite(mesh)) {
            compare(mesh, path);
            compare_fill(mesh, path);
        }
        mt_mesh_destroy(context, mesh);
    }
}

void compare_random()
{
    static const struct {
        double factor, offset;
    } changes[] = {{1, 0}, {1, 0}, {1, 1e7}, {1e-30, 0}, {1e30, 0}};
    std::mt19937 random(1895);
    for (int i = 0; i < 3000; i++) {
        mt_mesh *mesh = i % 4 ? random_soup(random) : random_patch(random);
        const auto &how = changes[i % 5];
        change(mesh, how.factor, how.offset);
        std::string name = "random mesh " + std::to_string(i);
        compare(mesh, name);
        if (i % 4 == 0 && how.factor == 1) {
            compare_fill(mesh, name);
        }
        mt_mesh_destroy(context, mesh);
    }
}

} // namespace

int main()
{
    context = mt_context_create(nullptr);
    compare_files();
    compare_random();
    mt_context_destroy(context);
    return tally.conclude();
}
