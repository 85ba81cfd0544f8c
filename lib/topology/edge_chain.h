/* Pairing by chains: each edge met so far hangs in a list at its lower vertex, and a side looks for its edge there.
 * Sides must come in the order of their corners: then the rings of next_side ascend by themselves. */
#ifndef MT_TOPOLOGY_EDGE_CHAIN_H
#define MT_TOPOLOGY_EDGE_CHAIN_H

#include <meshtool/edge_pairs.h>

typedef struct chain_entry {
    mt_index other; /* the higher vertex */
    mt_index link;  /* the next edge of the lower vertex, MT_NONE at the end */
    mt_index last;  /* its last side so far; next_side leads from there to the first */
} chain_entry;

typedef struct edge_chains {
    mt_index *heads; /* per lower vertex its newest edge, MT_NONE: none */
    chain_entry *entries;
    mt_index entry_count;
    mt_index *next_side;
    const mt_index *corner_vertices;
    uint64_t steps; /* along the lists so far */
    mt_index regular, misoriented, non_manifold;
} edge_chains;

/* Steps that a well-behaved mesh stays below: past them a few vertices have very many edges, and sorting is due. */
static inline uint64_t edge_chain_step_limit(uint64_t side_count)
{
    return 16 * side_count + 4096;
}

/* Adds the side of a corner, from `tail`, of the edge between two different vertices. Always inline, so that a local
 * edge_chains stays in registers. */
static inline __attribute__((always_inline)) void edge_chain_add(edge_chains *chains, mt_index lower, mt_index other,
                                                                 mt_index tail, mt_index corner)
{
    mt_index *next_side = chains->next_side;
    mt_index at = chains->heads[lower];
    while (at != MT_NONE && chains->entries[at].other != other) {
        at = chains->entries[at].link;
        chains->steps++;
    }
    if (at == MT_NONE) {
        chain_entry entry = {other, chains->heads[lower], corner};
        chains->heads[lower] = chains->entry_count;
        chains->entries[chains->entry_count++] = entry;
        next_side[corner] = corner;
        return;
    }
    mt_index last = chains->entries[at].last;
    mt_index first = next_side[last];
    mt_index same = chains->corner_vertices[first] == tail;
    if (first == last) {
        chains->misoriented += same;
        chains->regular += 1 - same;
    } else if (next_side[first] == last) {
        mt_index was_same = chains->corner_vertices[first] == chains->corner_vertices[last];
        chains->misoriented -= was_same;
        chains->regular -= 1 - was_same;
        chains->non_manifold++;
    }
    next_side[last] = corner;
    next_side[corner] = first;
    chains->entries[at].last = corner;
}

#endif
