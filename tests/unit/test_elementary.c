/* The elementary functions: special values of C17 Annex F, known values, identities, exact and monotonic cases. The
 * oracle compares many more with MPFR. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/elementary.h>

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define TINY 0x1p-1074

/* Same bits, or both NaN. */
static void assert_bits(double value, double expected)
{
    if (isnan(expected)) {
        assert_true(isnan(value));
    } else {
        assert_memory_equal(&value, &expected, sizeof value);
    }
}

static bool is_within(double value, double expected, double ulps)
{
    return fabs(value - expected) <= ulps * DBL_EPSILON * fabs(expected);
}

static double next_signed_unit(test_random *random)
{
    return 2 * test_random_unit(random) - 1;
}

static void trigonometric_special_values(void **state)
{
    (void)state;
    assert_bits(mt_sin(0.0), 0.0);
    assert_bits(mt_sin(-0.0), -0.0);
    assert_bits(mt_tan(-0.0), -0.0);
    assert_bits(mt_cos(-0.0), 1);
    assert_bits(mt_sin(-TINY), -TINY);
    assert_bits(mt_tan(TINY), TINY);
    assert_bits(mt_cos(TINY), 1);
    const double none[] = {INFINITY, -INFINITY, NAN};
    for (int i = 0; i < 3; i++) {
        assert_bits(mt_sin(none[i]), NAN);
        assert_bits(mt_cos(none[i]), NAN);
        assert_bits(mt_tan(none[i]), NAN);
    }
}

/* Correctly rounded values, from MPFR. The double next to pi/2 leaves 6.1e-17; sin and cos of 1e22 need
 * 2/pi far beyond the precision of a double. */
static void trigonometric_known_values(void **state)
{
    (void)state;
    assert_bits(mt_cos(0x1.921fb54442d18p+0), 0x1.1a62633145c07p-54);
    assert_bits(mt_sin(0x1.921fb54442d18p+1), 0x1.1a62633145c07p-53);
    assert_bits(mt_tan(0x1.921fb54442d18p+0), 0x1.d02967c31cdb5p+53);
    assert_bits(mt_sin(0x1.921fb54442d18p+0), 1);
    assert_bits(mt_cos(0x1.921fb54442d18p+1), -1);
    assert_true(is_within(mt_sin(1e22), -0.8522008497671888, 1));
    assert_true(is_within(mt_cos(1e22), 0.5232147853951389, 1));
    assert_true(is_within(mt_sin(DBL_MAX), 0.004961954789184062, 1));
    assert_true(is_within(mt_cos(DBL_MAX), -0.9999876894265599, 1));
    assert_bits(mt_tan(355), 0x1.f9bd030bacc16p-16);
}

static void trigonometric_identities(void **state)
{
    (void)state;
    test_random random = {3};
    for (int i = 0; i < 20000; i++) {
        double x = ldexp(next_signed_unit(&random), i % 1024);
        double sine = mt_sin(x), cosine = mt_cos(x);
        assert_true(fabs(sine * sine + cosine * cosine - 1) <= 4 * DBL_EPSILON);
        assert_true(fabs(sine) <= 1 && fabs(cosine) <= 1);
        assert_bits(mt_sin(-x), -sine);
        assert_bits(mt_cos(-x), cosine);
        assert_bits(mt_tan(-x), -mt_tan(x));
        assert_true(is_within(mt_tan(x), sine / cosine, 4));
        if (fabs(x) < 0x1p500) {
            assert_true(fabs(mt_sin(2 * x) - 2 * sine * cosine) <= 8 * DBL_EPSILON);
        }
    }
}

static void inverse_trigonometric_special_values(void **state)
{
    (void)state;
    const double pi = 0x1.921fb54442d18p+1;
    assert_bits(mt_asin(-0.0), -0.0);
    assert_bits(mt_atan(-0.0), -0.0);
    assert_bits(mt_asin(TINY), TINY);
    assert_bits(mt_atan(-TINY), -TINY);
    assert_bits(mt_asin(1), pi / 2);
    assert_bits(mt_asin(-1), -pi / 2);
    assert_bits(mt_acos(1), 0.0);
    assert_bits(mt_acos(-1), pi);
    assert_bits(mt_acos(0), pi / 2);
    assert_bits(mt_acos(-0.0), pi / 2);
    assert_bits(mt_atan(1), pi / 4);
    assert_bits(mt_atan(INFINITY), pi / 2);
    assert_bits(mt_atan(-DBL_MAX), -pi / 2);
    const double outside[] = {1 + DBL_EPSILON, -1 - DBL_EPSILON, INFINITY, -INFINITY, NAN};
    for (int i = 0; i < 5; i++) {
        assert_bits(mt_asin(outside[i]), NAN);
        assert_bits(mt_acos(outside[i]), NAN);
    }
    assert_bits(mt_atan(NAN), NAN);
}

