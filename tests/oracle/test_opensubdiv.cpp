// Catmull-Clark beside OpenSubdiv's Far: every rule by a named case, at levels 1 to 4, in both precisions.
#include "tests/oracle/mesh_files.hpp"
#include "tests/oracle/opensubdiv.hpp"
#include "tests/oracle/opensubdiv_limit.hpp"

#include <functional>
#include <random>

namespace
{

Tally tally;
constexpr double tolerance_f64 = 1e-12, tolerance_f32 = 1e-6;
// Far adds sharpnesses in single precision, in an order of its own: where those sums round, weights differ by as much.
constexpr double tolerance_of_rounded_sums = 1e-7;
constexpr unsigned level_count = 4;

// A cage in the making, which becomes a mesh.
struct Cage {
    std::vector<std::array<double, 3>> points;
    std::vector<std::vector<mt_index>> faces;
    std::vector<mt_edge_value> creases;
    std::vector<mt_vertex_value> corners;
    std::vector<std::array<double, 2>> uvs;
    std::vector<mt_index> uv_indices; // per corner; empty: by vertex, or no UVs
    mt_subdivide_options options = {};
};

void fill(mt_context *context, mt_mesh *mesh, const Cage &cage)
{
    mt_index corner = 0;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_make(cage.points[v][0], cage.points[v][1], cage.points[v][2]));
    }
    for (mt_index f = 0; f < mesh->face_count; f++) {
        for (mt_index v : cage.faces[f]) {
            mesh->corner_vertices[corner++] = v;
        }
        mesh->face_offsets[f + 1] = corner;
    }
    mesh->creases =
        static_cast<mt_edge_value *>(mt_allocate_array(context, cage.creases.size(), sizeof(mt_edge_value)));
    mesh->sharp_vertices =
        static_cast<mt_vertex_value *>(mt_allocate_array(context, cage.corners.size(), sizeof(mt_vertex_value)));
    mesh->crease_count = static_cast<mt_index>(cage.creases.size());
    mesh->sharp_vertex_count = static_cast<mt_index>(cage.corners.size());
    std::copy(cage.creases.begin(), cage.creases.end(), mesh->creases);
    std::copy(cage.corners.begin(), cage.corners.end(), mesh->sharp_vertices);
}

void add_uvs(mt_context *context, mt_mesh *mesh, const Cage &cage, mt_type type)
{
    mt_attribute_layout layout{};
    layout.semantic = MT_SEMANTIC_UV;
    layout.domain = cage.uv_indices.empty() ? MT_DOMAIN_VERTEX : MT_DOMAIN_CORNER;
    layout.type = type;
    layout.component_count = 2;
    layout.value_count = cage.uvs.size();
    layout.indexed = !cage.uv_indices.empty();
    mt_attribute *uv = nullptr;
    if (mt_mesh_add_attribute(context, mesh, &layout, &uv) != MT_OK) {
        std::abort();
    }
    for (mt_index value = 0; value < uv->value_count; value++) {
        mt_attribute_set(uv, value, 0, cage.uvs[value][0]);
        mt_attribute_set(uv, value, 1, cage.uvs[value][1]);
    }
    if (uv->indices) {
        std::copy(cage.uv_indices.begin(), cage.uv_indices.end(), uv->indices);
    }
}

mt_mesh *mesh_of(mt_context *context, const Cage &cage, mt_type type)
{
    mt_mesh_layout layout{};
    layout.vertex_count = cage.points.size();
    layout.face_count = cage.faces.size();
    for (const auto &face : cage.faces) {
        layout.corner_count += face.size();
    }
    layout.position_type = type;
    mt_mesh *mesh = nullptr;
    if (mt_mesh_create(context, &layout, &mesh) != MT_OK) {
        std::abort();
    }
    fill(context, mesh, cage);
    if (!cage.uvs.empty()) {
        add_uvs(context, mesh, cage, type);
    }
    mt_mesh_compact_faces(context, mesh);
    return mesh;
}

struct Compared {
    std::size_t positions = 0, normals = 0, left_out = 0;
} limits;

