#include "tests/support/census.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/elementary.h>
#include <meshtool/generate.h>
#include <meshtool/predicates.h>

#include <stdio.h>
#include <string.h>

static mt_mesh *generate(mt_context *context, const char *name, mt_index resolution)
{
    mt_generate_options options = {.resolution = resolution};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, &options, &mesh), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    return mesh;
}

/* What each kind must be by its definition. The volume is of the limit shape, reached at the resolution to the
 * tolerance given; 0: not closed. */
typedef struct expectation {
    const char *name;
    mt_index resolution;
    size_t vertices, faces, edges;
    int64_t euler_characteristic;
    size_t components, boundary_loops, misoriented, non_manifold_edges, non_manifold_vertices;
    double volume, tolerance;
} expectation;

#define PHI 1.6180339887498948482

static const expectation expectations[] = {
    {"tetrahedron", 0, 4, 4, 6, 2, 1, 0, 0, 0, 0, 8.0 / 3, 1e-15},
    {"cube", 0, 8, 6, 12, 2, 1, 0, 0, 0, 0, 8, 0},
    {"octahedron", 0, 6, 8, 12, 2, 1, 0, 0, 0, 0, 4.0 / 3, 1e-15},
    {"icosahedron", 0, 12, 20, 30, 2, 1, 0, 0, 0, 0, 10.0 / 3 * PHI *PHI * 2, 1e-13},
    {"dodecahedron", 0, 20, 12, 30, 2, 1, 0, 0, 0, 0, 14.472135954999579, 1e-13},
    {"icosphere", 1, 42, 80, 120, 2, 1, 0, 0, 0, 0, 4.18879, 0.6},
    {"icosphere", 5, 10242, 20480, 30720, 2, 1, 0, 0, 0, 0, 4.18879, 4e-3},
    {"uv-sphere", 3, 5, 6, 9, 2, 1, 0, 0, 0, 0, 0.8660254037844386, 1e-14},
    {"uv-sphere", 200, 19802, 20000, 39800, 2, 1, 0, 0, 0, 0, 4.18879, 2e-3},
    {"cylinder", 3, 8, 9, 15, 2, 1, 0, 0, 0, 0, 2.598076211353316, 1e-14},
    {"cylinder", 500, 1002, 1500, 2500, 2, 1, 0, 0, 0, 0, 6.283185307, 2e-4},
    {"cone", 3, 4, 4, 6, 2, 1, 0, 0, 0, 0, 0.8660254037844386, 1e-14},
    {"cone", 500, 501, 501, 1000, 2, 1, 0, 0, 0, 0, 2.094395102, 1e-4},
    {"prism", 3, 6, 5, 9, 2, 1, 0, 0, 0, 0, 2.598076211353316, 1e-14},
    {"prism", 1000, 2000, 1002, 3000, 2, 1, 0, 0, 0, 0, 6.283185307, 5e-5},
    {"grid", 1, 4, 1, 4, 1, 1, 1, 0, 0, 0, 0, 0},
    {"grid", 10, 121, 100, 220, 1, 1, 1, 0, 0, 0, 0, 0},
    {"torus", 6, 18, 18, 36, 0, 1, 0, 0, 0, 0, 3, 2},
    {"torus", 200, 20000, 20000, 40000, 0, 1, 0, 0, 0, 0, 3.158273408, 3e-3},
    {"double-torus", 12, 142, 144, 288, -2, 1, 0, 0, 0, 0, 5.5, 1.5},
    {"double-torus", 24, 558, 560, 1120, -2, 1, 0, 0, 0, 0, 6.3, 0.5},
    {"double-torus", 60, 3438, 3440, 6880, -2, 1, 0, 0, 0, 0, 6.3, 0.5},
    {"moebius", 6, 12, 6, 18, 0, 1, 1, 1, 0, 0, 0, 0},
    {"moebius", 48, 384, 336, 720, 0, 1, 1, 7, 0, 0, 0, 0},
    {"klein", 6, 24, 24, 48, 0, 1, 0, 4, 0, 0, 0, 0},
    {"klein", 48, 1152, 1152, 2304, 0, 1, 0, 24, 0, 0, 0, 0},
    {"teapot", 2, 137, 121, 256, 2, 4, 6, 0, 0, 0, 0, 0},
    {"book", 3, 8, 3, 10, 1, 1, 1, 0, 1, 0, 0, 0},
    {"bowtie", 0, 5, 2, 6, 1, 2, 1, 0, 0, 1, 0, 0},
    {"book-bowtie", 0, 10, 4, 13, 1, 2, 1, 0, 1, 1, 0, 0},
};

