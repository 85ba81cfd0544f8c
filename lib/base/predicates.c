/* The determinants behind the predicates where the filter cannot tell, in three steps. First the common
 * degenerate cases by comparison. Then two doubles a number: differences are exact in them, and the
 * error bound is 2^-98 of the permanent, so that whatever is not zero or extreme is decided here, at
 * ten times the filter's cost. Last, integers: the axes may be scaled apart, each by a positive factor,
 * without a change of sign, so every axis is brought to integers by the lowest bit that one of its
 * coordinates has, and the usual mesh, whose coordinates are of like size, needs few limbs. Their time
 * grows with the square (2D) and the cube (3D) of the span of exponents, from 0.5 to some twenty
 * microseconds when 2^-1074 meets 2^1023; space is the stack's, 10 KB. */
#include <meshtool/predicates.h>

#include "lib/base/double_double.h"
#include "lib/base/wide_integer.h"

/* Of the sum of the absolute products. The operations' bounds (Joldes, Muller and Popescu, "Tight and
 * Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic", ACM TOMS 44, 2017) add
 * up to 23 * 2^-106 in 3D; with less than that wrong signs would pass. */
#define RELATIVE_BOUND 0x1p-98

/* Up to this size of the differences nothing overflows, and what underflow takes from a product of three
 * stays below ABSOLUTE_BOUND. */
#define LARGEST_DIFFERENCE 0x1p300
#define ABSOLUTE_BOUND 0x1p-700

/* difference[i] = (coordinate[i] - coordinate[count - 1]) * 2^k, k the same for all. */
static void differences_on_axis(const double *coordinate, int count, wide_integer *difference)
{
    int exponent = wide_lowest_exponent(coordinate[0]);
    for (int i = 1; i < count; i++) {
        int own = wide_lowest_exponent(coordinate[i]);
        exponent = own < exponent ? own : exponent;
    }
    wide_integer last;
    wide_from_double(coordinate[count - 1], exponent, &last);
    for (int i = 0; i < count - 1; i++) {
        wide_from_double(coordinate[i], exponent, &difference[i]);
        wide_add(&difference[i], &last, -1, &difference[i]);
    }
}

/* *result = ax * by - bx * ay. */
static void cross(const wide_integer *ax, const wide_integer *by, const wide_integer *bx, const wide_integer *ay,
                  wide_integer *result)
{
    wide_integer right;
    wide_multiply(ax, by, result);
    wide_multiply(bx, ay, &right);
    wide_add(result, &right, -1, result);
}

/* The sign of value if it is beyond its error bound, else 0. */
static int sign_beyond_bound(double_double value, double permanent)
{
    double bound = RELATIVE_BOUND * permanent + ABSOLUTE_BOUND;
    return (value.high > bound) - (value.high < -bound);
}

static double_double dd_cross(double_double ax, double_double by, double_double bx, double_double ay)
{
    return dd_subtract(dd_multiply(ax, by), dd_multiply(bx, ay));
}

/* The turn of c, a, b where two doubles can tell, else 0. */
static int turn_in_two_doubles(const double a[2], const double b[2], const double c[2])
{
    double_double ax = dd_sum(a[0], -c[0]), ay = dd_sum(a[1], -c[1]);
    double_double bx = dd_sum(b[0], -c[0]), by = dd_sum(b[1], -c[1]);
    double left = fabs(ax.high * by.high), right = fabs(ay.high * bx.high);
    double largest = fmax(fmax(fabs(ax.high), fabs(ay.high)), fmax(fabs(bx.high), fabs(by.high)));
    if (!(largest <= LARGEST_DIFFERENCE)) {
        return 0;
    }
    return sign_beyond_bound(dd_cross(ax, by, bx, ay), left + right);
}

/* The side of d where two doubles can tell, else 0. */
static int side_in_two_doubles(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d)
{
    double_double x[3] = {dd_sum(a.x, -d.x), dd_sum(b.x, -d.x), dd_sum(c.x, -d.x)};
    double_double y[3] = {dd_sum(a.y, -d.y), dd_sum(b.y, -d.y), dd_sum(c.y, -d.y)};
    double_double z[3] = {dd_sum(a.z, -d.z), dd_sum(b.z, -d.z), dd_sum(c.z, -d.z)};
    double_double determinant = {0, 0};
    double permanent = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double largest = fmax(fmax(fabs(x[i].high), fabs(y[i].high)), fabs(z[i].high));
        if (!(largest <= LARGEST_DIFFERENCE)) {
            return 0;
        }
        determinant = dd_add(determinant, dd_multiply(z[i], dd_cross(x[j], y[k], x[k], y[j])));
        permanent += fabs(z[i].high) * (fabs(x[j].high * y[k].high) + fabs(x[k].high * y[j].high));
    }
    return sign_beyond_bound(determinant, permanent);
}