// Of the last level, which `match` follows.
void compare_limit(mt_context *context, const std::string &name, const mt_mesh *mesh, mt_subdivide_options options,
                   const osd::Reference &reference, const osd::Match &match, double tolerance)
{
    mt_mesh *ours = nullptr;
    options.limit = true;
    if (mt_subdivide(context, mesh, &options, &ours) != MT_OK) {
        tally.expect(false, name + ": " + mt_context_error(context)->message);
        mt_context_clear_error(context);
        return;
    }
    osd::LimitDifference difference = osd::Limit(reference, int(options.level_count)).difference(ours, match);
    tally.expect(difference.position <= tolerance,
                 name + ": limits " + std::to_string(difference.position / tolerance) + " tolerances apart");
    double tolerance_of_normals = tolerance * 1e3; // of a level's short edges, whose ends are rounded
    tally.expect(difference.normal <= tolerance_of_normals,
                 name + ": normals " + std::to_string(difference.normal / tolerance_of_normals) + " tolerances apart");
    limits.positions += difference.positions;
    limits.normals += difference.normals;
    limits.left_out += difference.left_out;
    mt_mesh_destroy(context, ours);
}

// Refines the mesh to each level at once, and follows Far's.
void compare(mt_context *context, const std::string &name, const mt_mesh *mesh, mt_subdivide_options options,
             unsigned levels, double tolerance)
{
    bool triangles = options.scheme == MT_SUBDIVIDE_SCHEME_LOOP;
    osd::Reference reference(mesh, osd::sdc_options(options), levels,
                             triangles ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK);
    if (!reference.works()) {
        std::printf("skipped %s: OpenSubdiv refuses it\n", name.c_str());
        return;
    }
    if (osd::splits_values(reference)) {
        std::printf("skipped %s: Far takes one value for two\n", name.c_str());
        return;
    }
    osd::Match match = osd::first_match(mesh);
    mt_mesh *before = nullptr;
    for (unsigned level = 1; level <= levels; level++) {
        options.level_count = level;
        mt_mesh *refined = nullptr;
        if (mt_subdivide(context, mesh, &options, &refined) != MT_OK) {
            tally.expect(false, name + ": " + mt_context_error(context)->message);
            mt_context_clear_error(context);
            break;
        }
        auto next_match = triangles ? osd::next_match_of_triangles : osd::next_match;
        match = next_match(reference.topology(), int(level), before ? before : mesh, match, refined);
        osd::Difference difference = osd::difference_at(reference, int(level), refined, match);
        std::string label = name + ", level " + std::to_string(level);
        tally.expect(difference.position <= tolerance,
                     label + ": positions " + std::to_string(difference.position / tolerance) + " tolerances apart");
        if (!reference.uvs.empty()) {
            tally.expect(difference.uv <= tolerance,
                         label + ": UVs " + std::to_string(difference.uv / tolerance) + " tolerances apart");
        }
        mt_mesh_destroy(context, before);
        before = refined;
    }
    if (before && options.level_count == levels) {
        compare_limit(context, name + ", limit", mesh, options, reference, match, tolerance);
    }
    mt_mesh_destroy(context, before);
}

void compare(mt_context *context, const std::string &name, const Cage &cage, unsigned levels = level_count,
             double tolerance = tolerance_f64)
{
    mt_mesh *wide = mesh_of(context, cage, MT_F64), *narrow = mesh_of(context, cage, MT_F32);
    compare(context, name, wide, cage.options, levels, tolerance);
    compare(context, name + ", f32", narrow, cage.options, levels, tolerance_f32);
    mt_mesh_destroy(context, narrow);
    mt_mesh_destroy(context, wide);
}

using Random = std::mt19937_64;

double unit(Random &random)
{
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

Cage cube()
{
    Cage cage;
    for (int i = 0; i < 8; i++) {
        cage.points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    }
    cage.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return cage;
}

// A grid of columns x rows cells, rolled to a torus when closed; cells are quads, pairs of triangles, or joined with
// the next to a hexagon.
Cage grid(Random &random, mt_index columns, mt_index rows, bool closed)
{
    Cage cage;
    mt_index width = closed ? columns : columns + 1, height = closed ? rows : rows + 1;
    auto at = [&](mt_index column, mt_index row) { return row % height * width + column % width; };
    for (mt_index i = 0; i < width * height; i++) {
        double u = double(i % width) / width, v = double(i / width) / height;
        double bend = closed ? std::cos(2 * MT_PI * u) * (2 + std::cos(2 * MT_PI * v)) : 3 * u;
        double turn = closed ? std::sin(2 * MT_PI * u) * (2 + std::cos(2 * MT_PI * v)) : 3 * v;
        double lift = closed ? std::sin(2 * MT_PI * v) : u * v;
        cage.points.push_back({bend + 0.2 * unit(random), turn + 0.2 * unit(random), lift + 0.2 * unit(random)});
    }
    for (mt_index row = 0; row < rows; row++) {
        for (mt_index column = 0; column < columns; column++) {
            mt_index a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1), d = at(column, row + 1);
            std::uint64_t kind = random() % 5;
            if (kind == 0) {
                cage.faces.push_back({a, b, c});
                cage.faces.push_back({a, c, d});
            } else if (kind == 1 && column + 1 < columns) {
                cage.faces.push_back({a, b, at(column + 2, row), at(column + 2, row + 1), c, d});
                column++;
            } else {
                cage.faces.push_back({a, b, c, d});
            }
        }
    }
    return cage;
}

