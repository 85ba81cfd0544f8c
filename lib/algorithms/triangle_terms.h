/* What triangles add to area and volume, two at a time: lane i belongs to triangle i. Each lane does what mt_vec3 does,
 * operation by operation, so that the bits are those of one triangle alone. */
#ifndef MT_ALGORITHMS_TRIANGLE_TERMS_H
#define MT_ALGORITHMS_TRIANGLE_TERMS_H

#include <meshtool/mesh.h>

/* Of the cross product of rounded differences, relative to the sum of the products' sizes; the constant term stands for
 * what underflows. Larger only sends more faces to the exact test. */
#define CROSS_ERROR 0x1p-50
#define CROSS_UNDERFLOW 0x1p-1000

typedef double double2 __attribute__((vector_size(16)));
typedef int64_t long2 __attribute__((vector_size(16)));

typedef struct vector2 {
    double2 x, y, z;
} vector2;

typedef struct triangle2 {
    vector2 corner[3];
} triangle2;

/* A compensated sum (Neumaier) of areas in lane 0 and of volumes in lane 1. */
typedef struct compensated_sum {
    double2 sum, rest;
} compensated_sum;

static inline double2 double2_absolute(double2 a)
{
    return (double2)((long2)a & INT64_MAX);
}

static inline void add_term(compensated_sum *total, double2 term)
{
    double2 sum = total->sum + term;
    long2 is_larger = double2_absolute(total->sum) >= double2_absolute(term);
    double2 larger = (double2)(((long2)total->sum & is_larger) | ((long2)term & ~is_larger));
    double2 smaller = (double2)(((long2)term & is_larger) | ((long2)total->sum & ~is_larger));
    total->rest += (larger - sum) + smaller;
    total->sum = sum;
}

static inline vector2 vector2_subtract(vector2 a, vector2 b)
{
    vector2 difference = {a.x - b.x, a.y - b.y, a.z - b.z};
    return difference;
}

static inline double2 vector2_dot(vector2 a, vector2 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Adds the terms, twice the area and six times the volume, of the first triangle and then of the second. Returns
 * whether neither's corners can lie on one line: the bounds on the components' errors are summed, and where all
 * components were within theirs the sum would be too. */
static inline bool add_two_triangles(const triangle2 *triangles, mt_vec3 origin, compensated_sum *total)
{
    vector2 a = triangles->corner[0];
    vector2 ab = vector2_subtract(triangles->corner[1], a);
    vector2 ac = vector2_subtract(triangles->corner[2], a);
    vector2 plus = {ab.y * ac.z, ab.z * ac.x, ab.x * ac.y};
    vector2 minus = {ab.z * ac.y, ab.x * ac.z, ab.y * ac.x};
    vector2 cross = vector2_subtract(plus, minus);
    vector2 from = {{origin.x, origin.x}, {origin.y, origin.y}, {origin.z, origin.z}};
    double2 square = vector2_dot(cross, cross);
    double2 volume = vector2_dot(vector2_subtract(a, from), cross);
    add_term(total, (double2){sqrt(square[0]), volume[0]});
    add_term(total, (double2){sqrt(square[1]), volume[1]});
    double2 size = double2_absolute(cross.x) + double2_absolute(cross.y) + double2_absolute(cross.z);
    double2 products = double2_absolute(plus.x) + double2_absolute(plus.y) + double2_absolute(plus.z) +
                       double2_absolute(minus.x) + double2_absolute(minus.y) + double2_absolute(minus.z);
    long2 sure = size > 2 * CROSS_ERROR * products + 4 * CROSS_UNDERFLOW;
    return sure[0] && sure[1];
}

#endif
