/* Repair: each step on what it is for, nothing unasked, the account, and a second repair that changes nothing. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/generate.h>
#include <meshtool/halfedge.h>
#include <meshtool/manifold.h>
#include <meshtool/repair.h>

#include <string.h>

static mt_mesh *repair_with(mt_context *context, const mt_mesh *mesh, mt_repair_options options,
                            mt_repair_report *report)
{
    mt_mesh *out = NULL;
    assert_int_equal(mt_repair(context, mesh, &options, report, &out), MT_OK);
    assert_int_equal(mt_mesh_validate(context, out), MT_OK);
    return out;
}

static mt_repair_options only(mt_repair_step step)
{
    mt_repair_options options = {0};
    options.steps[step] = true;
    return options;
}

static mt_repair_options everything(void)
{
    mt_repair_options options = {0};
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        options.steps[step] = true;
    }
    return options;
}

static const double corners_of_a_cube[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};

static void nothing_asked_changes_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_index faces[] = {4, 0, 1, 2, 3, 4, 0, 1, 2, 3, 3, 4, 4, 5};
    mt_mesh *mesh = test_mesh(context, 8, corners_of_a_cube, 3, faces);
    mt_repair_report report;
    mt_mesh *same = repair_with(context, mesh, (mt_repair_options){0}, &report);
    assert_int_equal(test_mesh_hash(mesh), test_mesh_hash(same));
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, same);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void faces_without_area_go_and_are_named(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0};
    const mt_index faces[] = {3, 0, 1, 3, 3, 0, 1, 2, 3, 1, 1, 3, 4, 0, 1, 2, 3};
    mt_mesh *mesh = test_mesh(context, 4, positions, 4, faces);
    mt_repair_report report;
    mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_DROP_DEGENERATE), &report);
    const mt_repair_result *result = &report.results[MT_REPAIR_DROP_DEGENERATE];
    assert_int_equal(result->count, 2);
    assert_int_equal(result->faces[0], 1);
    assert_int_equal(result->faces[1], 2);
    assert_int_equal(mended->face_count, 2);
    assert_int_equal(mt_mesh_face_sides(mended, 1), 4);
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, mended);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void duplicates_go_in_either_direction(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_index faces[] = {4, 0, 1, 2, 3, 4, 2, 3, 0, 1, 4, 1, 0, 3, 2, 4, 0, 2, 1, 3};
    mt_mesh *mesh = test_mesh(context, 8, corners_of_a_cube, 4, faces);
    mt_repair_report report;
    mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_DROP_DUPLICATES), &report);
    assert_int_equal(report.results[MT_REPAIR_DROP_DUPLICATES].count, 2);
    assert_int_equal(mended->face_count, 2);
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, mended);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static double volume_of(mt_context *context, const mt_mesh *mesh)
{
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_true(report.has_volume);
    double volume = report.volume;
    mt_manifold_report_release(context, &report);
    return volume;
}

/* Any faces of a solid turned over: all run outwards again, and turned normals with them. */
static void orientation_comes_back_outwards(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {5};
    for (int round = 0; round < 20; round++) {
        mt_mesh *mesh;
        assert_int_equal(mt_generate(context, "icosphere", &(mt_generate_options){.resolution = 1}, &mesh), MT_OK);
        for (mt_index face = 0; face < mesh->face_count; face++) {
            mt_index *corner = mesh->corner_vertices + 3 * (size_t)face;
            if (round == 0 || test_random_below(&random, 2)) {
                mt_index swapped = corner[1];
                corner[1] = corner[2];
                corner[2] = swapped;
            }
        }
        mt_repair_report report;
        mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_ORIENT), &report);
        assert_true(volume_of(context, mended) > 0);
        assert_int_equal(report.results[MT_REPAIR_ORIENT].left_count, 0);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, mended);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void a_moebius_strip_is_left_as_it_is(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh;
    assert_int_equal(mt_generate(context, "moebius", NULL, &mesh), MT_OK);
    mt_repair_report report;
    mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_ORIENT), &report);
    assert_int_equal(report.results[MT_REPAIR_ORIENT].count, 0);
    assert_int_equal(report.results[MT_REPAIR_ORIENT].left_count, 1);
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, mended);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A cube without its top, and one without two neighbouring sides: the first hole is planar, the second is not. */
static void holes_are_closed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_index faces[] = {4, 0, 3, 2, 1, 4, 0, 1, 5, 4, 4, 1, 2, 6, 5, 4, 3, 0, 4, 7, 4, 2, 3, 7, 6};
    for (mt_index missing = 0; missing < 2; missing++) {
        mt_mesh *mesh = test_mesh(context, 8, corners_of_a_cube, 5 - missing, faces);
        mt_repair_report report;
        mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_FILL_HOLES), &report);
        assert_int_equal(report.results[MT_REPAIR_FILL_HOLES].count, 1);
        assert_int_equal(report.results[MT_REPAIR_FILL_HOLES].face_count, missing ? 4 : 2);
        assert_true(volume_of(context, mended) > 0.49);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, mended);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* A concave, planar hole: only the polygon's own triangulation covers it without overlap. */