// A hub of some valence with a rim; open: one spoke is a slit.
Cage fan(Random &random, mt_index valence, bool closed)
{
    Cage cage;
    mt_index rim = closed ? valence : valence + 1;
    cage.points.push_back({0, 0, 0.5});
    for (mt_index i = 0; i < rim; i++) {
        double angle = 2 * MT_PI * i / (valence + 1);
        double radius = 1 + 0.1 * unit(random);
        cage.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.1 * unit(random)});
    }
    for (mt_index i = 0; i < valence; i++) {
        cage.faces.push_back({0, 1 + i, 1 + (i + 1) % rim});
    }
    return cage;
}

// Creases on a share of the edges and corners on a share of the vertices, with sharpness from a list.
void sharpen(Random &random, Cage &cage, double share, const std::vector<double> &values)
{
    for (const auto &face : cage.faces) {
        for (std::size_t i = 0; i < face.size(); i++) {
            if (unit(random) < share) {
                cage.creases.push_back({face[i], face[(i + 1) % face.size()], values[random() % values.size()]});
            }
        }
    }
    for (mt_index v = 0; v < cage.points.size(); v++) {
        if (unit(random) < share / 3) {
            cage.corners.push_back({v, values[random() % values.size()]});
        }
    }
}

// A crease along the first row of a grid's vertices, as far as `length`.
void crease_along(Cage &cage, const std::vector<mt_index> &chain, double sharpness)
{
    for (std::size_t i = 0; i + 1 < chain.size(); i++) {
        cage.creases.push_back({chain[i], chain[i + 1], sharpness});
    }
}

const std::vector<double> sharpnesses = {0.5, 1, 1.5, 2.5, 10};

void compare_smooth(mt_context *context)
{
    Random random(1);
    compare(context, "cube", cube());
    for (int i = 0; i < 6; i++) {
        compare(context, "random n-gons, closed " + std::to_string(i), grid(random, 4 + i % 3, 3 + i % 4, true));
        compare(context, "random n-gons, open " + std::to_string(i), grid(random, 4 + i % 3, 3 + i % 4, false));
    }
    for (mt_index valence : {3, 4, 5, 6, 7, 12, 50, 1000}) {
        compare(context, "hub of " + std::to_string(valence), fan(random, valence, true), valence > 100 ? 2 : 4);
        compare(context, "slit hub of " + std::to_string(valence), fan(random, valence, false), valence > 100 ? 2 : 4);
    }
}

void compare_creases(mt_context *context, mt_subdivide_crease_method method, const std::string &kind)
{
    Random random(2);
    for (double sharpness : sharpnesses) {
        std::string label = kind + " of sharpness " + std::to_string(sharpness);
        Cage cage = cube();
        cage.options.crease_method = method;
        sharpen(random, cage, 1, {sharpness});
        cage.corners.clear();
        compare(context, "cube with every edge sharp, " + label, cage);
        cage.creases.clear();
        crease_along(cage, {0, 1, 3, 2, 0}, sharpness);
        compare(context, "cube with a sharp lid, " + label, cage);
        cage.creases.clear();
        crease_along(cage, {0, 1}, sharpness);
        compare(context, "darts, " + label, cage);
        cage.creases.clear();
        cage.corners = {{0, sharpness}, {5, sharpness}};
        compare(context, "corners, " + label, cage);
    }
    for (int i = 0; i < 24; i++) {
        Cage cage = grid(random, 5, 4, i % 2 == 0);
        cage.options.crease_method = method;
        cage.options.boundary = i % 3 ? MT_SUBDIVIDE_BOUNDARY_SMOOTH : MT_SUBDIVIDE_BOUNDARY_CORNERS;
        bool exact = i % 4 < 2;
        sharpen(random, cage, i < 12 ? 0.12 : 0.4, exact ? sharpnesses : std::vector<double>{0.3, 0.7, 1.1, 2.2, 3.9});
        compare(context, "random " + kind + " " + std::to_string(i), cage, level_count,
                exact ? tolerance_f64 : tolerance_of_rounded_sums);
    }
    for (mt_index valence : {3, 5, 50, 1000}) {
        Cage cage = fan(random, valence, valence != 5);
        cage.options.crease_method = method;
        sharpen(random, cage, 0.2, sharpnesses);
        compare(context, "hub of " + std::to_string(valence) + " with " + kind, cage, valence > 100 ? 2 : 4);
    }
}

