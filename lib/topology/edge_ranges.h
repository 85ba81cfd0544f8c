/* Pairing in parallel and in cache, by ranges of vertices. */
#ifndef MT_TOPOLOGY_EDGE_RANGES_H
#define MT_TOPOLOGY_EDGE_RANGES_H

#include "lib/topology/edge_tally.h"

/* Fills pairs->next_side and counts the edges. */
mt_status mt_edge_ranges_pair(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally);

#endif
