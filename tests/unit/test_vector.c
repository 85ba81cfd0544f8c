/* Scaling by powers of two and unit vectors, from the smallest subnormal to the largest double. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/vector.h>

#include <float.h>

static double next_signed_unit(test_random *random)
{
    return 2 * test_random_unit(random) - 1;
}

static void assert_same(mt_vec3 a, mt_vec3 b)
{
    assert_true(a.x == b.x && a.y == b.y && a.z == b.z);
}

static void scale_brings_every_normal_double_into_half_to_one(void **state)
{
    (void)state;
    for (int exponent = -1022; exponent < 1024; exponent++) {
        const double mantissas[] = {1, 1.5, 0x1.fffffffffffffp0};
        for (int i = 0; i < 3; i++) {
            double x = ldexp(mantissas[i], exponent);
            double scaled = x * mt_power_of_two_scale(x);
            assert_true(scaled >= 0.5 && scaled < 1);
            assert_true(-x * mt_power_of_two_scale(-x) == -scaled);
        }
    }
}

static void scale_of_subnormals_is_the_largest_power(void **state)
{
    (void)state;
    assert_true(mt_power_of_two_scale(0x1p-1074) == 0x1p1023);
    assert_true(mt_power_of_two_scale(0x1p-1024) == 0x1p1023);
    assert_true(mt_power_of_two_scale(0x1p-1074) * 0x1p-1074 == 0x1p-51);
}

static void scale_of_zero_and_not_finite_is_one(void **state)
{
    (void)state;
    assert_true(mt_power_of_two_scale(0) == 1);
    assert_true(mt_power_of_two_scale(-0.0) == 1);
    assert_true(mt_power_of_two_scale(INFINITY) == 1);
    assert_true(mt_power_of_two_scale(NAN) == 1);
}

static void unit_vectors_do_not_depend_on_the_size(void **state)
{
    (void)state;
    test_random random = {7};
    for (int i = 0; i < 2000; i++) {
        mt_vec3 v = {next_signed_unit(&random), next_signed_unit(&random), next_signed_unit(&random)};
        mt_vec3 unit = mt_vec3_normalize(v);
        assert_true(fabs(mt_vec3_length(unit) - 1) <= 4 * DBL_EPSILON);
        int exponent = (int)(test_random_below(&random, 1900)) - 950;
        mt_vec3 scaled = {ldexp(v.x, exponent), ldexp(v.y, exponent), ldexp(v.z, exponent)};
        assert_same(mt_vec3_normalize(scaled), unit);
    }
}

static void extremes_are_normalized(void **state)
{
    (void)state;
    assert_same(mt_vec3_normalize(mt_vec3_make(0, -0x1p-1074, 0)), mt_vec3_make(0, -1, 0));
    assert_same(mt_vec3_normalize(mt_vec3_make(DBL_MAX, 0, 0)), mt_vec3_make(1, 0, 0));
    mt_vec3 diagonal = mt_vec3_normalize(mt_vec3_make(1, 1, 1));
    assert_same(mt_vec3_normalize(mt_vec3_make(0x1p-1074, 0x1p-1074, 0x1p-1074)), diagonal);
    assert_same(mt_vec3_normalize(mt_vec3_make(0x1p1023, 0x1p1023, 0x1p1023)), diagonal);
    mt_vec3 subnormal = mt_vec3_normalize(mt_vec3_make(0x3p-1070, 0x4p-1070, 0));
    assert_same(subnormal, mt_vec3_normalize(mt_vec3_make(3, 4, 0)));
    mt_vec3 mixed = mt_vec3_normalize(mt_vec3_make(1e300, 1e-300, 0));
    assert_true(mixed.x == 1 && mixed.y >= 0 && mixed.y < 1e-300);
}

static void no_direction_gives_the_zero_vector(void **state)
{
    (void)state;
    const mt_vec3 zero = {0, 0, 0};
    assert_same(mt_vec3_normalize(zero), zero);
    assert_same(mt_vec3_normalize(mt_vec3_make(INFINITY, 1, 1)), zero);
    assert_same(mt_vec3_normalize(mt_vec3_make(1, -INFINITY, 1)), zero);
    assert_same(mt_vec3_normalize(mt_vec3_make(INFINITY, -INFINITY, 1)), zero);
    assert_same(mt_vec3_normalize(mt_vec3_make(1, 1, NAN)), zero);
    assert_same(mt_vec3_normalize(mt_vec3_make(NAN, 0, 0)), zero);
}

static void max_abs_sees_every_component_and_nan(void **state)
{
    (void)state;
    assert_true(mt_vec3_max_abs(mt_vec3_make(-3, 2, 1)) == 3);
    assert_true(mt_vec3_max_abs(mt_vec3_make(1, -3, 2)) == 3);
    assert_true(mt_vec3_max_abs(mt_vec3_make(1, 2, -3)) == 3);
    assert_true(isnan(mt_vec3_max_abs(mt_vec3_make(NAN, 1, 2))));
    assert_true(isnan(mt_vec3_max_abs(mt_vec3_make(1, 2, NAN))));
    assert_true(isinf(mt_vec3_max_abs(mt_vec3_make(INFINITY, -INFINITY, 0))));
    assert_true(mt_vec3_max_abs(mt_vec3_make(DBL_MAX, DBL_MAX, DBL_MAX)) == DBL_MAX);
}

static void cross_is_at_right_angles(void **state)
{
    (void)state;
    assert_same(mt_vec3_cross(mt_vec3_make(1, 0, 0), mt_vec3_make(0, 1, 0)), mt_vec3_make(0, 0, 1));
    assert_same(mt_vec3_cross(mt_vec3_make(0, 1, 0), mt_vec3_make(0, 0, 1)), mt_vec3_make(1, 0, 0));
    mt_vec3 a = {1, 2, 3}, b = {-4, 5, 7}, c = mt_vec3_cross(a, b);
    assert_true(mt_vec3_dot(a, c) == 0 && mt_vec3_dot(b, c) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scale_brings_every_normal_double_into_half_to_one),
        cmocka_unit_test(scale_of_subnormals_is_the_largest_power),
        cmocka_unit_test(scale_of_zero_and_not_finite_is_one),
        cmocka_unit_test(unit_vectors_do_not_depend_on_the_size),
        cmocka_unit_test(extremes_are_normalized),
        cmocka_unit_test(no_direction_gives_the_zero_vector),
        cmocka_unit_test(max_abs_sees_every_component_and_nan),
        cmocka_unit_test(cross_is_at_right_angles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
