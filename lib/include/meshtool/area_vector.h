/* Area vectors: along the normal of a polygon, as long as twice its area, whatever the magnitude of the coordinates,
 * their distance from the origin and the shape of the polygon.
 *
 * Results do not depend on which axis is called x: turning the points by quarter turns turns the result bit for bit,
 * and scaling them by a power of two scales it bit for bit. */
#ifndef MESHTOOL_AREA_VECTOR_H
#define MESHTOOL_AREA_VECTOR_H

#include <meshtool/clones.h>
#include <meshtool/vector.h>

#ifdef __cplusplus
extern "C" {
#endif

/* vector * 2^exponent; the zero vector where there is no area, or a coordinate that is not finite. */
typedef struct mt_scaled_vector {
    mt_vec3 vector;
    int exponent;
} mt_scaled_vector;

/* Point number i of a polygon. */
typedef mt_vec3 (*mt_point_function)(const void *user, mt_index i);

/* Twice the area vector of a polygon of `count` points, at least 3, planar or not: the sum over the triangles that its
 * first point forms with each side, whose direction is that of the plane nearest to it and whose length is the area
 * seen along it. Right to a few units in the last place where doubles of the points' differences give that, else summed
 * in two doubles a number: a triangle of aspect 2^-60 keeps as many digits as its points have. Zero where the polygon
 * is thinner than about 2^-96 of its length. */
mt_scaled_vector mt_polygon_area_vector(mt_point_function point, const void *user, mt_index count);

/* What a corner spans: its two sides from `at`, times 2^-exponent, and their cross product, times 4^-exponent, as right
 * as mt_polygon_area_vector. All zero when a coordinate is not finite. */
typedef struct mt_corner_span {
    mt_vec3 to_next, to_previous, cross;
    int exponent;
} mt_corner_span;
mt_corner_span mt_corner_span_of(mt_vec3 at, mt_vec3 next, mt_vec3 previous);

/* The area vector of a polygon, summed point by point in differences to its first point. */
typedef struct mt_area_sum {
    mt_vec3 side;     /* the last point's difference */
    mt_vec3 sum;      /* twice the area vector */
    double magnitude; /* bounds the terms */
} mt_area_sum;

/* a * 2^exponent. */
static inline mt_vec3 mt_shift_vector(mt_vec3 a, int exponent)
{
    if (exponent == 0) {
        return a;
    }
    return mt_vec3_make(ldexp(a.x, exponent), ldexp(a.y, exponent), ldexp(a.z, exponent));
}

/* The largest absolute component, of any value when one is NaN. */
MT_INLINE double mt_largest_component(mt_vec3 a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    double m = x > y ? x : y;
    return m > z ? m : z;
}

MT_INLINE void mt_area_sum_begin(mt_area_sum *area, mt_vec3 second)
{
    area->side = second;
    area->sum = mt_vec3_make(0, 0, 0);
    area->magnitude = 0;
}

MT_INLINE void mt_area_sum_add(mt_area_sum *area, mt_vec3 next)
{
    area->sum = mt_vec3_add(area->sum, mt_vec3_cross(area->side, next));
    area->magnitude += mt_largest_component(area->side) * mt_largest_component(next);
    area->side = next;
}

/* Where terms cancel to less than this share of them, more digits are taken. Smaller: normals of thinner faces lose up
 * to 2^-53 / share of their direction; larger: more faces take the slow way. */
#define MT_AREA_CANCELLATION 0x1p-20

/* Area vectors within these bounds can be squared, and a million of them summed. */
#define MT_PLAIN_MINIMUM 0x1p-400
#define MT_PLAIN_MAXIMUM 0x1p400

static inline bool mt_vector_is_zero(mt_vec3 a)
{
    return a.x == 0 && a.y == 0 && a.z == 0;
}

/* Whether a vector's length can be found without scaling; false when a component is not finite. */
MT_INLINE bool mt_is_plain(mt_vec3 a)
{
    double sum = fabs(a.x) + fabs(a.y) + fabs(a.z);
    return sum > MT_PLAIN_MINIMUM && sum < MT_PLAIN_MAXIMUM;
}

/* Whether the digits of the sum are right. */
MT_INLINE bool mt_area_sum_is_sure(const mt_area_sum *area)
{
    return mt_largest_component(area->sum) > MT_AREA_CANCELLATION * area->magnitude;
}

/* a + b + c, the same for any order of them. */
MT_INLINE double mt_symmetric_sum(double a, double b, double c)
{
    double low = a < b ? a : b, high = a < b ? b : a;
    double middle = high < c ? high : c, top = high < c ? c : high;
    return (low + middle) + top;
}

/* The dot product and the length by it, the same whichever axis is called x. */
MT_INLINE double mt_symmetric_dot(mt_vec3 a, mt_vec3 b)
{
    return mt_symmetric_sum(a.x * b.x, a.y * b.y, a.z * b.z);
}

MT_INLINE mt_vec3 mt_plain_unit(mt_vec3 a)
{
    return mt_vec3_scale(a, 1 / sqrt(mt_symmetric_dot(a, a)));
}

/* Unit vector along a, of any magnitude; the zero vector where a is zero or not finite. */
mt_vec3 mt_unit_vector(mt_vec3 a);

#ifdef __cplusplus
}
#endif
#endif
