/* Normals of faces and vertices: known ones, all weights beside their definitions over random meshes and over the zoo,
 * what has no direction, and where the results go. */
#include "tests/support/unit.h"

#include "tests/support/cage.h"
#include "tests/support/laden_mesh.h"
#include "tests/support/normals_reference.h"
#include "tests/support/zoo.h"

#include <meshtool/generate.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void expect_direction(mt_vec3 n, double x, double y, double z)
{
    double length = sqrt(x * x + y * y + z * z);
    mt_vec3 expected = length > 0 ? mt_vec3_make(x / length, y / length, z / length) : mt_vec3_make(0, 0, 0);
    if (!(mt_vec3_max_abs(mt_vec3_subtract(n, expected)) <= 4 * DBL_EPSILON)) {
        fail_msg("(%.17g %.17g %.17g) where (%.17g %.17g %.17g) is right", n.x, n.y, n.z, expected.x, expected.y,
                 expected.z);
    }
}

static mt_normal_report add(mt_context *context, mt_mesh *mesh, mt_normal_options options)
{
    mt_normal_report report;
    assert_int_equal(mt_mesh_add_normals(context, mesh, &options, &report), MT_OK);
    return report;
}

static void test_of_a_cube(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube;
    assert_int_equal(mt_generate(context, "cube", NULL, &cube), MT_OK);
    for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
        add(context, cube, (mt_normal_options){.weight = weight});
        for (mt_index vertex = 0; vertex < 8; vertex++) {
            mt_vec3 p = mt_mesh_position(cube, vertex);
            expect_direction(test_stored_normal(cube, MT_DOMAIN_VERTEX, vertex), p.x, p.y, p.z);
        }
    }
    mt_normal_report report = add(context, cube, (mt_normal_options){.kind = MT_NORMALS_CORNER});
    assert_int_equal(report.value_count, 24);
    assert_int_equal(report.element_count, 24);
    report = add(context, cube, (mt_normal_options){.kind = MT_NORMALS_CORNER, .crease_angle = 1.6});
    assert_int_equal(report.value_count, 8);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* One vertex of two faces whose areas are 1 : 4 and whose angles are equal. */
static void test_weights_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 4, 0, 0, 0, 1};
    const mt_index faces[] = {3, 0, 1, 2, 3, 0, 3, 4};
    mt_mesh *mesh = test_mesh(context, 5, points, 2, faces);
    const double expected[][3] = {{4, 0, 1}, {1, 0, 1}, {0.25, 0, 1}, {1, 0, 1}};
    for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
        add(context, mesh, (mt_normal_options){.weight = weight});
        const double *e = expected[weight];
        expect_direction(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 0), e[0], e[1], e[2]);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Max's weights are exact where a vertex and its neighbours lie on a sphere. */
static void test_max_on_a_sphere(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {7};
    double points[3 * 12];
    mt_index faces[4 * 11];
    for (int trial = 0; trial < 50; trial++) {
        double at = 0;
        points[0] = points[1] = 0, points[2] = 1;
        for (int i = 1; i < 12; i++) {
            at += 0.1 + 0.8 * test_random_unit(&random);
            double down = 0.1 + 1.2 * test_random_unit(&random);
            points[3 * i] = sin(down) * cos(at), points[3 * i + 1] = sin(down) * sin(at), points[3 * i + 2] = cos(down);
        }
        mt_index count = 0;
        for (mt_index i = 1; i < 12; i++) {
            const mt_index face[] = {3, 0, i, i < 11 ? i + 1 : 1};
            memcpy(faces + 4 * count++, face, sizeof face);
        }
        mt_mesh *mesh = test_mesh(context, 12, points, count, faces);
        add(context, mesh, (mt_normal_options){.weight = MT_NORMAL_WEIGHT_MAX});
        double angle = test_angle_between(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 0), mt_vec3_make(0, 0, 1));
        assert_true(angle < 1e-13);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* The area vector of a quad is half the cross product of its diagonals, planar or not. */
static void test_polygons(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double bent[] = {0, 0, 0, 2, 0, 1, 3, 2, 0, 0, 1, 1};
    const mt_index quad[] = {4, 0, 1, 2, 3};
    mt_mesh *mesh = test_mesh(context, 4, bent, 1, quad);
    add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_FACE});
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_FACE, 0), 0, 0, 7);
    mt_mesh_destroy(context, mesh);
    /* An L whose first corner is the reflex one: there its angle is 270 degrees. */
    const double hook[] = {1, 1, 0, 1, 2, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 1, 1, 2, 1};
    const mt_index faces[] = {6, 0, 1, 2, 3, 4, 5, 4, 0, 6, 7, 1};
    mesh = test_mesh(context, 8, hook, 2, faces);
    add(context, mesh, (mt_normal_options){.weight = MT_NORMAL_WEIGHT_ANGLE});
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 0), -1, 0, 3);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void expect_all_kinds(mt_context *context, mt_mesh *mesh, const char *what)
{
    for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
        test_expect_normals(context, mesh, &(mt_normal_options){.weight = weight}, 1e-12, what);
    }
    test_expect_normals(context, mesh, &(mt_normal_options){.kind = MT_NORMALS_FACE}, 1e-13, what);
}

