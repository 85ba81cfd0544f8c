/* Principal axes against their definition: A v = s v, at right angles, by falling s; and against matrices whose axes
 * are known because they were made from them. */
#include "tests/support/unit.h"

#include "lib/spatial/principal_axes.h"
#include "tests/support/fixture.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void expect_axes(double matrix[3][3])
{
    double used[3][3], axes[3][3], values[3], size = 0;
    memcpy(used, matrix, sizeof used);
    mt_principal_axes(used, axes);
    for (int i = 0; i < 9; i++) {
        size = fmax(size, fabs(matrix[i / 3][i % 3]));
    }
    for (int k = 0; k < 3; k++) {
        double product[3] = {dot(matrix[0], axes[k]), dot(matrix[1], axes[k]), dot(matrix[2], axes[k])};
        values[k] = dot(product, axes[k]);
        for (int i = 0; i < 3; i++) {
            assert_true(fabs(product[i] - values[k] * axes[k][i]) <= 1e-14 * size);
        }
        for (int j = 0; j <= k; j++) {
            assert_true(fabs(dot(axes[j], axes[k]) - (j == k)) <= 1e-14);
        }
        assert_true(k == 0 || values[k - 1] >= values[k] - 1e-14 * size);
    }
}

static void random_matrices_have_their_axes(void **state)
{
    (void)state;
    test_random random = {3};
    for (int round = 0; round < 100000; round++) {
        double matrix[3][3], scale = ldexp(1, (int)test_random_below(&random, 600) - 300);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j <= i; j++) {
                double x = test_random_unit(&random) - 0.5;
                x *= ldexp(1, -(int)test_random_below(&random, 2) * (int)test_random_below(&random, 40));
                matrix[i][j] = matrix[j][i] = x * scale;
            }
        }
        expect_axes(matrix);
    }
}

static void equal_and_missing_spreads_have_axes_too(void **state)
{
    (void)state;
    double same[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, none[3][3] = {{0}},
           line[3][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    expect_axes(same);
    expect_axes(none);
    expect_axes(line);
    double used[3][3], axes[3][3];
    memcpy(used, line, sizeof used);
    mt_principal_axes(used, axes);
    assert_true(fabs(fabs(dot(axes[0], (const double[]){1, 1, 1})) - sqrt(3)) < 1e-15);
}

/* A box of 3 x 2 x 1 turned by (cos, sin) = (0.6, 0.8) about z, then about x: the axes are the columns of the turn. */
static void axes_of_a_turned_box_are_its_edges(void **state)
{
    (void)state;
    const double turn[3][3] = {{0.6, 0.48, 0.64}, {-0.8, 0.36, 0.48}, {0, -0.8, 0.6}}, squares[3] = {9, 4, 1};
    double matrix[3][3] = {{0}}, axes[3][3];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 9; i++) {
            matrix[i / 3][i % 3] += squares[k] * turn[k][i / 3] * turn[k][i % 3];
        }
    }
    mt_principal_axes(matrix, axes);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(fabs(dot(axes[k], turn[k])) - 1) < 1e-15);
    }
}

static void what_is_not_finite_gives_the_coordinate_axes(void **state)
{
    (void)state;
    double matrix[3][3] = {{1, NAN, 0}, {NAN, 1, INFINITY}, {0, INFINITY, 1}}, axes[3][3];
    const double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mt_principal_axes(matrix, axes);
    assert_memory_equal(axes, identity, sizeof axes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_matrices_have_their_axes),
        cmocka_unit_test(equal_and_missing_spreads_have_axes_too),
        cmocka_unit_test(axes_of_a_turned_box_are_its_edges),
        cmocka_unit_test(what_is_not_finite_gives_the_coordinate_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
