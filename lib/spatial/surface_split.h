/* Cutting a range of boxes in two where rays expect the least work. */
#ifndef MT_SPATIAL_SURFACE_SPLIT_H
#define MT_SPATIAL_SURFACE_SPLIT_H

#include "lib/spatial/box.h"
#include "lib/spatial/surface_tree.h"

#define MT_SPLIT_BINS 16
#define MT_SPLIT_BLOCKS 64

typedef struct mt_surface_range {
    mt_index begin, end;
    box bounds;  /* of its boxes */
    box centers; /* of their doubled centroids: the sum needs no division, and orders the same */
} mt_surface_range;

typedef struct mt_split_bins {
    box bounds[3][MT_SPLIT_BINS];
    mt_index counts[3][MT_SPLIT_BINS];
} mt_split_bins;

/* What lies left of a plane, and right of it: all centroids, and all boxes. */
typedef struct mt_split_sides {
    box centers[2], bounds[2];
} mt_split_sides;

/* What each block of a range found, or will do. */
typedef struct mt_split_block {
    mt_split_bins bins;
    mt_split_sides sides;
    mt_index left_count, left, right; /* where its boxes go */
} mt_split_block;

typedef struct mt_split_work {
    mt_build_quality quality;
    mt_context *context; /* NULL: no parallel loops, as inside one */
    mt_surface_box *boxes, *scratch;
    mt_split_block *blocks; /* MT_SPLIT_BLOCKS of them, when there is a context */
} mt_split_work;

/* The whole of the boxes as a range. */
mt_surface_range mt_surface_range_of(const mt_split_work *work, mt_index begin, mt_index end);

/* Orders the boxes of a range of two and more into two parts, neither empty. halve: in the middle of its order. */
void mt_surface_split(const mt_split_work *work, const mt_surface_range *range, bool halve, mt_surface_range parts[2]);

static inline float mt_surface_half_area(const box *b)
{
    float4 side = b->upper - b->lower;
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

#endif
