/* pow as exp(y log(x)): the logarithm is good to 2^-67 relative and the product at most 746 where the
 * result is finite, so that the exponent is good to 2^-57. */
#include <meshtool/elementary.h>

#include "lib/base/elementary_exponential.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

static bool is_integer(double y)
{
    return fabs(y) >= 0x1p53 || (double)(int64_t)y == y;
}

static bool is_odd_integer(double y)
{
    return fabs(y) < 0x1p53 && (double)(int64_t)y == y && ((int64_t)y & 1) != 0;
}

/* |x|^y for a magnitude that is 0 or infinite, or an exponent that is infinite; |x| is not 1. */
static double limit_power(double magnitude, double y)
{
    return (magnitude > 1) == (y > 0) ? INFINITY : 0;
}

static double power_of_magnitude(double magnitude, double y)
{
    if (magnitude == 1) {
        return 1;
    }
    /* Next to 1 the logarithm is at least 2^-53, so beyond 2^64 nothing is finite. */
    if (magnitude == 0 || isinf(magnitude) || fabs(y) > 0x1p64) {
        return limit_power(magnitude, y);
    }
    if (fabs(y) < 0x1p-70) {
        return 1;
    }
    double_double exponent = dd_multiply_double(mt_logarithm_sum(magnitude), y);
    return mt_exponential_of_sum(exponent.high, exponent.low);
}

double mt_pow(double x, double y)
{
    if (y == 0 || x == 1) {
        return 1;
    }
    if (isnan(x) || isnan(y) || (x < 0 && isfinite(x) && !is_integer(y))) {
        return NAN;
    }
    double power = power_of_magnitude(fabs(x), y);
    return signbit(x) && is_odd_integer(y) ? -power : power;
}
