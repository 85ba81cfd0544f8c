/* A polygon whose area vector is no plain double is scaled by a power of two until its largest difference is about 1,
 * which is exact. Where the terms then cancel, they are summed again in two doubles a number. */
#include "lib/base/double_double.h"

#include <meshtool/area_vector.h>

/* Past this a difference of two coordinates may overflow. */
#define LARGEST_DIFFERENCE 0x1p1021

/* Relative error of a sum of two doubles a number, for each point. */
#define DOUBLE_ERROR 0x1p-98

typedef struct polygon {
    mt_point_function point;
    const void *user;
    mt_index count;
    int shift; /* points are multiplied by 2^shift */
} polygon;

static mt_vec3 shifted_point(const polygon *p, mt_index i)
{
    return mt_shift_vector(p->point(p->user, i), p->shift);
}

static bool is_finite(const polygon *p, double *largest)
{
    *largest = 0;
    for (mt_index i = 0; i < p->count; i++) {
        mt_vec3 point = p->point(p->user, i);
        if (!mt_vec3_is_finite(point)) {
            return false;
        }
        *largest = fmax(*largest, mt_largest_component(point));
    }
    return true;
}

/* False when there is no area to be found. */
static bool find_shift(polygon *p)
{
    double largest = 0, difference = 0;
    if (!is_finite(p, &largest)) {
        return false;
    }
    p->shift = largest > LARGEST_DIFFERENCE ? -2 : 0;
    mt_vec3 origin = shifted_point(p, 0);
    for (mt_index i = 1; i < p->count; i++) {
        difference = fmax(difference, mt_largest_component(mt_vec3_subtract(shifted_point(p, i), origin)));
    }
    int exponent = 0;
    frexp(difference, &exponent);
    p->shift -= exponent;
    return difference > 0;
}

static mt_area_sum sum_plainly(const polygon *p)
{
    mt_vec3 origin = shifted_point(p, 0);
    mt_area_sum area;
    mt_area_sum_begin(&area, mt_vec3_subtract(shifted_point(p, 1), origin));
    for (mt_index i = 2; i < p->count; i++) {
        mt_area_sum_add(&area, mt_vec3_subtract(shifted_point(p, i), origin));
    }
    return area;
}

typedef struct dd_vec3 {
    double_double x, y, z;
} dd_vec3;

static dd_vec3 exact_difference(mt_vec3 a, mt_vec3 b)
{
    return (dd_vec3){dd_sum(a.x, -b.x), dd_sum(a.y, -b.y), dd_sum(a.z, -b.z)};
}

static double_double add_determinant(double_double sum, double_double a, double_double b, double_double c,
                                     double_double d)
{
    return dd_add(sum, dd_subtract(dd_multiply(a, d), dd_multiply(b, c)));
}

static mt_vec3 sum_carefully(const polygon *p)
{
    mt_vec3 origin = shifted_point(p, 0);
    dd_vec3 side = exact_difference(shifted_point(p, 1), origin), sum = {{0, 0}, {0, 0}, {0, 0}};
    for (mt_index i = 2; i < p->count; i++) {
        dd_vec3 next = exact_difference(shifted_point(p, i), origin);
        sum.x = add_determinant(sum.x, side.y, side.z, next.y, next.z);
        sum.y = add_determinant(sum.y, side.z, side.x, next.z, next.x);
        sum.z = add_determinant(sum.z, side.x, side.y, next.x, next.y);
        side = next;
    }
    mt_vec3 result = mt_vec3_make(sum.x.high, sum.y.high, sum.z.high);
    bool is_noise = mt_largest_component(result) <= p->count * DOUBLE_ERROR;
    return is_noise ? mt_vec3_make(0, 0, 0) : result;
}

mt_scaled_vector mt_polygon_area_vector(mt_point_function point, const void *user, mt_index count)
{
    polygon p = {point, user, count, 0};
    mt_area_sum area = sum_plainly(&p);
    bool is_plain = mt_is_plain(area.sum) && mt_area_sum_is_sure(&area);
    if (!is_plain && !find_shift(&p)) {
        return (mt_scaled_vector){{0, 0, 0}, 0};
    }
    if (!is_plain) {
        area = sum_plainly(&p);
    }
    mt_vec3 vector = mt_area_sum_is_sure(&area) ? area.sum : sum_carefully(&p);
    return (mt_scaled_vector){vector, -2 * p.shift};
}

static mt_vec3 point_of_three(const void *user, mt_index i)
{
    return ((const mt_vec3 *)user)[i];
}

mt_corner_span mt_corner_span_of(mt_vec3 at, mt_vec3 next, mt_vec3 previous)
{
    const mt_vec3 points[3] = {at, next, previous};
    polygon p = {point_of_three, points, 3, 0};
    mt_area_sum area = sum_plainly(&p);
    if (mt_is_plain(area.sum) && mt_area_sum_is_sure(&area)) {
        return (mt_corner_span){mt_vec3_subtract(next, at), area.side, area.sum, 0};
    }
    if (!find_shift(&p)) {
        return (mt_corner_span){{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
    }
    mt_vec3 origin = mt_shift_vector(at, p.shift);
    area = sum_plainly(&p);
    return (mt_corner_span){mt_vec3_subtract(mt_shift_vector(next, p.shift), origin),
                            mt_vec3_subtract(mt_shift_vector(previous, p.shift), origin),
                            mt_area_sum_is_sure(&area) ? area.sum : sum_carefully(&p), -p.shift};
}

mt_vec3 mt_unit_vector(mt_vec3 a)
{
    if (mt_is_plain(a)) {
        return mt_plain_unit(a);
    }
    double largest = mt_vec3_is_finite(a) ? mt_largest_component(a) : 0;
    if (!(largest > 0)) {
        return mt_vec3_make(0, 0, 0);
    }
    int exponent = 0;
    frexp(largest, &exponent);
    return mt_plain_unit(mt_shift_vector(a, -exponent));
}
