/* The sides that share one lower vertex, and how they are linked into edges. */
#ifndef MT_TOPOLOGY_EDGE_BUCKET_H
#define MT_TOPOLOGY_EDGE_BUCKET_H

#include "lib/topology/edge_tally.h"

/* One side: the vertex at its other end, and its corner. */
typedef struct edge_side {
    mt_index other;
    mt_index corner;
} edge_side;

/* Links `count` sides of one lower vertex, given as those that leave it (the first `up_count`, corners
 * ascending) and those that reach it (the rest, corners ascending). `sides` is reordered; `scratch` has room for
 * as many. O(count), however many there are. */
void mt_edge_bucket_link(edge_side *sides, mt_index up_count, mt_index count, edge_side *scratch, mt_index *next_side,
                         edge_tally *tally);

#endif
