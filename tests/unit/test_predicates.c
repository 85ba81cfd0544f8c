/* The sign of orientations: conventions, exactness beside integers, symmetry, the ends of the range of doubles. The
 * oracle compares many more with rationals. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/predicates.h>

#include <float.h>

/* An integer of magnitude below 2^bits. */
static double next_integer(test_random *random, int bits)
{
    return (double)((int64_t)test_random_next(random) >> (63 - bits));
}

static int orient2d(double ax, double ay, double bx, double by, double cx, double cy)
{
    return mt_orient2d((double[]){ax, ay}, (double[]){bx, by}, (double[]){cx, cy});
}

static void sign_convention_2d(void **state)
{
    (void)state;
    assert_int_equal(orient2d(0, 0, 1, 0, 0, 1), 1);
    assert_int_equal(orient2d(0, 0, 0, 1, 1, 0), -1);
    assert_int_equal(orient2d(0, 0, 1, 1, 2, 2), 0);
}

static void sign_convention_3d(void **state)
{
    (void)state;
    mt_vec3 a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
    assert_int_equal(mt_orient3d(a, b, c, mt_vec3_make(0, 0, -1)), 1);
    assert_int_equal(mt_orient3d(a, b, c, mt_vec3_make(0, 0, 1)), -1);
    assert_int_equal(mt_orient3d(a, b, c, mt_vec3_make(5, -7, 0)), 0);
    assert_int_equal(mt_orient3d(a, b, c, mt_vec3_make(1e300, 1e300, -0x1p-1074)), 1);
}

/* Shewchuk's figure: points a step of the last place off the diagonal, where the plain formula is
 * wrong about half of the time. Around (0.5, 0.5) the exact sign is that of y - x. */
static void one_step_off_the_diagonal(void **state)
{
    (void)state;
    int plain_errors = 0;
    for (int i = -128; i <= 128; i++) {
        for (int j = -128; j <= 128; j++) {
            double x = 0.5 + i * 0x1p-53, y = 0.5 + j * 0x1p-53;
            int expected = (y > x) - (y < x);
            assert_int_equal(orient2d(12, 12, 24, 24, x, y), expected);
            assert_int_equal(mt_orient3d(mt_vec3_make(12, 12, 0), mt_vec3_make(24, 24, 0), mt_vec3_make(18, 18, 1),
                                         mt_vec3_make(x, y, 0.25)),
                             expected);
            double plain = (12 - x) * (24 - y) - (12 - y) * (24 - x);
            plain_errors += ((plain > 0) - (plain < 0)) != expected;
        }
    }
    assert_true(plain_errors > 1000);
}

/* On integers below 2^19 every step of the plain formula is exact in 64 bits. */
static void integers_agree_with_64_bit_arithmetic(void **state)
{
    (void)state;
    test_random random = {11};
    for (int i = 0; i < 20000; i++) {
        int bits = i % 2 == 0 ? 2 : 18;
        double p[4][3];
        int64_t q[3][3];
        for (int j = 0; j < 12; j++) {
            p[j / 3][j % 3] = next_integer(&random, bits);
        }
        for (int j = 0; j < 9; j++) {
            q[j / 3][j % 3] = (int64_t)p[j / 3][j % 3] - (int64_t)p[3][j % 3];
        }
        int64_t det = q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]) +
                      q[1][2] * (q[2][0] * q[0][1] - q[2][1] * q[0][0]) +
                      q[2][2] * (q[0][0] * q[1][1] - q[0][1] * q[1][0]);
        int expected = (det > 0) - (det < 0);
        mt_vec3 v[4];
        for (int j = 0; j < 4; j++) {
            v[j] = mt_vec3_make(p[j][0], p[j][1], p[j][2]);
        }
        assert_int_equal(mt_orient3d(v[0], v[1], v[2], v[3]), expected);
        assert_int_equal(mt_orient3d_exact(v[0], v[1], v[2], v[3]), expected);
        int64_t turn = (int64_t)((p[0][0] - p[2][0]) * (p[1][1] - p[2][1]) - (p[0][1] - p[2][1]) * (p[1][0] - p[2][0]));
        assert_int_equal(mt_orient2d(p[0], p[1], p[2]), (turn > 0) - (turn < 0));
        assert_int_equal(mt_orient2d_exact(p[0], p[1], p[2]), (turn > 0) - (turn < 0));
    }
}

