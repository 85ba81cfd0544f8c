/* Vectors of three doubles. Sums and products are evaluated in the order written; the library is
 * compiled without contraction, so the bits are the same on every machine. */
#ifndef MESHTOOL_VECTOR_H
#define MESHTOOL_VECTOR_H

#include <meshtool/types.h>

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_vec3 {
    double x, y, z;
} mt_vec3;

static inline mt_vec3 mt_vec3_make(double x, double y, double z)
{
    mt_vec3 v = {x, y, z};
    return v;
}

static inline mt_vec3 mt_vec3_add(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline mt_vec3 mt_vec3_subtract(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline mt_vec3 mt_vec3_scale(mt_vec3 a, double s)
{
    return mt_vec3_make(a.x * s, a.y * s, a.z * s);
}

static inline double mt_vec3_dot(mt_vec3 a, mt_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline mt_vec3 mt_vec3_cross(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double mt_vec3_length(mt_vec3 a)
{
    return sqrt(mt_vec3_dot(a, a));
}

/* The largest absolute component; NaN when one is NaN. */
static inline double mt_vec3_max_abs(mt_vec3 a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    double m = x > y ? x : y;
    m = m > z ? m : z;
    return (x + y + z != x + y + z) ? NAN : m;
}

static inline bool mt_vec3_is_finite(mt_vec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* Unit vector along a, right from the smallest to the largest doubles (scaled by a power of two
 * first); the zero vector where a is zero or not finite. */
mt_vec3 mt_vec3_normalize(mt_vec3 a);

/* The power of two 2^-e for which the largest absolute component of scaled vectors lies in [0.5, 1):
 * multiplying by it is exact as long as nothing becomes subnormal. 2^1023, the largest there is, for
 * anything below 2^-1023, which it brings to at least 2^-51. 1 for zero and non-finite input. */
double mt_power_of_two_scale(double largest);

#ifdef __cplusplus
}
#endif
#endif
