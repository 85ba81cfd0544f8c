/* Counts of edges by class. */
#ifndef MT_TOPOLOGY_EDGE_TALLY_H
#define MT_TOPOLOGY_EDGE_TALLY_H

#include <meshtool/edge_pairs.h>

typedef struct edge_tally {
    mt_index boundary, regular, misoriented, non_manifold;
} edge_tally;

static inline void edge_tally_add(edge_tally *sum, const edge_tally *part)
{
    sum->boundary += part->boundary;
    sum->regular += part->regular;
    sum->misoriented += part->misoriented;
    sum->non_manifold += part->non_manifold;
}

#endif
