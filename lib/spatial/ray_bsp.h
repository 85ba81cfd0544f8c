/* The axis-aligned BSP tree's own record, and the steps of making it. */
#ifndef MT_SPATIAL_RAY_BSP_H
#define MT_SPATIAL_RAY_BSP_H

#include "lib/spatial/packed_triangles.h"
#include "lib/spatial/surface_tree.h"

/* Levels at most: 8 + 1.3 log2(n) for n below 2^28. */
#define MT_RAY_BSP_DEPTH 48

#define MT_RAY_BSP_LEAF 3u

/* A plane across an axis and the first of its two children, which stand side by side: what is below, what is above. Or
 * a leaf with its first entry and their number. */
typedef struct mt_ray_bsp_node {
    union {
        float plane;
        uint32_t first;
    };
    uint32_t word; /* axis or MT_RAY_BSP_LEAF in two bits; above them the child or the number */
} mt_ray_bsp_node;

static inline unsigned mt_ray_bsp_axis(const mt_ray_bsp_node *node)
{
    return node->word & 3;
}

/* The child below the plane, or a leaf's number of entries. */
static inline uint32_t mt_ray_bsp_number(const mt_ray_bsp_node *node)
{
    return node->word >> 2;
}

typedef struct mt_ray_bsp {
    mt_packed_triangles triangles;
    mt_ray_bsp_node *nodes; /* the first is the root */
    mt_index *entries;      /* places of triangles, rising within a leaf */
    uint64_t node_count, entry_count;
} mt_ray_bsp;

/* A cell that is being made: its box, and the triangles that come within MT_RAY_NEARNESS of it. */
typedef struct mt_ray_bsp_cell {
    float lower[3], upper[3];
    mt_index count;
    unsigned depth;
    uint64_t duplicates; /* how many more entries it may make of these */
} mt_ray_bsp_cell;

/* A plane that is thought to pay; axis MT_RAY_BSP_LEAF: none is. */
typedef struct mt_ray_bsp_plane {
    unsigned axis;
    float at;
} mt_ray_bsp_plane;

/* By the surface-area heuristic over bins; `pieces` are the boxes of the triangles' parts within the cell. */
mt_ray_bsp_plane mt_ray_bsp_choose(const mt_ray_bsp_cell *cell, const mt_surface_box *pieces);

/* Deals the pieces of a cell to its halves, keeping their order: those below are written over the pieces, those above
 * to `above`, which has room for as many. What reaches over the plane by less than MT_RAY_NEARNESS is on both sides,
 * and so are faces in the plane. Sets the box, depth and count of the halves. */
void mt_ray_bsp_deal(const mt_packed_triangles *triangles, const mt_ray_bsp_cell *cell, mt_ray_bsp_plane plane,
                     mt_surface_box *pieces, mt_surface_box *above, mt_ray_bsp_cell halves[2]);

/* Fills in nodes and entries. */
mt_status mt_ray_bsp_build(mt_context *context, mt_ray_bsp *bsp);

bool mt_ray_bsp_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit);

#endif