void compare_triangles(mt_context *context)
{
    Random random(4);
    for (int i = 0; i < 6; i++) {
        Cage cage = grid(random, 5, 5, i % 2 == 0);
        cage.options.triangles = MT_SUBDIVIDE_TRIANGLES_SMOOTH;
        compare(context, "smooth triangles among n-gons " + std::to_string(i), cage);
        sharpen(random, cage, 0.3, sharpnesses);
        compare(context, "smooth triangles and creases " + std::to_string(i), cage);
    }
    Cage hub = fan(random, 7, true);
    hub.options.triangles = MT_SUBDIVIDE_TRIANGLES_SMOOTH;
    compare(context, "smooth triangles alone", hub);
}

// Sheets that share edges and vertices.
void compare_non_manifold(mt_context *context)
{
    Random random(5);
    Cage fins = cube();
    fins.points.insert(fins.points.end(), {{3, 1, -1}, {3, 1, 1}, {3, -1, 1}, {-1, -1, 3}});
    fins.faces.push_back({3, 7, 9, 8}); // a fin on edge 3-7
    Cage book = cube();
    book.points.insert(book.points.end(), {{3, 0, -1}, {3, 0, 1}});
    book.faces.push_back({1, 3, 8});
    Cage kiss = cube();
    kiss.points.insert(kiss.points.end(), {{3, 1, 1}, {3, 3, 1}, {1, 3, 3}});
    kiss.faces.push_back({7, 8, 9, 10}); // at vertex 7 alone
    Cage row;                            // three sheets along a row of edges
    for (int i = 0; i <= 4; i++) {
        row.points.push_back({double(i), 0, 0});
    }
    for (int sheet = 0; sheet < 3; sheet++) {
        auto base = static_cast<mt_index>(row.points.size());
        for (int i = 0; i <= 4; i++) {
            row.points.push_back({i + 0.1 * unit(random), std::cos(2.0 * sheet), std::sin(2.0 * sheet)});
        }
        for (mt_index i = 0; i < 4; i++) {
            row.faces.push_back({i, i + 1, base + i + 1, base + i});
        }
    }
    for (auto boundary : {MT_SUBDIVIDE_BOUNDARY_SMOOTH, MT_SUBDIVIDE_BOUNDARY_CORNERS}) {
        std::string kind = boundary == MT_SUBDIVIDE_BOUNDARY_SMOOTH ? "smooth boundary" : "boundary with corners";
        for (auto &[name, cage] : {std::pair<const char *, Cage &>{"a cube with a fin", fins},
                                   {"a cube with a triangle on an edge", book},
                                   {"a cube that a quad touches at a vertex", kiss},
                                   {"three sheets along a row", row}}) {
            cage.options.boundary = boundary;
            cage.options.non_manifold = MT_SUBDIVIDE_NON_MANIFOLD_SHARP;
            compare(context, std::string("non-manifold: ") + name + ", " + kind, cage);
        }
    }
}

// UVs of their own at every vertex, and seams: at a share of the corners another value is used, or the next corner's.
void map(Random &random, Cage &cage, double share)
{
    cage.uvs.clear();
    cage.uv_indices.clear();
    for (std::size_t v = 0; v < 3 * cage.points.size(); v++) {
        cage.uvs.push_back({unit(random), unit(random)});
    }
    auto count = static_cast<mt_index>(cage.points.size());
    for (const auto &face : cage.faces) {
        mt_index chart = unit(random) < share ? static_cast<mt_index>(random() % 3) : 0;
        for (mt_index v : face) {
            bool apart = unit(random) < share / 4;
            cage.uv_indices.push_back(v + count * (apart ? static_cast<mt_index>(random() % 3) : chart));
        }
    }
}