static void a_concave_planar_hole_keeps_its_area(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 2, 1, 0, 0, 4, 0, 2, 2, -3};
    const mt_index faces[] = {3, 1, 0, 5, 3, 2, 1, 5, 3, 3, 2, 5, 3, 4, 3, 5, 3, 0, 4, 5};
    mt_mesh *mesh = test_mesh(context, 6, positions, 5, faces);
    mt_repair_report report;
    mt_mesh *mended = repair_with(context, mesh, only(MT_REPAIR_FILL_HOLES), &report);
    double area = 0;
    for (mt_index face = 5; face < mended->face_count; face++) {
        const mt_index *corner = mended->corner_vertices + 3 * (size_t)face;
        mt_vec3 p = mt_mesh_position(mended, corner[0]);
        mt_vec3 a = mt_vec3_subtract(mt_mesh_position(mended, corner[1]), p);
        mt_vec3 b = mt_vec3_subtract(mt_mesh_position(mended, corner[2]), p);
        area += mt_vec3_cross(a, b).z / 2;
    }
    assert_true(area == 10); /* 16 less a triangle of 4 by 3 */
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, mended);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void welding_within_a_distance_joins_the_first(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 0.09, 0, 0, 0.18, 0, 0, 1, 0, 0, NAN, 0, 0, 1, 0.05, 0, 0, 1, 0};
    const mt_index faces[] = {3, 0, 3, 6, 3, 1, 5, 6, 3, 2, 4, 6};
    mt_mesh *mesh = test_mesh(context, 7, positions, 3, faces);
    mt_repair_options options = {.weld_tolerance = 0.1};
    options.steps[MT_REPAIR_WELD] = true;
    mt_repair_report report;
    mt_mesh *mended = repair_with(context, mesh, options, &report);
    const mt_repair_result *result = &report.results[MT_REPAIR_WELD];
    assert_int_equal(result->count, 2);
    assert_int_equal(result->vertices[0], 1);
    assert_int_equal(result->vertices[1], 5);
    assert_int_equal(mended->corner_vertices[3], 0);
    assert_int_equal(mended->corner_vertices[4], mended->corner_vertices[1]);
    mt_repair_report_release(context, &report);
    mt_mesh_destroy(context, mended);
    options.weld_tolerance = NAN;
    assert_int_equal(mt_repair(context, mesh, &options, &report, &mended), MT_ERROR_ARGUMENT);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static mt_mesh *random_soup(mt_context *context, test_random *random)
{
    double positions[3 * 24];
    mt_index faces[6 * 40], *to = faces;
    mt_index vertices = 4 + (mt_index)test_random_below(random, 20), count = (mt_index)test_random_below(random, 40);
    for (mt_index i = 0; i < 3 * vertices; i++) {
        positions[i] = (double)test_random_below(random, 3);
    }
    for (mt_index face = 0; face < count; face++) {
        mt_index sides = 3 + (mt_index)test_random_below(random, 3);
        *to++ = sides;
        for (mt_index side = 0; side < sides; side++) {
            *to++ = (mt_index)test_random_below(random, vertices);
        }
    }
    return test_mesh(context, vertices, positions, count, faces);
}

/* Whatever goes in: what comes out has no defect that the steps are for, and a second repair changes nothing. */
static void everything_at_once_mends_any_soup_for_good(void **state)
{
    (void)state;
    test_random random = {99};
    for (int round = 0; round < 600; round++) {
        mt_context *context = test_context_with_threads(1);
        mt_mesh *mesh = random_soup(context, &random);
        mt_repair_report report, second;
        mt_mesh *mended = repair_with(context, mesh, everything(), &report);
        mt_mesh *again = repair_with(context, mended, everything(), &second);
        assert_int_equal(test_mesh_hash(mended), test_mesh_hash(again));
        for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
            assert_int_equal(second.results[step].count, 0);
        }
        mt_manifold_report check;
        assert_int_equal(mt_check_manifold(context, mended, NULL, &check), MT_OK);
        assert_true(check.manifold_class != MT_NON_MANIFOLD);
        assert_int_equal(check.defect_counts[MT_DEFECT_DUPLICATE_FACE], 0);
        assert_int_equal(check.defect_counts[MT_DEFECT_ISOLATED_VERTEX], 0);
        assert_int_equal(check.defect_counts[MT_DEFECT_ZERO_AREA_FACE], 0);
        assert_true(check.oriented == MT_YES || check.orientable == MT_NO);
        mt_manifold_report_release(context, &check);
        mt_repair_report_release(context, &second);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mended);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* The same for any choice of steps, with and without a distance for welding. */
