/* The triangles that rays can hit, in float and in the space of rays, and one ray's search among them. What the
 * structures of ray_structure.h share: each only decides which triangles are tried, and when to stop. */
#ifndef MT_SPATIAL_PACKED_TRIANGLES_H
#define MT_SPATIAL_PACKED_TRIANGLES_H

#include "lib/spatial/box.h"
#include "lib/spatial/ray_formulas.h"
#include "lib/spatial/ray_structure.h"

/* x of the three corners and of the first again, then y, then z. */
typedef struct mt_packed_triangle {
    float rows[3][4];
} mt_packed_triangle;

typedef struct mt_packed_triangles {
    mt_ray_source source;
    mt_index count;            /* those with a corner that is not finite are left out */
    mt_packed_triangle *items; /* at first in the order of their numbers */
    mt_index *numbers;         /* of each in the triangulation */
    float lower[3], upper[3];  /* of all; nothing: above and below */
} mt_packed_triangles;

/* Zeroes what it cannot make. */
mt_status mt_packed_triangles_init(mt_context *context, const mt_ray_source *source, mt_packed_triangles *triangles);
void mt_packed_triangles_release(mt_context *context, mt_packed_triangles *triangles);
/* Bytes held. */
uint64_t mt_packed_triangles_size(const mt_packed_triangles *triangles);
/* Whether every finite triangle of the source stands among them once, as it is in the mesh. MT_ERROR_INTERNAL. */
mt_status mt_packed_triangles_validate(mt_context *context, const mt_packed_triangles *triangles);

/* Checks that structures of entries share. Places of triangles, rising, below `end`. */
bool mt_places_are_rising(const mt_index *places, uint64_t count, mt_index end);
/* Whether rising places have this one. */
bool mt_places_hold(const mt_index *places, uint64_t count, mt_index place);
/* Points of a triangle: its corners, the middles of its sides, and one within. */
#define MT_PACKED_SAMPLES 7
void mt_packed_triangle_sample(const mt_packed_triangle *triangle, int sample, double point[3]);

/* How far off a triangle its point may lie where a ray hits it, on each axis, for rays that pass the test of
 * mt_ray_search_is_near: its slack, the rounding of the corners, and the doubles of whoever walks along the ray. Cells
 * and halves of space hold all triangles that come so near. */
#define MT_RAY_NEARNESS 0x1.4p-19
#define MT_RAY_NEAR_SLACK 0x1p-19f

/* One ray on its way. Parameters count in the setup's direction from the setup's origin. */
typedef struct mt_ray_search {
    mt_ray_setup setup;
    const mt_packed_triangles *triangles;
    bool any;            /* the first hit will do */
    double begin, limit; /* parameters between which hits count; the limit closes in on the best hit */
    mt_ray_hit best;
} mt_ray_search;

/* False when the ray hits nothing at all. */
bool mt_ray_search_init(const mt_packed_triangles *triangles, const mt_ray *ray, mt_ray_profile profile, bool any,
                        mt_ray_search *search);

/* Whether the ray's hits lie as near as MT_RAY_NEARNESS says. False for rays that begin far out and look back, which
 * are asked of every triangle. */
static inline bool mt_ray_search_is_near(const mt_ray_search *search)
{
    return search->setup.slack <= MT_RAY_NEAR_SLACK;
}

/* Where the ray is amid the triangles: parameters of the box of all, widened by how near its hits are. False when it
 * passes by. The slabs of Kay and Kajiya by the IEEE rules: a component of 0 gives infinite slabs, or NaN where a plane
 * goes through the origin, which the order of minimum and maximum drops: inside. */
bool mt_ray_search_enter(const mt_ray_search *search, double *enter, double *leave);

/* Asks every triangle. */
void mt_ray_search_try_all(mt_ray_search *search);

/* Asks the hit function of one triangle. Returns true when the search is over. */
bool mt_ray_search_decide(mt_ray_search *search, mt_index at);

/* Whether the ray may hit the triangle, by the edge functions of its sheared corners. For MT_RAY_WATERTIGHT their signs
 * are those of the hit function, or zero; for MT_RAY_EXACT a margin, a multiple of the slack, allows for what rounding
 * took from vertices, origin and shear. */
static inline bool mt_ray_search_may_hit(const mt_ray_search *search, const mt_packed_triangle *triangle)
{
    const mt_ray_setup *setup = &search->setup;
    if (setup->profile == MT_RAY_FAST) {
        return true;
    }
    float4 x, y, z;
    memcpy(&x, triangle->rows[setup->axes[0]], sizeof x);
    memcpy(&y, triangle->rows[setup->axes[1]], sizeof y);
    memcpy(&z, triangle->rows[setup->axes[2]], sizeof z);
    z -= setup->float_origin[2];
    x = MT_RAY_SHEAR(x - setup->float_origin[0], z, setup->float_shear[0]);
    y = MT_RAY_SHEAR(y - setup->float_origin[1], z, setup->float_shear[1]);
    const float4 next_x = {x[1], x[2], x[3], x[1]}, next_y = {y[1], y[2], y[3], y[1]};
    float4 edges = MT_RAY_EDGE(x, y, next_x, next_y);
    float margin = 0;
    if (setup->profile == MT_RAY_EXACT) {
        float size = fabsf(x[0]) + fabsf(x[1]) + fabsf(x[2]) + fabsf(y[0]) + fabsf(y[1]) + fabsf(y[2]);
        margin = setup->slack * (size + setup->slack) * 2;
    }
    const float4 margins = {margin, margin, margin, margin};
    return int4_lanes(edges >= -margins) == 15 || int4_lanes(edges <= margins) == 15;
}

/* Returns true when the search is over. */
static inline bool mt_ray_search_try(mt_ray_search *search, mt_index at)
{
    return mt_ray_search_may_hit(search, &search->triangles->items[at]) && mt_ray_search_decide(search, at);
}

#endif
