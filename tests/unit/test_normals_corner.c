/* Normals of corners beside their definition, pair by pair: random meshes and the zoo at many thresholds, bow-ties,
 * creases that end, angles of exactly the threshold, and a vertex of many faces. */
#include "tests/support/unit.h"

#include "tests/support/cage.h"
#include "tests/support/normals_reference.h"
#include "tests/support/zoo.h"

#include <meshtool/elementary.h>

#include <math.h>
#include <string.h>

/* Thresholds that no two faces of these meshes meet at. */
static const double angles[] = {0.01234, 0.5123, 0, 1.2345, 1.5801, 2.7182, MT_PI, -1};
#define ANGLE_COUNT (sizeof angles / sizeof *angles)

static void expect_corners(mt_context *context, mt_mesh *mesh, double tolerance, const char *what)
{
    for (size_t i = 0; i < ANGLE_COUNT; i++) {
        for (int reachable = 0; reachable < 2; reachable++) {
            mt_normal_options options = {.kind = MT_NORMALS_CORNER,
                                         .weight = (mt_normal_weight)(i % 4),
                                         .crease_angle = angles[i],
                                         .reachable_only = reachable};
            test_expect_normals(context, mesh, &options, tolerance, what);
        }
    }
}

static void test_random_cages(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {31};
    for (mt_index trial = 0; trial < 6; trial++) {
        mt_mesh *mesh = test_cage(context, &random, 3 + trial % 3, 3 + trial % 2, trial % 2);
        expect_corners(context, mesh, 1e-12, "cage");
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Points on a small lattice, faces at random: non-manifold everywhere, many faces of one plane or opposite. */
static mt_mesh *random_soup(mt_context *context, test_random *random)
{
    double points[3 * 8];
    mt_index faces[5 * 14], *face = faces;
    for (size_t i = 0; i < 24; i++) {
        points[i] = (double)test_random_below(random, 4) + 0.13 * test_random_unit(random);
    }
    for (int i = 0; i < 14; i++) {
        *face++ = 3 + (mt_index)test_random_below(random, 2);
        for (mt_index side = 0, sides = face[-1]; side < sides; side++) {
            *face++ = (mt_index)test_random_below(random, 8);
        }
    }
    return test_mesh(context, 8, points, 14, faces);
}

static void test_random_soups(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {32};
    for (mt_index trial = 0; trial < 60; trial++) {
        mt_mesh *mesh = random_soup(context, &random);
        expect_corners(context, mesh, 1e-9, "soup"); /* where faces nearly cancel, digits go */
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Two pyramids that share their tip, apart from each other: a normal each. */
static void test_bow_tie(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double points[] = {0, 0, 0, 3, 1, 0, 3, -1, 0, 3, 0, 1, -3, 1, 0, -3, 0, 1, -3, -1, 0};
    const mt_index faces[] = {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 1, 3, 0, 4, 5, 3, 0, 5, 6, 3, 0, 6, 4};
    mt_mesh *mesh = test_mesh(context, 7, points, 6, faces);
    mt_normal_options options = {.kind = MT_NORMALS_CORNER, .crease_angle = 3};
    test_expect_normals(context, mesh, &options, 1e-15, "bow-tie");
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    assert_int_equal(normals->indices[0], normals->indices[3]);
    assert_int_equal(normals->indices[9], normals->indices[12]);
    assert_int_not_equal(normals->indices[0], normals->indices[9]);
    assert_true(mt_attribute_get(normals, normals->indices[0], 0) < 0);
    assert_true(mt_attribute_get(normals, normals->indices[9], 0) > 0);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Two faces of like direction with a steep wall between them: each counts for the other, unless it must be reached. */
static void test_reachable(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 5, -1, 1, 0, -1, 0, 0.1};
    const mt_index faces[] = {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 4, 3, 0, 4, 5};
    mt_mesh *mesh = test_mesh(context, 6, points, 4, faces);
    mt_normal_options options = {.kind = MT_NORMALS_CORNER, .crease_angle = 0.5};
    test_expect_normals(context, mesh, &options, 1e-15, "wall");
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    assert_int_equal(normals->indices[0], normals->indices[9]);
    options.reachable_only = true;
    test_expect_normals(context, mesh, &options, 1e-15, "wall");
    normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    assert_int_not_equal(normals->indices[0], normals->indices[9]);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* The sides of a prism, whose neighbours meet at 360/n degrees. */
static mt_mesh *make_prism(mt_context *context, mt_index n, mt_type type, double turn)
{
    mt_mesh_layout layout = {.vertex_count = 2 * n, .face_count = n, .face_size = 4, .position_type = type};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index i = 0; i < n; i++) {
        double at = turn + 2 * MT_PI * i / n;
        mt_mesh_set_position(mesh, 2 * i, mt_vec3_make(mt_cos(at), mt_sin(at), 0));
        mt_mesh_set_position(mesh, 2 * i + 1, mt_vec3_make(mt_cos(at), mt_sin(at), 1));
        mt_index next = (i + 1) % n;
        const mt_index face[] = {2 * i, 2 * next, 2 * next + 1, 2 * i + 1};
        memcpy(mesh->corner_vertices + 4 * i, face, sizeof face);
    }
    return mesh;
}

static mt_index count_values(mt_context *context, mt_mesh *mesh, double angle)
{
    mt_normal_options options = {.kind = MT_NORMALS_CORNER, .crease_angle = angle};
    mt_normal_report report;
    assert_int_equal(mt_mesh_add_normals(context, mesh, &options, &report), MT_OK);
    return report.value_count;
}

/* Whatever the rounding of the points, in either precision and however the prism is turned: at the angle itself every
 * edge is a crease, at a hair more none is. */
static void test_exactly_at_the_threshold(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (mt_index n = 4; n <= 120; n++) {
        for (int turn = 0; turn < 4; turn++) {
            for (mt_type type = MT_F32; type <= MT_F64; type++) {
                mt_mesh *prism = make_prism(context, n, type, 0.1 * turn);
                double angle = 2 * MT_PI / n, hair = type == MT_F32 ? 1e-4 : 1e-9;
                assert_int_equal(count_values(context, prism, angle), 4 * n);
                assert_int_equal(count_values(context, prism, angle + hair), 2 * n);
                assert_int_equal(count_values(context, prism, angle - hair), 4 * n);
                mt_mesh_destroy(context, prism);
            }
        }
    }
    test_context_end(context);
}

/* No regular polygon has the default between its sides. */
static void test_default_threshold(void **state)
{
    (void)state;
    for (int n = 3; n < 1000; n++) {
        assert_true(fabs(MT_DEFAULT_CREASE_ANGLE - 2 * MT_PI / n) > 0.017);
    }
    assert_true(fabs(MT_DEFAULT_CREASE_ANGLE - 41 * MT_PI / 180) < 1e-15);
}

/* A cone, or a tip of faces in all directions, of more corners than are compared pair by pair. */
static mt_mesh *make_tip(mt_context *context, test_random *random, mt_index n, bool wild, bool closed)
{
    mt_mesh_layout layout = {
        .vertex_count = n + 1, .face_count = closed ? n : n - 1, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    mt_mesh_set_position(mesh, 0, mt_vec3_make(0, 0, 1));
    for (mt_index i = 0; i < n; i++) {
        double at = 2 * MT_PI * (i + (wild ? test_random_unit(random) : 0)) / n;
        double height = wild ? test_random_unit(random) * 2 : 0;
        mt_mesh_set_position(mesh, i + 1, mt_vec3_make(mt_cos(at), mt_sin(at), height));
    }
    for (mt_index i = 0; i < mesh->face_count; i++) {
        const mt_index face[] = {0, i + 1, (i + 1) % n + 1};
        memcpy(mesh->corner_vertices + 3 * i, face, sizeof face);
    }
    return mesh;
}

static void test_many_faces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {33};
    for (int trial = 0; trial < 12; trial++) {
        mt_mesh *mesh = make_tip(context, &random, 65 + 3 * (mt_index)trial, trial % 2, trial % 4 < 2);
        mt_normal_options options = {.kind = MT_NORMALS_CORNER,
                                     .weight = (mt_normal_weight)(trial % 4),
                                     .crease_angle = angles[trial % (int)ANGLE_COUNT],
                                     .reachable_only = trial % 3 == 0};
        test_expect_normals(context, mesh, &options, 1e-12, "tip");
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* A million faces around a vertex take no time worth mentioning; each corner's normal lies in the middle of its arc. */
static void test_a_million_faces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {34};
    const mt_index n = 1000000;
    mt_mesh *mesh = make_tip(context, &random, n, false, true);
    mt_normal_options options = {.kind = MT_NORMALS_CORNER, .crease_angle = 0.4999};
    mt_normal_report report;
    assert_int_equal(mt_mesh_add_normals(context, mesh, &options, &report), MT_OK);
    double largest = 0;
    for (mt_index face = 0; face < n; face += 997) {
        double at = 2 * MT_PI * (face + 0.5) / n;
        mt_vec3 n_at_tip = test_stored_normal(mesh, MT_DOMAIN_CORNER, 3 * face);
        double angle = mt_atan2(n_at_tip.y, n_at_tip.x) - at;
        angle = fabs(angle + 2 * MT_PI) < fabs(angle) ? angle + 2 * MT_PI : angle;
        largest = fmax(largest, fabs(angle));
    }
    print_message("a tip of %u faces: corners lean at most %.2g to a side\n", n, largest);
    assert_true(largest < 1e-7);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_zoo_by_definition(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context();
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        if (animals[i].mesh->corner_count < 400) {
            mt_normal_options options = {.kind = MT_NORMALS_CORNER, .type = MT_F64};
            test_expect_normals(context, animals[i].mesh, &options, 1e-12, animals[i].name);
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_cages),
        cmocka_unit_test(test_random_soups),
        cmocka_unit_test(test_bow_tie),
        cmocka_unit_test(test_reachable),
        cmocka_unit_test(test_exactly_at_the_threshold),
        cmocka_unit_test(test_default_threshold),
        cmocka_unit_test(test_many_faces),
        cmocka_unit_test(test_a_million_faces),
        cmocka_unit_test(test_zoo_by_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