// Sheets of charts with straight seams, as artists make them.
void map_in_charts(Cage &cage, mt_index faces_in_chart)
{
    cage.uvs.clear();
    cage.uv_indices.clear();
    auto count = static_cast<mt_index>(cage.points.size());
    for (std::size_t v = 0; v < 3 * cage.points.size(); v++) {
        const auto &p = cage.points[v % count];
        cage.uvs.push_back({p[0] + double(v / count), p[1] + p[2]});
    }
    for (std::size_t f = 0; f < cage.faces.size(); f++) {
        for (mt_index v : cage.faces[f]) {
            cage.uv_indices.push_back(v + count * static_cast<mt_index>(f / faces_in_chart % 3));
        }
    }
}

void compare_face_varying(mt_context *context)
{
    static const char *const names[] = {"",          "all", "none", "corners only", "corners plus 1", "corners plus 2",
                                        "boundaries"};
    for (int option = MT_SUBDIVIDE_FACE_VARYING_ALL; option <= MT_SUBDIVIDE_FACE_VARYING_BOUNDARIES; option++) {
        Random random(7);
        std::string label = std::string("UVs, ") + names[option];
        for (int i = 0; i < 40; i++) {
            Cage cage = grid(random, 5, 4, i % 2 == 0);
            cage.options.face_varying = static_cast<mt_subdivide_face_varying>(option);
            cage.options.boundary = i % 3 ? MT_SUBDIVIDE_BOUNDARY_SMOOTH : MT_SUBDIVIDE_BOUNDARY_CORNERS;
            cage.options.crease_method = i % 8 < 6 ? MT_SUBDIVIDE_CREASES_NORMAL : MT_SUBDIVIDE_CREASES_CHAIKIN;
            i % 4 < 2 ? map(random, cage, 0.05 * (i % 7)) : map_in_charts(cage, 3 + mt_index(i) % 5);
            compare(context, label + ", seams " + std::to_string(i), cage);
            sharpen(random, cage, i < 20 ? 0.1 : 0.4, sharpnesses);
            cage.options.triangles = i % 5 ? MT_SUBDIVIDE_TRIANGLES_NORMAL : MT_SUBDIVIDE_TRIANGLES_SMOOTH;
            compare(context, label + ", seams and creases " + std::to_string(i), cage);
        }
        for (int i = 0; i < 4; i++) {
            Cage cage = grid(random, 5, 4, i == 0);
            cage.options.face_varying = static_cast<mt_subdivide_face_varying>(option);
            cage.options.boundary = i % 2 ? MT_SUBDIVIDE_BOUNDARY_SMOOTH : MT_SUBDIVIDE_BOUNDARY_CORNERS;
            sharpen(random, cage, 0.1 * i, sharpnesses);
            for (const auto &p : cage.points) {
                cage.uvs.push_back({p[0], p[1] - p[2]});
            }
            compare(context, label + ", by vertex " + std::to_string(i), cage);
        }
        Cage box = cube();
        box.options.face_varying = static_cast<mt_subdivide_face_varying>(option);
        box.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        for (int corner = 0; corner < 24; corner++) {
            box.uv_indices.push_back(static_cast<mt_index>(corner % 4));
        }
        compare(context, label + ", four values shared by all faces of a cube", box);
    }
}

// The files, as they are and with smooth UVs; what is not manifold as sharp. Levels as the size allows.
void compare_files(mt_context *context)
{
    for (const std::string &file : mesh_files()) {
        mt_mesh *mesh = nullptr;
        if (mt_mesh_read_file(context, file.c_str(), nullptr, &mesh, nullptr) != MT_OK) {
            mt_context_clear_error(context);
            continue;
        }
        mt_subdivide_options options{};
        mt_mesh *tried = nullptr;
        mt_status status = mt_subdivide(context, mesh, &options, &tried);
        mt_mesh_destroy(context, tried);
        if (status == MT_ERROR_NOT_MANIFOLD) {
            mt_context_clear_error(context);
            options.non_manifold = MT_SUBDIVIDE_NON_MANIFOLD_SHARP;
            status = mt_subdivide(context, mesh, &options, &tried);
            mt_mesh_destroy(context, status == MT_OK ? tried : nullptr);
        }
        unsigned levels = mesh->corner_count > 100000 ? 1 : mesh->corner_count > 10000 ? 2 : 4;
        if (status == MT_OK && mesh->face_count) {
            mt_mesh_set_position_type(context, mesh, MT_F64, nullptr);
            compare(context, file, mesh, options, levels, tolerance_f64);
            options.face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_ONLY;
            options.boundary = MT_SUBDIVIDE_BOUNDARY_CORNERS;
            compare(context, file + ", smooth UVs, boundary with corners", mesh, options, levels, tolerance_f64);
        } else if (status != MT_OK) {
            std::printf("skipped %s: %s\n", file.c_str(), mt_context_error(context)->message);
            mt_context_clear_error(context);
        }
        mt_mesh_destroy(context, mesh);
    }
}