/* C17 F.10.1.4. */
static void atan2_special_values(void **state)
{
    (void)state;
    const double pi = 0x1.921fb54442d18p+1, three_quarters = 0x1.2d97c7f3321d2p+1;
    const double inf = INFINITY;
    const double rows[][3] = {{0.0, 0.0, 0.0},
                              {-0.0, 0.0, -0.0},
                              {0.0, -0.0, pi},
                              {-0.0, -0.0, -pi},
                              {0.0, 5, 0.0},
                              {-0.0, 5, -0.0},
                              {0.0, -5, pi},
                              {-0.0, -5, -pi},
                              {5, 0.0, pi / 2},
                              {5, -0.0, pi / 2},
                              {-5, 0.0, -pi / 2},
                              {-5, -0.0, -pi / 2},
                              {5, -inf, pi},
                              {-5, -inf, -pi},
                              {5, inf, 0.0},
                              {-5, inf, -0.0},
                              {inf, 5, pi / 2},
                              {-inf, -5, -pi / 2},
                              {inf, -inf, three_quarters},
                              {-inf, -inf, -three_quarters},
                              {inf, inf, pi / 4},
                              {-inf, inf, -pi / 4},
                              {NAN, 1, NAN},
                              {1, NAN, NAN},
                              {inf, NAN, NAN},
                              {TINY, DBL_MAX, 0.0},
                              {TINY, -DBL_MAX, pi},
                              {TINY, TINY, pi / 4},
                              {-DBL_MAX, DBL_MAX, -pi / 4},
                              {DBL_MAX, TINY, pi / 2},
                              {3 * TINY, 1, 3 * TINY},
                              {-1, 0x1p-1000, -pi / 2}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_bits(mt_atan2(rows[i][0], rows[i][1]), rows[i][2]);
    }
}

static void inverse_functions_lead_back(void **state)
{
    (void)state;
    test_random random = {5};
    for (int i = 0; i < 20000; i++) {
        double x = next_signed_unit(&random);
        assert_true(fabs(mt_sin(mt_asin(x)) - x) <= DBL_EPSILON);
        assert_true(fabs(mt_cos(mt_acos(x)) - x) <= 2 * DBL_EPSILON);
        assert_true(fabs(mt_asin(x) + mt_acos(x) - 0x1.921fb54442d18p+0) <= 2 * DBL_EPSILON);
        assert_true(is_within(mt_atan(mt_tan(x)), x, 4));
        double angle = 3.14 * x, size = ldexp(1, i % 600 - 300);
        assert_true(is_within(mt_atan2(size * mt_sin(angle), size * mt_cos(angle)), angle, 4));
        double y = ldexp(next_signed_unit(&random), i % 600 - 300);
        assert_true(is_within(mt_cbrt(y) * mt_cbrt(y) * mt_cbrt(y), y, 4));
        assert_bits(mt_cbrt(-y), -mt_cbrt(y));
        assert_true(fabs(mt_log(mt_exp(700 * x)) - 700 * x) <= DBL_EPSILON * fmax(1, fabs(700 * x)));
        assert_true(is_within(mt_exp(x) * mt_exp(-x), 1, 4));
    }
}

