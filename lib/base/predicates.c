/* The determinants behind the predicates, evaluated in integers. The axes may be scaled apart, each
 * by a positive factor, without a change of sign: so every axis is brought to integers by the lowest
 * bit that one of its coordinates has, and the usual mesh, whose coordinates are of like size, needs
 * few limbs. Time grows with the square (2D) and the cube (3D) of the span of exponents, up to some
 * twenty microseconds when 2^-1074 meets 2^1023; space is the stack's, 10 KB. */
#include <meshtool/predicates.h>

#include "lib/base/wide_integer.h"

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
    /* The common degenerate cases need no integers: two points are one, or all lie on a grid line. */
    if (is_same_2d(a, b) || is_same_2d(b, c) || is_same_2d(c, a) || (a[0] == c[0] && b[0] == c[0]) ||
        (a[1] == c[1] && b[1] == c[1])) {
        return 0;
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

/* Whether two points are one or all lie in a plane of an axis: zero, and no integers needed. */
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