void compare_boundaries(mt_context *context)
{
    Random random(3);
    Cage quad;
    quad.points = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 4}};
    quad.faces = {{0, 1, 2, 3}};
    for (auto boundary : {MT_SUBDIVIDE_BOUNDARY_SMOOTH, MT_SUBDIVIDE_BOUNDARY_CORNERS}) {
        std::string kind = boundary == MT_SUBDIVIDE_BOUNDARY_SMOOTH ? "smooth boundary" : "boundary with corners";
        quad.options.boundary = boundary;
        compare(context, "quad, " + kind, quad);
        Cage cage = grid(random, 4, 4, false);
        cage.options.boundary = boundary;
        compare(context, "sheet, " + kind, cage);
        sharpen(random, cage, 0.3, sharpnesses);
        compare(context, "creased sheet, " + kind, cage);
    }
}

// A grid cut into triangles, along either diagonal.
Cage triangles(Random &random, mt_index columns, mt_index rows, bool closed)
{
    Cage cage = grid(random, columns, rows, closed);
    std::vector<std::vector<mt_index>> faces;
    for (const auto &face : cage.faces) {
        for (std::size_t i = 1; i + 1 < face.size(); i++) {
            faces.push_back({face[0], face[i], face[i + 1]});
        }
    }
    cage.faces = faces;
    cage.options.scheme = MT_SUBDIVIDE_SCHEME_LOOP;
    return cage;
}

void compare_loop(mt_context *context)
{
    Random random(9);
    for (int i = 0; i < 16; i++) {
        Cage cage = triangles(random, 5, 4, i % 2 == 0);
        cage.options.boundary = i % 3 ? MT_SUBDIVIDE_BOUNDARY_SMOOTH : MT_SUBDIVIDE_BOUNDARY_CORNERS;
        cage.options.crease_method = i % 4 < 2 ? MT_SUBDIVIDE_CREASES_NORMAL : MT_SUBDIVIDE_CREASES_CHAIKIN;
        cage.options.face_varying = static_cast<mt_subdivide_face_varying>(1 + i % 6);
        compare(context, "Loop, triangles " + std::to_string(i), cage);
        map_in_charts(cage, 5);
        compare(context, "Loop, UVs " + std::to_string(i), cage);
        sharpen(random, cage, 0.2, sharpnesses);
        compare(context, "Loop, UVs and creases " + std::to_string(i), cage);
    }
    for (mt_index valence : {3, 4, 5, 6, 7, 12, 50, 1000}) {
        for (bool closed : {true, false}) {
            Cage cage = fan(random, valence, closed);
            cage.options.scheme = MT_SUBDIVIDE_SCHEME_LOOP;
            compare(context, "Loop, hub of " + std::to_string(valence), cage, valence > 100 ? 2 : 4);
        }
    }
}

} // namespace

int main()
{
    mt_context_options options{};
    options.thread_count = 1;
    mt_context *context = mt_context_create(&options);
    compare_smooth(context);
    compare_creases(context, MT_SUBDIVIDE_CREASES_NORMAL, "creases");
    compare_creases(context, MT_SUBDIVIDE_CREASES_CHAIKIN, "Chaikin creases");
    compare_boundaries(context);
    compare_triangles(context);
    compare_non_manifold(context);
    compare_face_varying(context);
    compare_loop(context);
    compare_files(context);
    mt_context_destroy(context);
    std::printf("limits compared: %zu positions, %zu normals; %zu left out where Far's masks do not hold\n",
                limits.positions, limits.normals, limits.left_out);
    tally.expect(limits.positions > 20 * limits.left_out && limits.normals > 20 * limits.left_out,
                 "most limits were compared");
    return tally.conclude();
}
