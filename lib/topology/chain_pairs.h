/* Pairing by one pass of chains over the faces. */
#ifndef MT_TOPOLOGY_CHAIN_PAIRS_H
#define MT_TOPOLOGY_CHAIN_PAIRS_H

#include "lib/topology/edge_tally.h"

/* Fills pairs->next_side and counts the edges and the sides a = b. *done is false, and the result of no use, when the
 * chains grew long. */
mt_status mt_chain_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally, bool *done);

#endif
