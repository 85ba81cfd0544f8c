/* The numbers behind the manifold check: volumes and areas at all scales, and signs by each arithmetic. */
#include "tests/support/manifold_reference.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <float.h>
#include <math.h>

/* The box [0, side]^3 of triangles, moved and scaled. */
static mt_mesh *make_box(mt_context *context, double side, double offset)
{
    static const mt_index faces[] = {3, 0, 2, 1, 3, 1, 2, 3, 3, 4, 5, 6, 3, 5, 7, 6, 3, 0, 1, 4, 3, 1, 5, 4,
                                     3, 2, 6, 3, 3, 3, 6, 7, 3, 0, 4, 2, 3, 2, 4, 6, 3, 1, 3, 5, 3, 3, 7, 5};
    double positions[24];
    for (int v = 0; v < 8; v++) {
        for (int axis = 0; axis < 3; axis++) {
            positions[3 * v + axis] = offset + (v >> axis & 1 ? side : 0);
        }
    }
    return test_mesh(context, 8, positions, 12, faces);
}

static void expect_box(double side, double offset)
{
    mt_context *context = test_context();
    mt_mesh *mesh = make_box(context, side, offset);
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.manifold_class, MT_MANIFOLD);
    assert_int_equal(report.defect_counts[MT_DEFECT_ZERO_AREA_FACE], 0);
    assert_true(report.area == 6 * side * side);
    assert_true(report.has_volume);
    assert_true(fabs(report.volume - side * side * side) <= 4 * DBL_EPSILON * side * side * side);
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Sizes are powers of two and offsets hold them exactly, so nothing but the method can lose digits. */
static void volume_holds_far_away_and_at_all_scales(void **state)
{
    (void)state;
    expect_box(1, 0);
    expect_box(0x1p-10, 1e7);
    expect_box(0x1p-3, 0x1p49);
    expect_box(0x1p-300, 0);
    expect_box(0x1p300, 0);
    expect_box(0x1p300, -0x1p299);
}

static void an_isolated_vertex_far_away_costs_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const mt_index faces[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
    static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1e300, 1e300, NAN, 1e300, 1e300, 1e300};
    mt_mesh *mesh = test_mesh(context, 6, positions, 4, faces);
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.defect_counts[MT_DEFECT_NON_FINITE_VERTEX], 1);
    assert_int_equal(report.defect_counts[MT_DEFECT_ISOLATED_VERTEX], 2);
    assert_true(fabs(report.volume - 1.0 / 6) < 1e-15);
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static mt_index count_zero_area(const double positions[9], mt_arithmetic how)
{
    static const mt_index faces[] = {3, 0, 1, 2};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 3, positions, 1, faces);
    mt_manifold_report report;
    const mt_manifold_options options = {.arithmetic = how};
    assert_int_equal(mt_check_manifold(context, mesh, &options, &report), MT_OK);
    mt_index count = report.defect_counts[MT_DEFECT_ZERO_AREA_FACE];
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return count;
}

static void zero_area_is_decided_exactly(void **state)
{
    (void)state;
    const double next = nextafter(0.3, 1);
    const struct {
        double positions[9];
        mt_index is_flat;
    } cases[] = {{{0, 0, 0, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3}, 1},
                 {{0, 0, 0, 0.1, 0.1, 0.1, 0.3, 0.3, next}, 0},
                 {{1e7, 0, 0, 1e7 + 1, 1, 1, 1e7 + 3, 3, 3}, 1},
                 {{0, 0, 0, 1e-200, 0, 0, 0, 1e-200, 0}, 0},
                 {{0, 0, 0, 5e-324, 0, 0, 0, 5e-324, 0}, 0},
                 {{0, 0, 0, 5e-324, 0, 0, 1e-323, 0, 0}, 1},
                 {{-1e308, 0, 0, 1e308, 0, 0, 1e308, 1e-300, 0}, 0},
                 {{-1e308, -1e308, 0, 1e308, 1e308, 0, 1, 1, 0}, 1},
                 {{2, 2, 2, 2, 2, 2, 2, 2, 2}, 1},
                 {{0, 0, 0, 1, 1, 1, NAN, 2, 2}, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(count_zero_area(cases[i].positions, MT_ARITHMETIC_ADAPTIVE), cases[i].is_flat);
        assert_int_equal(count_zero_area(cases[i].positions, MT_ARITHMETIC_EXACT), cases[i].is_flat);
    }
    /* products that underflow are equal */
    assert_int_equal(count_zero_area(cases[3].positions, MT_ARITHMETIC_FLOATING), 1);
}

static void expect_same_lists(const mt_manifold_report *a, const mt_manifold_report *b)
{
    assert_memory_equal(a->defect_counts, b->defect_counts, sizeof a->defect_counts);
    assert_int_equal(a->defect_list_count, b->defect_list_count);
    for (size_t i = 0; i < a->defect_list_count; i++) {
        assert_int_equal(a->defects[i].kind, b->defects[i].kind);
        assert_true(test_is_same_element(&a->defects[i], &b->defects[i]));
    }
}

/* Coordinates of many bits, so that doubles alone err; in halves of the meshes all faces lie on a slanted line. */
static void place_badly(mt_mesh *mesh, bool on_a_line)
{
    double *p = mesh->positions;
    for (mt_index i = 0; i < mesh->vertex_count; i++, p += 3) {
        p[0] = p[0] / 3 + 0.1;
        p[1] = on_a_line ? p[0] / 3 : p[1] / 7;
        p[2] = on_a_line ? p[0] * 7 : p[2] / 5;
    }
}

/* Exact throughout says the same as with the filter; doubles as they come do not. */
static void arithmetics_differ_in_doubles_alone(void **state)
{
    (void)state;
    test_random random = {1933};
    int wrong_faces = 0, wrong_pairs = 0, wrong_sides = 0;
    for (int i = 0; i < 300; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = i % 3 ? test_soup(context, &random) : test_patch(context, &random);
        place_badly(mesh, i % 2 == 0);
        mt_manifold_report reports[3];
        for (unsigned how = 0; how < 3; how++) {
            mt_manifold_options options = {.defects_per_kind = UINT64_MAX,
                                           .self_intersections = true,
                                           .inside_out = true,
                                           .arithmetic = (mt_arithmetic)how};
            assert_int_equal(mt_check_manifold(context, mesh, &options, &reports[how]), MT_OK);
        }
        expect_same_lists(&reports[MT_ARITHMETIC_ADAPTIVE], &reports[MT_ARITHMETIC_EXACT]);
        const mt_index *right = reports[MT_ARITHMETIC_EXACT].defect_counts;
        const mt_index *floating = reports[MT_ARITHMETIC_FLOATING].defect_counts;
        wrong_faces += floating[MT_DEFECT_ZERO_AREA_FACE] != right[MT_DEFECT_ZERO_AREA_FACE];
        wrong_pairs += floating[MT_DEFECT_SELF_INTERSECTION] != right[MT_DEFECT_SELF_INTERSECTION];
        wrong_sides += floating[MT_DEFECT_INSIDE_OUT_COMPONENT] != right[MT_DEFECT_INSIDE_OUT_COMPONENT];
        for (unsigned how = 0; how < 3; how++) {
            mt_manifold_report_release(context, &reports[how]);
        }
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(wrong_faces > 0 && wrong_pairs > 0 && wrong_sides > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volume_holds_far_away_and_at_all_scales),
        cmocka_unit_test(an_isolated_vertex_far_away_costs_nothing),
        cmocka_unit_test(zero_area_is_decided_exactly),
        cmocka_unit_test(arithmetics_differ_in_doubles_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
