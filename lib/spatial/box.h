/* Boxes as pairs of vectors of four, of which the fourth lane is somebody's number and never looked at. */
#ifndef MT_SPATIAL_BOX_H
#define MT_SPATIAL_BOX_H

#include <meshtool/aabb_tree.h>

#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

typedef float float4 __attribute__((vector_size(16)));
typedef int32_t int4 __attribute__((vector_size(16)));

typedef struct box {
    float4 lower, upper;
} box;

/* The box of a node or a primitive, whose records are a box throughout. */
static inline box box_load(const void *record)
{
    box b;
    memcpy(&b, record, sizeof b);
    return b;
}

/* A bit for each lane that is set throughout; lanes are set throughout or not at all. */
static inline unsigned int4_lanes(int4 lanes)
{
#ifdef __SSE2__
    return (unsigned)_mm_movemask_ps((__m128)lanes);
#else
    return (unsigned)((lanes[0] & 1) | (lanes[1] & 2) | (lanes[2] & 4) | (lanes[3] & 8));
#endif
}

static inline bool box_overlaps(box a, box b)
{
    return (int4_lanes((a.lower <= b.upper) & (b.lower <= a.upper)) & 7) == 7;
}

static inline box box_empty(void)
{
    box b = {{INFINITY, INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};
    return b;
}

/* Lane by lane the smaller and the larger; a NaN in the fourth lane does no harm. */
static inline float4 float4_minimum(float4 a, float4 b)
{
#ifdef __SSE2__
    return (float4)_mm_min_ps((__m128)a, (__m128)b);
#else
    int4 less = a < b;
    return (float4)(((int4)a & less) | ((int4)b & ~less));
#endif
}

static inline float4 float4_maximum(float4 a, float4 b)
{
#ifdef __SSE2__
    return (float4)_mm_max_ps((__m128)b, (__m128)a);
#else
    int4 less = a < b;
    return (float4)(((int4)b & less) | ((int4)a & ~less));
#endif
}

static inline box box_join(box a, box b)
{
    box joined = {float4_minimum(a.lower, b.lower), float4_maximum(a.upper, b.upper)};
    return joined;
}

#endif