static void exponential_special_values(void **state)
{
    (void)state;
    assert_bits(mt_exp(0.0), 1);
    assert_bits(mt_exp(-0.0), 1);
    assert_bits(mt_exp(TINY), 1);
    assert_bits(mt_exp(1), 0x1.5bf0a8b145769p+1);
    assert_bits(mt_exp(INFINITY), INFINITY);
    assert_bits(mt_exp(-INFINITY), 0.0);
    assert_bits(mt_exp(NAN), NAN);
    assert_bits(mt_exp(DBL_MAX), INFINITY);
    assert_bits(mt_exp(-DBL_MAX), 0.0);
    /* The last arguments with a finite and with a positive result. */
    assert_true(is_within(mt_exp(0x1.62e42fefa39efp+9), DBL_MAX, 1000) && mt_exp(0x1.62e42fefa39efp+9) <= DBL_MAX);
    assert_bits(mt_exp(0x1.62e42fefa39f0p+9), INFINITY);
    assert_bits(mt_exp(-0x1.74910d52d3051p+9), TINY);
    assert_bits(mt_exp(-0x1.74910d52d3052p+9), 0.0);
}

static void logarithm_special_values(void **state)
{
    (void)state;
    assert_bits(mt_log(1), 0.0);
    assert_bits(mt_log(0.0), -INFINITY);
    assert_bits(mt_log(-0.0), -INFINITY);
    assert_bits(mt_log(INFINITY), INFINITY);
    assert_bits(mt_log(-INFINITY), NAN);
    assert_bits(mt_log(-TINY), NAN);
    assert_bits(mt_log(NAN), NAN);
    assert_bits(mt_log(2), 0x1.62e42fefa39efp-1);
    assert_bits(mt_log(TINY), -0x1.74385446d71c3p+9);
    assert_bits(mt_log(DBL_MAX), 0x1.62e42fefa39efp+9);
    assert_bits(mt_log(1 + DBL_EPSILON), 0x1.fffffffffffffp-53);
}

/* C17 F.10.4.4. */
static void power_special_values(void **state)
{
    (void)state;
    const double inf = INFINITY;
    const double rows[][3] = {{0.0, -3, inf},
                              {-0.0, -3, -inf},
                              {0.0, -2.5, inf},
                              {-0.0, -2.5, inf},
                              {-0.0, -2, inf},
                              {0.0, -inf, inf},
                              {-0.0, -inf, inf},
                              {0.0, 3, 0.0},
                              {-0.0, 3, -0.0},
                              {0.0, 2, 0.0},
                              {-0.0, 2, 0.0},
                              {-0.0, 2.5, 0.0},
                              {-1, inf, 1},
                              {-1, -inf, 1},
                              {1, NAN, 1},
                              {1, -inf, 1},
                              {NAN, 0.0, 1},
                              {NAN, -0.0, 1},
                              {-inf, 0.0, 1},
                              {-8, 1.0 / 3, NAN},
                              {-2, 0.5, NAN},
                              {0.5, -inf, inf},
                              {-0.5, -inf, inf},
                              {2, -inf, 0.0},
                              {-2, -inf, 0.0},
                              {0.5, inf, 0.0},
                              {-2, inf, inf},
                              {-inf, -3, -0.0},
                              {-inf, -2, 0.0},
                              {-inf, -2.5, 0.0},
                              {-inf, 3, -inf},
                              {-inf, 2, inf},
                              {-inf, 2.5, inf},
                              {inf, -1, 0.0},
                              {inf, 0.5, inf},
                              {NAN, 1, NAN},
                              {2, NAN, NAN},
                              {2, 1024, inf},
                              {-2, 1023, -0x1p1023},
                              {2, -1074, TINY},
                              {2, -1076, 0.0},
                              {-2, -1077, -0.0},
                              {2, 0.5, 0x1.6a09e667f3bcdp+0},
                              {10, 3, 1000},
                              {-3, 3, -27},
                              {TINY, -1, inf},
                              {TINY, 0.5, 0x1p-537},
                              {-1, 0x1p53, 1},
                              {-1, 0x1.fffffffffffffp52, -1},
                              {1e300, 1, 1e300},
                              {DBL_MAX, -1, 0x1p-1024},
                              {2, TINY, 1},
                              {0.0, TINY, 0.0},
                              {inf, TINY, inf},
                              {1 + DBL_EPSILON, DBL_MAX, inf},
                              {-DBL_MAX, 3, -inf}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_bits(mt_pow(rows[i][0], rows[i][1]), rows[i][2]);
    }
}