/* A random coordinate of any exponent, or one of the ends of the range. */
static double next_extreme(test_random *random)
{
    static const double ends[] = {0, 0x1p-1074, 0x1p-1022, 1e-300, 1e300, DBL_MAX, 1, 0x1.8p1023};
    uint64_t choice = test_random_next(random) >> 32;
    double sign = (choice & 1) != 0 ? -1 : 1;
    if ((choice & 2) != 0) {
        return sign * ends[(choice >> 2) & 7];
    }
    return ldexp(next_integer(random, 53), (int)((choice >> 2) % 2040) - 1074);
}

static void swaps_change_the_sign_even_at_the_extremes(void **state)
{
    (void)state;
    test_random random = {13};
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < 20000; i++) {
        mt_vec3 v[4];
        for (int j = 0; j < 4; j++) {
            v[j] = mt_vec3_make(next_extreme(&random), next_extreme(&random), next_extreme(&random));
        }
        int sign = mt_orient3d(v[0], v[1], v[2], v[3]);
        seen[sign + 1]++;
        assert_int_equal(mt_orient3d(v[1], v[0], v[2], v[3]), -sign);
        assert_int_equal(mt_orient3d(v[0], v[2], v[1], v[3]), -sign);
        assert_int_equal(mt_orient3d(v[0], v[1], v[3], v[2]), -sign);
        assert_int_equal(mt_orient3d_exact(v[0], v[1], v[2], v[3]), sign);
        double a[] = {v[0].x, v[0].y}, b[] = {v[1].x, v[1].y}, c[] = {v[2].x, v[2].y};
        int turn = mt_orient2d(a, b, c);
        assert_int_equal(mt_orient2d(b, a, c), -turn);
        assert_int_equal(mt_orient2d(b, c, a), turn);
        assert_int_equal(mt_orient2d_exact(a, b, c), turn);
    }
    assert_true(seen[0] > 1000 && seen[2] > 1000);
}

static void products_that_underflow_keep_their_sign(void **state)
{
    (void)state;
    double e = 0x1p-1074;
    assert_int_equal(orient2d(e, 0, 0, e, 0, 0), 1);
    assert_int_equal(orient2d(0, e, e, 0, 0, 0), -1);
    assert_int_equal(orient2d(e, e, 2 * e, 2 * e, 0, 0), 0);
    assert_int_equal(orient2d(3 * e, 5 * e, 5 * e, 8 * e, 0, 0), -1);
    mt_vec3 x = {e, 0, 0}, y = {0, e, 0}, z = {0, 0, e}, origin = {0, 0, 0};
    assert_int_equal(mt_orient3d(x, y, z, origin), 1);
    assert_int_equal(mt_orient3d(y, x, z, origin), -1);
}

static void differences_and_products_that_overflow_keep_their_sign(void **state)
{
    (void)state;
    double m = DBL_MAX;
    assert_int_equal(orient2d(m, -m, m, m, -m, -m), 1);
    assert_int_equal(orient2d(-m, -m, m, m, nextafter(m, 0), m), 1);
    assert_int_equal(orient2d(-m, -m, m, m, 0, 0), 0);
    assert_int_equal(orient2d(-m, -m, m, m, 0, -0x1p-1074), -1);
    assert_int_equal(mt_orient3d(mt_vec3_make(m, -m, -m), mt_vec3_make(-m, m, -m), mt_vec3_make(-m, -m, m),
                                 mt_vec3_make(-m, -m, -m)),
                     1);
}

static void not_finite_is_zero(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 12; j++) {
            double p[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
            p[j / 3][j % 3] = bad[i];
            mt_vec3 v[4];
            for (int k = 0; k < 4; k++) {
                v[k] = mt_vec3_make(p[k][0], p[k][1], p[k][2]);
            }
            assert_int_equal(mt_orient3d(v[0], v[1], v[2], v[3]), 0);
            if (j % 3 < 2 && j < 9) {
                assert_int_equal(mt_orient2d(p[0], p[1], p[2]), 0);
            }
        }
    }
}

