/* Whether the corners of each vertex form one ring or fan. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_RINGS_H
#define LIB_ALGORITHMS_SUBDIVIDE_RINGS_H

#include "lib/algorithms/subdivide_topology.h"

/* Counts the corners that walks around the vertices of level 0 reach: all of them when no vertex has several fans. */
mt_status mt_subdivide_count_ring_corners(mt_context *context, const mt_subdivide_topology *topology, mt_index *count);

#endif