static void exact_powers_and_roots_are_exact(void **state)
{
    (void)state;
    for (int i = 1; i < 2000; i++) {
        double x = i;
        assert_bits(mt_pow(x, 1), x);
        assert_bits(mt_pow(x, 2), x * x);
        assert_bits(mt_pow(-x, 3), -x * x * x);
        assert_bits(mt_pow(x * x, 0.5), x);
        assert_bits(mt_cbrt(x * x * x), x);
    }
    for (int i = -1074; i < 1024; i++) {
        assert_bits(mt_pow(2, i), ldexp(1, i));
    }
    for (int i = -358; i < 342; i++) {
        assert_bits(mt_cbrt(ldexp(-1, 3 * i)), ldexp(-1, i));
    }
}

static void cube_root_special_values(void **state)
{
    (void)state;
    assert_bits(mt_cbrt(0.0), 0.0);
    assert_bits(mt_cbrt(-0.0), -0.0);
    assert_bits(mt_cbrt(INFINITY), INFINITY);
    assert_bits(mt_cbrt(-INFINITY), -INFINITY);
    assert_bits(mt_cbrt(NAN), NAN);
    assert_bits(mt_cbrt(TINY), 0x1p-358);
    assert_bits(mt_cbrt(3), 0x1.7137449123ef6p+0);
}

/* Walking up in steps of the last place, no function may step back. */
static void monotonic_where_the_function_is(void **state)
{
    (void)state;
    const double starts[] = {0.005, 0.4921875, 0.5, 0.7071067811865, 0.999999999999, 1.5, 1.4142135623730949, 20};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        double x = starts[i];
        for (int step = 0; step < 3000; step++) {
            double next = nextafter(x, INFINITY);
            assert_true(mt_exp(next) >= mt_exp(x));
            assert_true(mt_log(next) >= mt_log(x));
            assert_true(mt_atan(next) >= mt_atan(x));
            assert_true(mt_cbrt(next) >= mt_cbrt(x));
            if (next < 1) {
                assert_true(mt_sin(next) >= mt_sin(x));
                assert_true(mt_cos(next) <= mt_cos(x));
                assert_true(mt_asin(next) >= mt_asin(x));
                assert_true(mt_acos(next) <= mt_acos(x));
            }
            x = next;
        }
    }
}

/* The bits of every function over a fixed sequence of arguments, as one number: any compiler, option or processor
 * that changes a bit changes it. A better algorithm changes it too; then it is written anew, once. */
static void bits_are_the_same_everywhere(void **state)
{
    (void)state;
    double (*const functions[])(double) = {mt_sin, mt_cos, mt_tan, mt_asin, mt_acos, mt_atan, mt_exp, mt_log, mt_cbrt};
    enum { FUNCTION_COUNT = sizeof functions / sizeof *functions };
    test_random random = {9};
    uint64_t hash = 0;
    for (int i = 0; i < 20000; i++) {
        double results[FUNCTION_COUNT + 2];
        double x = next_signed_unit(&random) * (i % 3 == 0 ? ldexp(1, i % 1024) : 1), y = next_signed_unit(&random);
        for (int j = 0; j < FUNCTION_COUNT; j++) {
            results[j] = functions[j](x);
        }
        results[FUNCTION_COUNT] = mt_atan2(x, y);
        results[FUNCTION_COUNT + 1] = mt_pow(fabs(x), 5 * y);
        for (int j = 0; j < FUNCTION_COUNT + 2; j++) {
            /* The sign and payload of a NaN are free. */
            results[j] = isnan(results[j]) ? 0.25 : results[j];
        }
        hash = hash * 3 + test_hash(results, sizeof results);
    }
    assert_int_equal(hash, UINT64_C(0x96eb8915658cb2b7));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trigonometric_special_values), cmocka_unit_test(trigonometric_known_values),
        cmocka_unit_test(trigonometric_identities),     cmocka_unit_test(inverse_trigonometric_special_values),
        cmocka_unit_test(atan2_special_values),         cmocka_unit_test(inverse_functions_lead_back),
        cmocka_unit_test(exponential_special_values),   cmocka_unit_test(logarithm_special_values),
        cmocka_unit_test(power_special_values),         cmocka_unit_test(exact_powers_and_roots_are_exact),
        cmocka_unit_test(cube_root_special_values),     cmocka_unit_test(monotonic_where_the_function_is),
        cmocka_unit_test(bits_are_the_same_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
