/* The sign of a sum of tetrahedra, in integers: no filter can tell a closed surface of volume zero from one that nearly
 * is. As with the other predicates every axis is brought to integers by the lowest bit of its coordinates. */
#include <meshtool/predicates.h>

#include "lib/base/wide_integer.h"

#include <limits.h>

static double coordinate(mt_vec3 point, int axis)
{
    return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

/* False when a coordinate is not finite. */
static bool find_exponents(const mt_vec3 *corners, uint64_t corner_count, int exponents[3])
{
    for (int axis = 0; axis < 3; axis++) {
        exponents[axis] = INT_MAX;
        for (uint64_t i = 0; i < corner_count; i++) {
            double x = coordinate(corners[i], axis);
            if (!isfinite(x)) {
                return false;
            }
            int own = wide_lowest_exponent(x);
            exponents[axis] = own < exponents[axis] ? own : exponents[axis];
        }
        exponents[axis] = exponents[axis] == INT_MAX ? 0 : exponents[axis];
    }
    return true;
}

/* *sum += sign * x * y * z */
static void add_product(const wide_integer *x, const wide_integer *y, const wide_integer *z, int sign,
                        wide_integer *sum)
{
    wide_integer two, three;
    wide_multiply(x, y, &two);
    wide_multiply(&two, z, &three);
    wide_add(sum, &three, sign, sum);
}

static void add_determinant(const mt_vec3 corner[3], const int exponents[3], wide_integer *sum)
{
    wide_integer integers[3][3];
    for (int i = 0; i < 3; i++) {
        for (int axis = 0; axis < 3; axis++) {
            wide_from_double(coordinate(corner[i], axis), exponents[axis], &integers[i][axis]);
        }
    }
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3, last = (i + 2) % 3;
        add_product(&integers[i][0], &integers[next][1], &integers[last][2], 1, sum);
        add_product(&integers[i][0], &integers[last][1], &integers[next][2], -1, sum);
    }
}

int mt_volume_sign(const mt_vec3 *corners, uint64_t triangle_count)
{
    int exponents[3];
    if (!find_exponents(corners, 3 * triangle_count, exponents)) {
        return 0;
    }
    wide_integer sum;
    sum.sign = 0;
    sum.count = 0;
    for (uint64_t t = 0; t < triangle_count; t++) {
        add_determinant(corners + 3 * t, exponents, &sum);
    }
    return sum.sign;
}
