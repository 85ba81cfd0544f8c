/* All of these are the angle of a point (x, y) in the first quadrant, mirrored: for y <= x the nearest
 * t = i/64 to y/x gives atan(y/x) = atan(t) + atan(u), u = (y - t x) / (x + t y), |u| <= 1/128, where u
 * and the table are good to 100 bits and atan(u) is Taylor's series to u^9, the linear term in two
 * doubles: 2^-66 relative before the last rounding. asin(x) and acos(x) are the angles of
 * (sqrt(1 - x^2), x) and (x, sqrt(1 - x^2)) with the root in two doubles. */
#include <meshtool/elementary.h>

#include "lib/base/elementary_tables.h"

#include <math.h>

/* Below this x differs from atan x and asin x by less than 2^-55 of it. */
#define TINY_SINE 0x1p-27

/* A ratio of coordinates below this is its own arc tangent and, added to pi/2 or pi, is lost. */
#define TINY_RATIO 0x1p-70

static const double_double zero = {0, 0};
static const double_double half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
static const double_double pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/* atan(y / x) for 0 <= y <= x, x > 0. */
static double_double angle_in_octant(double_double y, double_double x)
{
    int index = (int)(64 * (y.high / x.high) + 0.5);
    double t = index / 64.0;
    double_double up = dd_product(x.high, t), along = dd_product(y.high, t);
    double_double numerator = dd_sum(y.high, -up.high), denominator = dd_quick_sum(x.high, along.high);
    numerator.low += y.low - up.low - x.low * t;
    denominator.low += x.low + along.low + y.low * t;
    double_double u = dd_divide(numerator, denominator);
    double h = u.high, square = h * h;
    double cubic = h * square * (1.0 / 3 - square * (1.0 / 5 - square * (1.0 / 7 - square * (1.0 / 9))));
    double_double offset = mt_table_arctangent[index];
    double_double sum = dd_sum(offset.high, h);
    return dd_quick_sum(sum.high, sum.low + (offset.low + u.low - cubic));
}

/* The angle of (x, y), both at least 0 and not both 0. */
static double_double angle_in_quadrant(double_double y, double_double x)
{
    if (y.high > x.high) {
        return dd_subtract(half_pi, angle_in_octant(x, y));
    }
    return angle_in_octant(y, x);
}

/* sqrt(1 - x^2) for |x| <= 1. */
static double_double complementary_sine(double x)
{
    double_double square = dd_multiply(dd_sum(1, -x), dd_sum(1, x));
    if (square.high <= 0) {
        return zero;
    }
    double root = sqrt(square.high);
    double_double own_square = dd_product(root, root);
    double remainder = (square.high - own_square.high) - own_square.low + square.low;
    return dd_quick_sum(root, remainder / (2 * root));
}

static double_double from_double(double x)
{
    double_double result = {x, 0};
    return result;
}

double mt_atan(double x)
{
    if (isnan(x) || fabs(x) < TINY_SINE) {
        return x;
    }
    double magnitude = fabs(x);
    if (magnitude > 0x1p60) {
        return copysign(half_pi.high, x);
    }
    return copysign(angle_in_quadrant(from_double(magnitude), from_double(1)).high, x);
}

double mt_asin(double x)
{
    if (isnan(x) || fabs(x) > 1) {
        return NAN;
    }
    if (fabs(x) < TINY_SINE) {
        return x;
    }
    return copysign(angle_in_quadrant(from_double(fabs(x)), complementary_sine(x)).high, x);
}

double mt_acos(double x)
{
    if (isnan(x) || fabs(x) > 1) {
        return NAN;
    }
    double_double angle = angle_in_quadrant(complementary_sine(x), from_double(fabs(x)));
    return x < 0 ? dd_subtract(pi, angle).high : angle.high;
}

/* The angle of (x, y) for magnitudes that are 0 or infinite. */
static double_double angle_at_limit(double y, double x)
{
    if (isinf(y) && isinf(x)) {
        return dd_multiply_double(half_pi, 0.5);
    }
    return y == 0 || isinf(x) ? zero : half_pi;
}

/* The angle of (x, y) for positive finite magnitudes. */
static double_double angle_of_magnitudes(double y, double x)
{
    double large = y > x ? y : x;
    double small = y > x ? x : y;
    if (small / large < TINY_RATIO) {
        return y > x ? half_pi : from_double(y / x);
    }
    if (large > 0x1p300 || large < 0x1p-300) {
        /* Brings the larger into [1/2, 1); the smaller is then normal too, so both steps are exact. */
        int exponent = 0;
        (void)frexp(large, &exponent);
        y = ldexp(y, -exponent);
        x = ldexp(x, -exponent);
    }
    return angle_in_quadrant(from_double(y), from_double(x));
}

double mt_atan2(double y, double x)
{
    if (isnan(x) || isnan(y)) {
        return NAN;
    }
    double y_size = fabs(y), x_size = fabs(x);
    int is_limit = y_size == 0 || x_size == 0 || isinf(y_size) || isinf(x_size);
    double_double angle = is_limit ? angle_at_limit(y_size, x_size) : angle_of_magnitudes(y_size, x_size);
    if (signbit(x)) {
        angle = dd_subtract(pi, angle);
    }
    return copysign(angle.high, y);
}
