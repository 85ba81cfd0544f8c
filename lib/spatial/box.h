/* Boxes as pairs of vectors of four, of which the fourth lane is somebody's number and never looked at. */
#ifndef MT_SPATIAL_BOX_H
#define MT_SPATIAL_BOX_H

#include <meshtool/aabb_tree.h>

#include <string.h>

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

static inline bool box_overlaps(box a, box b)
{
    int4 inside = (a.lower <= b.upper) & (b.lower <= a.upper);
    return (inside[0] & inside[1] & inside[2]) != 0;
}

static inline box box_empty(void)
{
    box b = {{INFINITY, INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};
    return b;
}

/* Lane by lane the smaller and the larger; a NaN in the fourth lane does no harm. */
static inline float4 float4_minimum(float4 a, float4 b)
{
    int4 less = a < b;
    return (float4)(((int4)a & less) | ((int4)b & ~less));
}

static inline float4 float4_maximum(float4 a, float4 b)
{
    int4 less = a < b;
    return (float4)(((int4)b & less) | ((int4)a & ~less));
}

static inline box box_join(box a, box b)
{
    box joined = {float4_minimum(a.lower, b.lower), float4_maximum(a.upper, b.upper)};
    return joined;
}

#endif