static void check_expectation(mt_context *context, const expectation *expected)
{
    mt_mesh *mesh = generate(context, expected->name, expected->resolution);
    test_census census = test_census_of(mesh);
    assert_int_equal(census.vertices, expected->vertices);
    assert_int_equal(census.faces, expected->faces);
    assert_int_equal(census.edges, expected->edges);
    assert_int_equal(census.euler_characteristic, expected->euler_characteristic);
    assert_int_equal(census.components, expected->components);
    assert_int_equal(census.boundary_loops, expected->boundary_loops);
    assert_int_equal(census.misoriented_edges, expected->misoriented);
    assert_int_equal(census.non_manifold_edges, expected->non_manifold_edges);
    assert_int_equal(census.non_manifold_vertices, expected->non_manifold_vertices);
    assert_int_equal(census.isolated_vertices, 0);
    assert_int_equal(census.degenerate_faces, 0);
    if (expected->volume != 0) {
        assert_int_equal(census.boundary_edges, 0);
        assert_true(fabs(census.volume - expected->volume) <= expected->tolerance);
    }
    mt_mesh_destroy(context, mesh);
}

static void test_each_kind_is_what_it_says(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof expectations / sizeof *expectations; i++) {
        check_expectation(context, &expectations[i]);
    }
    test_context_end(context);
}