static bool is_finite_2d(const double a[2])
{
    return isfinite(a[0]) && isfinite(a[1]);
}

static bool is_same_2d(const double a[2], const double b[2])
{
    return a[0] == b[0] && a[1] == b[1];
}

int mt_orient2d_exact(const double a[2], const double b[2], const double c[2])
{
    if (!is_finite_2d(a) || !is_finite_2d(b) || !is_finite_2d(c)) {
        return 0;
    }
    /* Two points are one, or all lie on a grid line. */
    if (is_same_2d(a, b) || is_same_2d(b, c) || is_same_2d(c, a) || (a[0] == c[0] && b[0] == c[0]) ||
        (a[1] == c[1] && b[1] == c[1])) {
        return 0;
    }
    int sign = turn_in_two_doubles(a, b, c);
    if (sign != 0) {
        return sign;
    }
    wide_integer x[2], y[2], determinant;
    differences_on_axis((const double[]){a[0], b[0], c[0]}, 3, x);
    differences_on_axis((const double[]){a[1], b[1], c[1]}, 3, y);
    cross(&x[0], &y[1], &x[1], &y[0], &determinant);
    return determinant.sign;
}

static bool is_same_3d(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Whether two points are one or all lie in a plane across an axis. */
static bool is_plainly_degenerate(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d)
{
    return is_same_3d(a, d) || is_same_3d(b, d) || is_same_3d(c, d) || is_same_3d(a, b) || is_same_3d(b, c) ||
           is_same_3d(c, a) || (a.x == d.x && b.x == d.x && c.x == d.x) || (a.y == d.y && b.y == d.y && c.y == d.y) ||
           (a.z == d.z && b.z == d.z && c.z == d.z);
}

int mt_orient3d_exact(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d)
{
    if (!mt_vec3_is_finite(a) || !mt_vec3_is_finite(b) || !mt_vec3_is_finite(c) || !mt_vec3_is_finite(d)) {
        return 0;
    }
    if (is_plainly_degenerate(a, b, c, d)) {
        return 0;
    }
    int sign = side_in_two_doubles(a, b, c, d);
    if (sign != 0) {
        return sign;
    }
    wide_integer x[3], y[3], z[3], minor, product, determinant;
    wide_from_double(0, 0, &determinant);
    differences_on_axis((const double[]){a.x, b.x, c.x, d.x}, 4, x);
    differences_on_axis((const double[]){a.y, b.y, c.y, d.y}, 4, y);
    differences_on_axis((const double[]){a.z, b.z, c.z, d.z}, 4, z);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        cross(&x[j], &y[k], &x[k], &y[j], &minor);
        wide_multiply(&z[i], &minor, &product);
        wide_add(&determinant, &product, 1, &determinant);
    }
    return determinant.sign;
}

bool mt_collinear(mt_vec3 a, mt_vec3 b, mt_vec3 c)
{
    /* The cross product of two sides vanishes when each of its components does. */
    return mt_orient2d((const double[]){a.x, a.y}, (const double[]){b.x, b.y}, (const double[]){c.x, c.y}) == 0 &&
           mt_orient2d((const double[]){a.y, a.z}, (const double[]){b.y, b.z}, (const double[]){c.y, c.z}) == 0 &&
           mt_orient2d((const double[]){a.z, a.x}, (const double[]){b.z, b.x}, (const double[]){c.z, c.x}) == 0;
}

bool mt_collinear_exact(mt_vec3 a, mt_vec3 b, mt_vec3 c)
{
    return mt_orient2d_exact((const double[]){a.x, a.y}, (const double[]){b.x, b.y}, (const double[]){c.x, c.y}) == 0 &&
           mt_orient2d_exact((const double[]){a.y, a.z}, (const double[]){b.y, b.z}, (const double[]){c.y, c.z}) == 0 &&
           mt_orient2d_exact((const double[]){a.z, a.x}, (const double[]){b.z, b.x}, (const double[]){c.z, c.x}) == 0;
}