static void collinear_is_exact(void **state)
{
    (void)state;
    test_random random = {17};
    for (int i = 0; i < 5000; i++) {
        mt_vec3 a = {next_integer(&random, 20), next_integer(&random, 20), next_integer(&random, 20)};
        mt_vec3 step = {next_integer(&random, 20), next_integer(&random, 20), next_integer(&random, 20)};
        mt_vec3 b = mt_vec3_add(a, mt_vec3_scale(step, next_integer(&random, 5)));
        mt_vec3 c = mt_vec3_add(a, mt_vec3_scale(step, next_integer(&random, 5)));
        assert_true(mt_collinear(a, b, c));
        assert_true(mt_collinear(a, b, b));
        bool has_length = step.x != 0 && !(b.x == a.x && b.y == a.y && b.z == a.z);
        c.y += 0x1p-15;
        assert_int_equal(mt_collinear(a, b, c), !has_length);
        c.y -= 0x1p-15;
        c.z = nextafter(c.z, INFINITY);
        assert_int_equal(mt_collinear(a, b, c), !has_length);
    }
    mt_vec3 zero = {0, 0, 0}, tiny = {0x1p-1074, 0x1p-1074, 0x1p-1074}, huge = {DBL_MAX, DBL_MAX, DBL_MAX};
    assert_true(mt_collinear(zero, tiny, huge));
    assert_true(mt_collinear(zero, zero, zero));
    huge.x = nextafter(huge.x, 0);
    assert_false(mt_collinear(zero, tiny, huge));
}

static mt_vec3 any_point(test_random *random, int exponents)
{
    double x[3];
    for (int axis = 0; axis < 3; axis++) {
        x[axis] =
            ldexp(test_random_unit(random) - 0.5, (int)test_random_below(random, (uint64_t)exponents) * 2 - exponents);
    }
    return mt_vec3_make(x[0], x[1], x[2]);
}

/* About its last corner a tetrahedron's surface is one triangle, whose determinant is the orientation. */
static void volume_of_a_tetrahedron_has_the_sign_of_its_orientation(void **state)
{
    (void)state;
    test_random random = {1859};
    int zero_count = 0;
    for (int i = 0; i < 20000; i++) {
        int exponents = i % 3 == 0 ? 1 : i % 3 == 1 ? 60 : 1000;
        mt_vec3 a = any_point(&random, exponents), b = any_point(&random, exponents);
        mt_vec3 c = any_point(&random, exponents), d = i % 7 ? any_point(&random, exponents) : mt_vec3_add(a, b);
        if (i % 5 == 0) {
            d = mt_vec3_scale(c, 0.5); /* with a = -b in one plane */
            b = mt_vec3_scale(a, -1);
        }
        mt_vec3 surface[] = {a, b, c, a, d, b, b, d, c, c, d, a};
        int sign = mt_volume_sign(surface, 4);
        assert_int_equal(sign, mt_orient3d(a, b, c, d));
        zero_count += sign == 0;
    }
    assert_in_range(zero_count, 3000, 8000);
    mt_vec3 bad[] = {{NAN, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    assert_int_equal(mt_volume_sign(bad, 1), 0);
    assert_int_equal(mt_volume_sign(bad, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sign_convention_2d),
        cmocka_unit_test(sign_convention_3d),
        cmocka_unit_test(one_step_off_the_diagonal),
        cmocka_unit_test(integers_agree_with_64_bit_arithmetic),
        cmocka_unit_test(swaps_change_the_sign_even_at_the_extremes),
        cmocka_unit_test(products_that_underflow_keep_their_sign),
        cmocka_unit_test(differences_and_products_that_overflow_keep_their_sign),
        cmocka_unit_test(not_finite_is_zero),
        cmocka_unit_test(collinear_is_exact),
        cmocka_unit_test(volume_of_a_tetrahedron_has_the_sign_of_its_orientation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
