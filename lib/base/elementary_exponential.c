/* exp by table: x = (64 m + j) log(2) / 64 + r with |r| < 0.0055, so exp(x) = 2^m 2^(j/64) exp(r). The
 * table holds 2^(j/64) to 106 bits, exp(r) - 1 is Taylor's series to r^6 (the rest is below 2^-65).
 * The sum of a table value and a product 2^-7 as large is rounded once, hence an error of
 * 0.52 ulp at most; where the result is subnormal it is rounded once more, to below 1 ulp. */
#include "lib/base/elementary_exponential.h"

#include <meshtool/elementary.h>

#include "lib/base/elementary_tables.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* log(2) / 64 in two parts; the first has 36 bits, so that its product with |64 m + j| < 2^17 is exact. */
#define STEP_HIGH 0x1.62e42fefap-7
#define STEP_LOW 0x1.cf79abc9e3b3ap-46
#define STEPS_PER_UNIT 0x1.71547652b82fep+6

/* a * 2^exponent, rounded once. */
static double scale(double a, int exponent)
{
    if (exponent < -1020 || exponent > 1022) {
        return ldexp(a, exponent);
    }
    uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power = 0;
    memcpy(&power, &bits, sizeof power);
    return a * power;
}

double mt_exponential_of_sum(double high, double low)
{
    if (high > 710) {
        return INFINITY;
    }
    if (high < -746) {
        return 0;
    }
    int step = (int)(high * STEPS_PER_UNIT + (high < 0 ? -0.5 : 0.5));
    int index = step & (MT_TABLE_POWER_COUNT - 1);
    double_double r = dd_sum(high - step * STEP_HIGH, low - step * STEP_LOW);
    double x = r.high;
    double series = x * x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x * (1.0 / 720)))));
    double growth = x + (r.low + series);
    double_double power = mt_table_power_of_two[index];
    return scale(power.high + (power.low + power.high * growth), (step - index) / MT_TABLE_POWER_COUNT);
}

double mt_exp(double x)
{
    return isnan(x) ? x : mt_exponential_of_sum(x, 0);
}
