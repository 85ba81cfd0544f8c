/* The hierarchy of oriented boxes' own record, and the steps of making it. */
#ifndef MT_SPATIAL_RAY_OBB_H
#define MT_SPATIAL_RAY_OBB_H

#include "lib/spatial/packed_triangles.h"

#define MT_RAY_OBB_LEAF_SIZE 4

/* Levels at most: from the halving depth on ranges are halved, and 2^28 triangles need 27 more. */
#define MT_RAY_OBB_DEPTH 64
#define MT_RAY_OBB_HALVING_DEPTH 36

/* What lies between lower and upper along each of three axes. The axes are floats as they stand, of about length 1 and
 * at about right angles; nothing relies on it. Lane k belongs to axis k, the fourth is 0. */
typedef struct mt_oriented_box {
    float columns[3][4]; /* the axes' x, y, z */
    float lower[4], upper[4];
} mt_oriented_box;

typedef struct mt_ray_obb_node {
    mt_oriented_box box;
    uint32_t first; /* of two children, which stand side by side; of a leaf its first triangle's place */
    uint32_t count; /* a leaf's triangles; 0: no leaf */
} mt_ray_obb_node;

typedef struct mt_ray_obb {
    mt_packed_triangles triangles; /* leaf by leaf */
    mt_ray_obb_node *nodes;        /* the first is the root */
    uint64_t node_count;
} mt_ray_obb;

/* A range of triangles, by their places. */
typedef struct mt_ray_obb_range {
    mt_index begin, end;
} mt_ray_obb_range;

/* Where the corners of a triangle lie along an axis of a box, in double: floats' products are exact there. */
static inline double mt_oriented_box_along(const mt_oriented_box *frame, int axis, const mt_packed_triangle *triangle,
                                           int corner)
{
    return (double)frame->columns[0][axis] * (double)triangle->rows[0][corner] +
           (double)frame->columns[1][axis] * (double)triangle->rows[1][corner] +
           (double)frame->columns[2][axis] * (double)triangle->rows[2][corner];
}

/* The box of a range along its principal axes, or along x, y and z where that is the smaller one. */
mt_oriented_box mt_ray_obb_fit(const mt_packed_triangles *triangles, mt_ray_obb_range range);

/* Reorders a range of two and more into two, neither empty, along an axis of its box; halve: in the middle of its
 * order. Returns where the second begins. */
mt_index mt_ray_obb_split(mt_packed_triangles *triangles, mt_ray_obb_range range, const mt_oriented_box *frame,
                          bool halve);

/* Fills in the nodes, and puts the triangles in order. */
mt_status mt_ray_obb_build(mt_context *context, mt_ray_obb *obb);

bool mt_ray_obb_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit);

#endif
