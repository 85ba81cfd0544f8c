/* log by table: x = 2^e m with sqrt(1/2) <= m <= sqrt(2); c = j/256 next to 1/m, so that r = m c - 1 is
 * exact in two doubles and |r| < 2^-8.4; log(x) = e log(2) - log(c) + log(1 + r). The first two are kept
 * to 95 bits and more, the linear and the quadratic term of log(1 + r) in two doubles, the rest is
 * Taylor's series to r^8 in one: an error of 2^-68 relative even next to 1, where e = 0 and c = 1. */
#include <meshtool/elementary.h>

#include "lib/base/elementary_exponential.h"
#include "lib/base/elementary_tables.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* log(2) in two parts; the first has 42 bits, so that its product with an exponent is exact. */
#define LOG_2_HIGH 0x1.62e42fefa38p-1
#define LOG_2_LOW 0x1.ef35793c7673p-45

static uint64_t bits_of(double x)
{
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double x = 0;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x = mantissa * 2^*exponent, sqrt(1/2) <= mantissa <= sqrt(2). */
static double split_exponent(double x, int *exponent)
{
    int shift = 0;
    if (x < 0x1p-1022) {
        x *= 0x1p54;
        shift = 54;
    }
    uint64_t bits = bits_of(x);
    *exponent = (int)(bits >> 52) - 1023 - shift;
    double mantissa = double_of((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
    if (mantissa > 0x1.6a09e667f3bcdp0) {
        mantissa *= 0.5;
        *exponent += 1;
    }
    return mantissa;
}

double_double mt_logarithm_sum(double x)
{
    int exponent = 0;
    double mantissa = split_exponent(x, &exponent);
    int inverse = (int)(256 / mantissa + 0.5);
    double c = inverse / 256.0;
    /* c has 9 bits and the upper part of the mantissa 32: all of these products are exact. */
    double upper = double_of(bits_of(mantissa) & 0xffffffffffe00000);
    double_double r = dd_sum(upper * c - 1, (mantissa - upper) * c);
    double_double offset = mt_table_logarithm[inverse - MT_TABLE_LOGARITHM_FIRST];

    double h = r.high;
    double cubic =
        h * h * h * (1.0 / 3 - h * (1.0 / 4 - h * (1.0 / 5 - h * (1.0 / 6 - h * (1.0 / 7 - h * (1.0 / 8))))));
    double_double square = dd_product(h, h);
    double_double sum = dd_sum(exponent * LOG_2_HIGH, offset.high);
    double_double linear = dd_sum(sum.high, h);
    double_double quadratic = dd_sum(linear.high, -0.5 * square.high);
    double low = (exponent * LOG_2_LOW + offset.low) + sum.low + linear.low + quadratic.low;
    low += (r.low - h * r.low) - 0.5 * square.low + cubic;
    return dd_quick_sum(quadratic.high, low);
}

double mt_log(double x)
{
    if (isnan(x) || x < 0) {
        return NAN;
    }
    if (x == 0) {
        return -INFINITY;
    }
    return isinf(x) ? x : mt_logarithm_sum(x).high;
}