static bool is_expected(const char *name)
{
    for (size_t i = 0; i < sizeof expectations / sizeof *expectations; i++) {
        if (strcmp(expectations[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* Every kind of the table at its default and at its least resolution: no vertex unused, no face degenerate, no two
 * vertices of a face at one place, and the same bytes for any number of threads. */
static void test_every_kind_of_the_table(void **state)
{
    (void)state;
    size_t count;
    const mt_primitive *primitives = mt_primitives(&count);
    for (size_t i = 0; i < 2 * count; i++) {
        const mt_primitive *primitive = &primitives[i / 2];
        assert_true(is_expected(primitive->name));
        uint64_t hashes[2];
        for (unsigned threads = 1; threads <= 2; threads++) {
            mt_context *context = test_context_with_threads(threads);
            mt_mesh *mesh = generate(context, primitive->name, i % 2 ? primitive->minimum : 0);
            test_census census = test_census_of(mesh);
            assert_int_equal(census.isolated_vertices + census.degenerate_faces, 0);
            for (mt_index face = 0; face < mesh->face_count; face++) {
                mt_index corner = mt_mesh_face_begin(mesh, face);
                mt_vec3 a = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
                mt_vec3 b = mt_mesh_position(mesh, mesh->corner_vertices[corner + 1]);
                mt_vec3 c = mt_mesh_position(mesh, mesh->corner_vertices[corner + 2]);
                assert_false(mt_collinear(a, b, c));
            }
            for (size_t k = 0; k < 3 * (size_t)mesh->vertex_count; k++) {
                double coordinate = ((const double *)mesh->positions)[k];
                assert_true(isfinite(coordinate) && (coordinate != 0 || !signbit(coordinate)));
            }
            hashes[threads - 1] = test_mesh_hash(mesh);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
        }
        assert_true(hashes[0] == hashes[1]);
    }
}

static void test_solids_are_regular(void **state)
{
    (void)state;
    static const char *const names[] = {"tetrahedron", "cube", "octahedron", "icosahedron", "dodecahedron"};
    mt_context *context = test_context();
    for (size_t i = 0; i < 5; i++) {
        mt_mesh *mesh = generate(context, names[i], 0);
        double radius = mt_vec3_length(mt_mesh_position(mesh, 0)), side = 0;
        for (mt_index face = 0; face < mesh->face_count; face++) {
            mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
            for (mt_index corner = begin; corner < end; corner++) {
                mt_vec3 a = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
                mt_vec3 b = mt_mesh_position(mesh, mesh->corner_vertices[corner + 1 < end ? corner + 1 : begin]);
                double length = mt_vec3_length(mt_vec3_subtract(a, b));
                side = side > 0 ? side : length;
                assert_true(fabs(length - side) < 1e-14);
                assert_true(fabs(mt_vec3_length(a) - radius) < 1e-14);
            }
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void test_spheres_have_unit_radius(void **state)
{
    (void)state;
    static const char *const names[] = {"icosphere", "uv-sphere"};
    mt_context *context = test_context();
    for (size_t i = 0; i < 2; i++) {
        mt_mesh *mesh = generate(context, names[i], 0);
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            assert_true(fabs(mt_vec3_length(mt_mesh_position(mesh, vertex)) - 1) < 1e-15);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* At a seam the surface must go on as smoothly as anywhere: the Klein bottle's vertices across its seam lie as near as
 * others do. */
static void test_seams_are_closed(void **state)
{
    (void)state;
    static const char *const names[] = {"torus", "moebius", "klein"};
    mt_context *context = test_context();
    for (size_t i = 0; i < 3; i++) {
        mt_mesh *mesh = generate(context, names[i], 48);
        double longest = 0;
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            mt_vec3 a = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
            mt_vec3 b = mt_mesh_position(mesh, mesh->corner_vertices[corner % 4 == 3 ? corner - 3 : corner + 1]);
            longest = fmax(longest, mt_vec3_length(mt_vec3_subtract(a, b)));
        }
        mt_bounds bounds = mt_mesh_bounds(mesh);
        assert_true(longest < 0.11 * mt_vec3_length(mt_vec3_subtract(bounds.maximum, bounds.minimum)));
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* ---- teapot ---- */

static void test_teapot_has_its_measures(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = generate(context, "teapot", 10);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    assert_true(bounds.minimum.x == -3 && bounds.maximum.y == 3.15);
    assert_true(fabs(bounds.maximum.x - 3.434) < 1e-3);
    assert_true(bounds.minimum.z == -2 && bounds.maximum.z == 2);
    assert_true(bounds.minimum.y > 0 && bounds.minimum.y < 0.01);
    size_t triangles = 0, quads = 0, polygons = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        triangles += sides == 3;
        quads += sides == 4;
        polygons += sides == 40;
    }
    assert_int_equal(triangles, 40);
    assert_int_equal(polygons, 1);
    assert_int_equal(triangles + quads + polygons, mesh->face_count);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static double nearest(const mt_mesh *mesh, mt_vec3 p)
{
    double least = INFINITY;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_vec3 d = mt_vec3_subtract(mt_mesh_position(mesh, vertex), p);
        least = fmin(least, mt_vec3_dot(d, d));
    }
    return sqrt(least);
}

/* The corpus has the same patches cut into ten, written with six digits: each of its vertices is one of ours, the
 * centre of the bottom excepted, and each of ours one of its. */
static void test_teapot_is_the_teapot(void **state)
{
    (void)state;
    FILE *file = fopen("../shared/corpus/teapot.obj", "r");
    if (!file) {
        print_message("skipped: no corpus\n");
        return;
    }
    mt_context *context = test_context();
    mt_mesh *mesh = generate(context, "teapot", 10);
    mt_mesh_layout layout = {.vertex_count = 3644, .position_type = MT_F64};
    mt_mesh *other;
    assert_int_equal(mt_mesh_create(context, &layout, &other), MT_OK);
    char line[256];
    mt_index count = 0;
    while (fgets(line, sizeof line, file) && count < other->vertex_count) {
        mt_vec3 p;
        if (sscanf(line, "v %lf %lf %lf", &p.x, &p.y, &p.z) == 3) {
            mt_mesh_set_position(other, count++, p);
        }
    }
    fclose(file);
    assert_int_equal(count, other->vertex_count);
    for (mt_index vertex = 0; vertex < other->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(other, vertex);
        assert_true(nearest(mesh, p) < 2e-6 || p.y == 0);
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        assert_true(nearest(other, mt_mesh_position(mesh, vertex)) < 2e-6);
    }
    mt_mesh_destroy(context, other);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* How much a face of the teapot looks away from a point, negative: towards it. */
static double look_away(const mt_mesh *mesh, mt_index face, mt_vec3 centre)
{
    const mt_index *v = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
    mt_vec3 a = mt_mesh_position(mesh, v[0]), b = mt_mesh_position(mesh, v[1]), c = mt_mesh_position(mesh, v[2]);
    mt_vec3 normal = mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a));
    return mt_vec3_dot(normal, mt_vec3_subtract(a, centre));
}

/* Faces of the belly look away from the pot's middle, those of handle and spout (its lip
 * excepted) from the middle of their ring. */
static void test_teapot_faces_look_outward(void **state)
{
    (void)state;
    enum { SEGMENTS = 6, AROUND = 4 * SEGMENTS, TUBE = 2 * SEGMENTS };
    mt_context *context = test_context();
    mt_mesh *mesh = generate(context, "teapot", SEGMENTS);
    mt_index body_faces = AROUND * (AROUND - 1) + 1, lid_faces = AROUND * (AROUND / 2);
    for (mt_index face = AROUND * SEGMENTS; face < body_faces; face++) {
        assert_true(look_away(mesh, face, mt_vec3_make(0, 1, 0)) > 0);
    }
    for (mt_index face = body_faces + lid_faces; face < mesh->face_count - TUBE * SEGMENTS; face++) {
        mt_index ring = mesh->corner_vertices[mt_mesh_face_begin(mesh, face)];
        ring -= (ring - (AROUND * AROUND + 1 + AROUND * AROUND / 2)) % TUBE;
        mt_vec3 centre = mt_vec3_make(0, 0, 0);
        for (mt_index i = 0; i < TUBE; i++) {
            centre = mt_vec3_add(centre, mt_vec3_scale(mt_mesh_position(mesh, ring + i), 1.0 / TUBE));
        }
        assert_true(look_away(mesh, face, centre) > 0);
    }
    assert_true(look_away(mesh, body_faces, mt_vec3_make(0, 0, 0)) > 0);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* ---- errors ---- */

static void assert_refused(const char *name, const mt_generate_options *options, const char *fragment)
{
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, options, &mesh), MT_ERROR_ARGUMENT);
    assert_null(mesh);
    assert_non_null(strstr(mt_context_error(context)->message, fragment));
    test_context_end(context);
}

static void test_bad_options_are_refused(void **state)
{
    (void)state;
    assert_refused("pyramid", NULL, "'pyramid'; known are tetrahedron, cube");
    assert_refused("extreme:far", NULL, "'extreme:far'");
    assert_refused("", NULL, "''");
    mt_generate_options options = {.resolution = 2};
    assert_refused("cylinder", &options, "from 3 to");
    assert_refused("cube", &options, "no resolution");
    options.resolution = UINT32_MAX;
    size_t count;
    const mt_primitive *primitives = mt_primitives(&count);
    for (size_t i = 0; i < count; i++) {
        assert_refused(primitives[i].name, &options, primitives[i].name);
    }
    options = (mt_generate_options){.position_type = MT_I32};
    assert_refused("cube", &options, "floats");
}

/* The largest resolutions fit an index: they fail for want of memory and never by wrapping. */
static void test_largest_resolutions_are_counted_rightly(void **state)
{
    (void)state;
    size_t count;
    const mt_primitive *primitives = mt_primitives(&count);
    for (size_t i = 0; i < count; i++) {
        mt_context_options limit = {.memory_limit = 1 << 20};
        mt_context *context = mt_context_create(&limit);
        mt_generate_options options = {.resolution = primitives[i].maximum};
        mt_mesh *mesh = NULL;
        mt_status status = mt_generate(context, primitives[i].name, &options, &mesh);
        assert_int_equal(status, primitives[i].maximum ? MT_ERROR_OUT_OF_MEMORY : MT_OK);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void test_missing_memory_is_an_error(void **state)
{
    (void)state;
    size_t count;
    const mt_primitive *primitives = mt_primitives(&count);
    for (size_t i = 0; i < count; i++) {
        bool succeeded = false;
        for (uint64_t failing = 1; !succeeded; failing++) {
            mt_context_options failure = {.failing_allocation = failing};
            mt_context *context = mt_context_create(&failure);
            mt_generate_options options = {.position_type = MT_F32};
            mt_mesh *mesh = NULL;
            mt_status status = mt_generate(context, primitives[i].name, &options, &mesh);
            succeeded = status == MT_OK;
            assert_true(succeeded ? mesh->position_type == MT_F32 : !mesh && status == MT_ERROR_OUT_OF_MEMORY);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
            assert_true(failing < 100);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_kind_is_what_it_says),
        cmocka_unit_test(test_every_kind_of_the_table),
        cmocka_unit_test(test_solids_are_regular),
        cmocka_unit_test(test_spheres_have_unit_radius),
        cmocka_unit_test(test_seams_are_closed),
        cmocka_unit_test(test_teapot_has_its_measures),
        cmocka_unit_test(test_teapot_is_the_teapot),
        cmocka_unit_test(test_teapot_faces_look_outward),
        cmocka_unit_test(test_bad_options_are_refused),
        cmocka_unit_test(test_largest_resolutions_are_counted_rightly),
        cmocka_unit_test(test_missing_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