static void any_steps_twice_are_as_once(void **state)
{
    (void)state;
    test_random random = {7};
    for (int round = 0; round < 1000; round++) {
        mt_context *context = test_context_with_threads(1);
        mt_mesh *mesh = random_soup(context, &random);
        mt_repair_options options = {.weld_tolerance = (double)test_random_below(&random, 3) / 2};
        for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
            options.steps[step] = test_random_below(&random, 3) != 0;
        }
        mt_repair_report report, second;
        mt_mesh *mended = repair_with(context, mesh, options, &report);
        mt_mesh *again = repair_with(context, mended, options, &second);
        assert_int_equal(test_mesh_hash(mended), test_mesh_hash(again));
        for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
            assert_int_equal(second.results[step].count, 0);
            assert_int_equal(second.results[step].face_count + second.results[step].vertex_count, 0);
            assert_int_equal(second.results[step].left_count, report.results[step].left_count);
        }
        mt_repair_report_release(context, &second);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mended);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void each_failing_allocation_is_clean(void **state)
{
    (void)state;
    mt_context *makers = test_context();
    test_random random = {4};
    mt_mesh *mesh = random_soup(makers, &random);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        mt_repair_options steps = everything();
        mt_repair_report report;
        mt_mesh *mended;
        status = mt_repair(context, mesh, &steps, &report, &mended);
        assert_true(status == MT_OK || (status == MT_ERROR_OUT_OF_MEMORY && mended == NULL));
        assert_int_equal(status, mt_context_error(context)->status);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, mended);
        test_context_end(context);
    }
    mt_mesh_destroy(makers, mesh);
    test_context_end(makers);
}

/* A grid of 6 x 6 squares without the inner four: its hole is filled, its rim would be covered by its own faces. Bent,
 * it is filled at both, unless that takes too many sides. */
static void flat_sheets_keep_their_rims(void **state)
{
    (void)state;
    static const struct {
        double height;
        mt_index most;
        uint64_t filled, left;
    } cases[] = {{0, 0, 1, 1}, {1e-15, 0, 2, 0}, {1, 0, 2, 0}, {1, 8, 1, 1}, {0, 8, 1, 1}, {1, 7, 0, 2}, {1, 24, 2, 0}};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double positions[3 * 49];
        mt_index faces[5 * 32], face_count = 0;
        for (mt_index v = 0; v < 49; v++) {
            positions[3 * v] = v % 7;
            positions[3 * v + 1] = 5; /* not through the origin */
            positions[3 * v + 2] = v / 7;
        }
        positions[1] += cases[i].height;
        for (mt_index cell = 0; cell < 36; cell++) {
            mt_index column = cell % 6, row = cell / 6, v = 7 * row + column;
            if (column < 2 || column > 3 || row < 2 || row > 3) {
                const mt_index face[] = {4, v, v + 1, v + 8, v + 7};
                memcpy(faces + 5 * face_count++, face, sizeof face);
            }
        }
        mt_mesh *mesh = test_mesh(context, 49, positions, face_count, faces);
        mt_repair_options options = only(MT_REPAIR_FILL_HOLES);
        options.hole_sides_maximum = cases[i].most;
        mt_repair_report report;
        mt_mesh *mended = repair_with(context, mesh, options, &report);
        assert_int_equal(report.results[MT_REPAIR_FILL_HOLES].count, cases[i].filled);
        assert_int_equal(report.results[MT_REPAIR_FILL_HOLES].left_count, cases[i].left);
        mt_repair_report_release(context, &report);
        mt_mesh_destroy(context, mended);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_asked_changes_nothing),
        cmocka_unit_test(faces_without_area_go_and_are_named),
        cmocka_unit_test(duplicates_go_in_either_direction),
        cmocka_unit_test(orientation_comes_back_outwards),
        cmocka_unit_test(a_moebius_strip_is_left_as_it_is),
        cmocka_unit_test(holes_are_closed),
        cmocka_unit_test(a_concave_planar_hole_keeps_its_area),
        cmocka_unit_test(welding_within_a_distance_joins_the_first),
        cmocka_unit_test(everything_at_once_mends_any_soup_for_good),
        cmocka_unit_test(any_steps_twice_are_as_once),
        cmocka_unit_test(flat_sheets_keep_their_rims),
        cmocka_unit_test(each_failing_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
