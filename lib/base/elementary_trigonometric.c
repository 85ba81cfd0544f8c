/* sin, cos and tan: the angle reduced to |r| <= pi/4, then Taylor's series, of which the first two terms
 * are kept in two doubles and the rest, at most 1/60 of the sum, in one: sine and cosine are good to
 * 2^-57 before the last rounding. The series stop where the rest is below 2^-62. */
#include <meshtool/elementary.h>

#include "lib/base/angle_reduction.h"

#include <math.h>

/* Below this x differs from sin x and tan x by less than 2^-55 of it, and cos x from 1. */
#define TINY_ANGLE 0x1p-27

static double_double sine_of_remainder(double_double r)
{
    static const double_double sixth = {0x1.5555555555555p-3, 0x1.5555555555555p-57};
    double_double square = dd_multiply(r, r);
    double_double cubic = dd_multiply(dd_multiply(square, r), sixth);
    double z = square.high;
    double series =
        1.0 / 120 -
        z * (1.0 / 5040 -
             z * (1.0 / 362880 - z * (1.0 / 39916800 - z * (1.0 / 6227020800 -
                                                            z * (1.0 / 1307674368000 - z * (1.0 / 355687428096000))))));
    double_double sum = dd_quick_sum(r.high, -cubic.high);
    return dd_quick_sum(sum.high, sum.low + (r.low - cubic.low + r.high * z * z * series));
}

static double_double cosine_of_remainder(double_double r)
{
    double_double square = dd_multiply(r, r);
    double z = square.high;
    double series =
        1.0 / 24 -
        z * (1.0 / 720 -
             z * (1.0 / 40320 -
                  z * (1.0 / 3628800 -
                       z * (1.0 / 479001600 -
                            z * (1.0 / 87178291200 - z * (1.0 / 20922789888000 - z * (1.0 / 6402373705728000)))))));
    double_double sum = dd_quick_sum(1, -0.5 * z);
    return dd_quick_sum(sum.high, sum.low + (z * z * series - 0.5 * square.low));
}

/* sin(remainder + quadrant pi/2). */
static double sine_in_quadrant(double_double remainder, int quadrant)
{
    double value = (quadrant & 1) != 0 ? cosine_of_remainder(remainder).high : sine_of_remainder(remainder).high;
    return (quadrant & 2) != 0 ? -value : value;
}

double mt_sin(double x)
{
    if (!isfinite(x)) {
        return NAN;
    }
    if (fabs(x) < TINY_ANGLE) {
        return x;
    }
    reduced_angle angle = mt_reduce_angle(x);
    return sine_in_quadrant(angle.remainder, angle.quadrant);
}

double mt_cos(double x)
{
    if (!isfinite(x)) {
        return NAN;
    }
    if (fabs(x) < TINY_ANGLE) {
        return 1;
    }
    reduced_angle angle = mt_reduce_angle(x);
    return sine_in_quadrant(angle.remainder, angle.quadrant + 1);
}

double mt_tan(double x)
{
    if (!isfinite(x)) {
        return NAN;
    }
    if (fabs(x) < TINY_ANGLE) {
        return x;
    }
    reduced_angle angle = mt_reduce_angle(x);
    double_double sine = sine_of_remainder(angle.remainder);
    double_double cosine = cosine_of_remainder(angle.remainder);
    if ((angle.quadrant & 1) != 0) {
        return -dd_divide(cosine, sine).high;
    }
    return dd_divide(sine, cosine).high;
}