static void test_random_cages(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {20};
    for (mt_index trial = 0; trial < 40; trial++) {
        mt_mesh *mesh = test_cage(context, &random, 3 + trial % 6, 3 + trial % 4, trial % 2);
        expect_all_kinds(context, mesh, "cage");
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Broken meshes too, each in both precisions. Where faces around a vertex cancel, what is left is rounding: such
 * animals are looked at for numbers alone. */
static void test_zoo_by_definition(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context();
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        mt_mesh *mesh = animals[i].mesh;
        test_expect_normals(context, mesh, &(mt_normal_options){.kind = MT_NORMALS_FACE, .type = MT_F64}, 1e-12,
                            animals[i].name);
        for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
            add(context, mesh, (mt_normal_options){.weight = weight});
            for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
                mt_vec3 n = test_stored_normal(mesh, MT_DOMAIN_VERTEX, vertex);
                double length = mt_vec3_length(n);
                assert_true(length == 0 || fabs(length - 1) < 1e-6);
            }
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

/* A face of no area, one with a NaN, one with an infinity, a repeated vertex, an isolated vertex. */
static void test_what_has_no_direction(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, NAN, 0, 0, 0, INFINITY, 0, 9, 9, 9, 7, 7, 7};
    const mt_index faces[] = {3, 0, 1, 2, 3, 0, 1, 3, 3, 0, 1, 4, 3, 0, 5, 1, 4, 0, 1, 1, 2, 3, 3, 7, 3};
    mt_mesh *mesh = test_mesh(context, 8, points, 6, faces);
    mt_normal_report report = add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_FACE});
    assert_int_equal(report.undefined_count, 4);
    assert_int_equal(report.element_count, 6);
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_FACE, 0), 0, 0, 1);
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_FACE, 1), 0, 0, 0);
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_FACE, 2), 0, 0, 0);
    expect_direction(test_stored_normal(mesh, MT_DOMAIN_FACE, 4), 0, 0, 1);
    for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
        for (mt_normal_kind kind = MT_NORMALS_VERTEX; kind <= MT_NORMALS_CORNER; kind += 2) {
            report = add(context, mesh, (mt_normal_options){.kind = kind, .weight = weight});
            assert_int_equal(report.undefined_count, kind == MT_NORMALS_VERTEX ? 5 : 6);
        }
        add(context, mesh, (mt_normal_options){.weight = weight});
        expect_direction(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 0), 0, 0, 1);
        expect_direction(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 3), 0, 0, 0);
        expect_direction(test_stored_normal(mesh, MT_DOMAIN_VERTEX, 6), 0, 0, 0);
    }
    mt_mesh_destroy(context, mesh);
    mesh = test_mesh(context, 0, points, 0, faces);
    for (mt_normal_kind kind = MT_NORMALS_VERTEX; kind <= MT_NORMALS_CORNER; kind++) {
        report = add(context, mesh, (mt_normal_options){.kind = kind, .weight = MT_NORMAL_WEIGHT_ANGLE});
        assert_int_equal(report.value_count, 0);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static mt_index count_normals(const mt_mesh *mesh, mt_domain domain)
{
    mt_index count = 0;
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        count += mesh->attributes[i].semantic == MT_SEMANTIC_NORMAL && mesh->attributes[i].domain == domain;
    }
    return count;
}

static void test_where_they_go(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh;
    assert_int_equal(test_laden_mesh(context, &mesh), MT_OK);
    add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_CORNER, .type = MT_F32});
    mt_index others =
        mesh->attribute_count - count_normals(mesh, MT_DOMAIN_CORNER) - count_normals(mesh, MT_DOMAIN_FACE);
    assert_int_equal(count_normals(mesh, MT_DOMAIN_VERTEX), 0);
    assert_int_equal(mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER)->type, MT_F32);
    add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_FACE});
    add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_FACE, .type = MT_F64});
    add(context, mesh, (mt_normal_options){.kind = MT_NORMALS_VERTEX});
    assert_int_equal(count_normals(mesh, MT_DOMAIN_VERTEX), 1);
    assert_int_equal(count_normals(mesh, MT_DOMAIN_CORNER), 0);
    assert_int_equal(count_normals(mesh, MT_DOMAIN_FACE), 1);
    assert_int_equal(mesh->attribute_count, others + 2);
    mt_normal_options wrong = {.type = MT_I16};
    assert_int_equal(mt_mesh_add_normals(context, mesh, &wrong, NULL), MT_ERROR_ARGUMENT);
    mt_context_clear_error(context);
    wrong = (mt_normal_options){.kind = MT_NORMALS_CORNER, .crease_angle = 4};
    assert_int_equal(mt_mesh_add_normals(context, mesh, &wrong, NULL), MT_ERROR_ARGUMENT);
    assert_non_null(strstr(mt_context_error(context)->message, "0 and 180"));
    assert_int_equal(mesh->attribute_count, others + 2);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static bool refuse(void *user, const char *task, double fraction)
{
    (void)user, (void)task, (void)fraction;
    return false;
}

