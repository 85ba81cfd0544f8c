/* The oracle of distances against closed forms, and against itself for other threads. */
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include "cli/tradeoff/distance_oracle.h"

#include <math.h>

static mt_mesh *square(mt_context *context, double size, double z)
{
    const double positions[] = {0, 0, z, size, 0, z, size, size, z, 0, size, z};
    return test_mesh(context, 4, positions, 1, (const mt_index[]){4, 0, 1, 2, 3});
}

static void expect(const distance_oracle *found, double largest, double mean, double mean_error)
{
    assert_true(found->lower <= largest * (1 + 1e-14) && largest <= found->upper * (1 + 1e-14));
    assert_true(found->upper - found->lower <= 1e-8);
    assert_true(fabs(found->mean - mean) <= mean_error && found->mean_error <= 2 * mean_error);
}

static void squares_have_closed_forms(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *small = square(context, 1, 0), *above = square(context, 1, 0.25), *large = square(context, 2, 0);
    distance_oracle found;
    assert_int_equal(distance_oracle_measure(context, small, above, 1e-9, &found), MT_OK);
    expect(&found, 0.25, 0.25, 1e-15);
    assert_int_equal(distance_oracle_measure(context, small, large, 1e-9, &found), MT_OK);
    expect(&found, 0, 0, 1e-15);
    /* two strips and a square at the corner, where the mean is (sqrt(2) + ln(1 + sqrt(2))) / 3 */
    double corner = (sqrt(2) + log(1 + sqrt(2))) / 3;
    assert_int_equal(distance_oracle_measure(context, large, small, 1e-9, &found), MT_OK);
    expect(&found, sqrt(2), (0.5 + 0.5 + corner) / 4, 1e-6);
    mt_mesh_destroy(context, small);
    mt_mesh_destroy(context, above);
    mt_mesh_destroy(context, large);
    test_context_end(context);
}

/* A lid and the frame around it: the largest distance is in the middle, where no vertex is. */
static void the_largest_may_lie_inside(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double flat[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const double frame[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -3, -3, 0, 3, -3, 0, 3, 3, 0, -3, 3, 0};
    static const mt_index face[] = {4, 0, 1, 2, 3};
    static const mt_index faces[] = {4, 0, 4, 5, 1, 4, 1, 5, 6, 2, 4, 2, 6, 7, 3, 4, 3, 7, 4, 0};
    mt_mesh *lid = test_mesh(context, 4, flat, 1, face), *hole = test_mesh(context, 8, frame, 4, faces);
    distance_oracle found;
    assert_int_equal(distance_oracle_measure(context, lid, hole, 1e-9, &found), MT_OK);
    expect(&found, 1, 1.0 / 3, 1e-6); /* of a square the distance to its rim */
    mt_mesh_destroy(context, lid);
    mt_mesh_destroy(context, hole);
    test_context_end(context);
}

static distance_oracle measure_with(unsigned threads)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 20, 10, true), *other = test_torus(context, 13, 9, false);
    distance_oracle found;
    assert_int_equal(distance_oracle_measure(context, mesh, other, 1e-6, &found), MT_OK);
    mt_mesh_destroy(context, mesh);
    mt_mesh_destroy(context, other);
    test_context_end(context);
    return found;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    distance_oracle one = measure_with(1), three = measure_with(3);
    assert_true(one.lower == three.lower && one.upper == three.upper && one.mean == three.mean);
    assert_true(one.lower > 0 && one.upper - one.lower < 2e-6 && one.mean < one.upper);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_have_closed_forms),
        cmocka_unit_test(the_largest_may_lie_inside),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