/* Returns the status; a failure leaves the mesh as it was. */
static mt_status try_adding(const mt_context_options *options, const mt_normal_options *how)
{
    mt_context *context = mt_context_create(options);
    mt_mesh *mesh = NULL;
    mt_status status = test_laden_mesh(context, &mesh);
    if (status == MT_OK) {
        uint64_t hash = test_mesh_hash(mesh);
        status = mt_mesh_add_normals(context, mesh, how, NULL);
        assert_true((test_mesh_hash(mesh) == hash) == (status != MT_OK));
        assert_int_equal(mt_context_error(context)->status, status);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return status;
}

static void test_failures(void **state)
{
    (void)state;
    const mt_normal_options how[] = {
        {.type = MT_F32}, {.weight = MT_NORMAL_WEIGHT_ANGLE}, {.kind = MT_NORMALS_FACE}, {.kind = MT_NORMALS_CORNER}};
    for (size_t i = 0; i < sizeof how / sizeof *how; i++) {
        mt_context_options options = {.thread_count = 2, .failing_allocation = 1};
        while (try_adding(&options, &how[i]) != MT_OK) {
            options.failing_allocation++;
        }
        print_message("kind %d, weight %d: %llu allocations\n", how[i].kind, how[i].weight,
                      (unsigned long long)options.failing_allocation - 1);
        options = (mt_context_options){.progress = refuse};
        assert_int_equal(try_adding(&options, &how[i]), MT_ERROR_CANCELLED);
    }
}

/* Faces that look up, near their vertices or anywhere, over more vertices than are summed in one piece of memory; some
 * too thin for plain doubles, and vertices of none in between. */
static mt_mesh *make_sheet(mt_context *context, bool near, mt_type type)
{
    test_random random = {near};
    mt_mesh_layout layout = {.vertex_count = 9000, .face_count = 4001, .face_size = 3, .position_type = type};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index vertex = 0; vertex < layout.vertex_count; vertex++) {
        double x = test_random_unit(&random), y = test_random_unit(&random);
        mt_mesh_set_position(mesh, vertex, mt_vec3_make(x, y, 0.1 * test_random_unit(&random)));
    }
    for (mt_index face = 0; face < layout.face_count; face++) {
        mt_index *corner = mesh->corner_vertices + 3 * (size_t)face;
        mt_index begin = near ? face : 0, count = near ? 40 : 5000;
        for (int i = 0; i < 3; i++) {
            corner[i] = begin + (mt_index)(test_random_next(&random) % count);
        }
        if (face % 50 == 7) {
            mt_vec3 a = mt_mesh_position(mesh, corner[0]);
            corner[1] = 8900 + face / 50;
            mt_mesh_set_position(mesh, corner[1], mt_vec3_make(a.x + 0x1p-30, a.y, a.z));
        }
    }
    for (mt_index face = 0; face < layout.face_count; face++) {
        mt_index *corner = mesh->corner_vertices + 3 * (size_t)face;
        mt_vec3 a = mt_mesh_position(mesh, corner[0]), b = mt_mesh_position(mesh, corner[1]);
        mt_vec3 c = mt_mesh_position(mesh, corner[2]);
        if (mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a)).z < 0) {
            mt_index second = corner[1];
            corner[1] = corner[2];
            corner[2] = second;
        }
    }
    return mesh;
}

static void test_sheets_of_many_vertices(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        uint64_t hash = 0;
        for (unsigned threads = 1; threads <= 4; threads++) {
            mt_context *context = test_context_with_threads(threads);
            mt_type type = i / 2 ? MT_F32 : MT_F64;
            double tolerance = type == MT_F64 ? 0x1p-33 : 1e-6; /* see MT_AREA_CANCELLATION */
            mt_mesh *mesh = make_sheet(context, i % 2, type);
            if (threads == 1) {
                test_expect_normals(context, mesh, &(mt_normal_options){0}, tolerance, "sheet");
            } else {
                add(context, mesh, (mt_normal_options){0});
                assert_true(test_mesh_hash(mesh) == hash);
            }
            hash = test_mesh_hash(mesh);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_of_a_cube),         cmocka_unit_test(test_weights_by_hand),
        cmocka_unit_test(test_max_on_a_sphere),   cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_random_cages),      cmocka_unit_test(test_sheets_of_many_vertices),
        cmocka_unit_test(test_zoo_by_definition), cmocka_unit_test(test_what_has_no_direction),
        cmocka_unit_test(test_where_they_go),     cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
