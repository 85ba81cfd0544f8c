/* Chains: each edge met so far hangs in a list at its higher vertex, and a side looks for its edge there. In a mesh
 * that was refined before, old vertices have many new neighbours, from faces far apart in memory, and new ones few old.
 */
#ifndef MT_TOPOLOGY_EDGE_CHAIN_H
#define MT_TOPOLOGY_EDGE_CHAIN_H

#include "lib/topology/inline.h"

#include <meshtool/mesh.h>

typedef struct chain_entry {
    mt_index other; /* the lower vertex */
    mt_index link;  /* the next edge of the higher vertex, MT_NONE at the end */
    mt_index note;  /* the caller's */
} chain_entry;

typedef struct edge_chains {
    mt_index *heads; /* per higher vertex its newest edge, MT_NONE: none */
    chain_entry *entries;
    mt_index entry_count;
    uint64_t steps; /* along the lists so far */
} edge_chains;

/* Room for the edges of a mesh with little boundary. */
static inline uint64_t edge_chain_room(const mt_mesh *mesh)
{
    return (uint64_t)mesh->corner_count / 2 + mesh->corner_count / 64 + 16;
}

/* Allocates lists for the vertices and room for edges; on failure too, release. */
mt_status mt_edge_chains_init(mt_context *context, mt_index vertex_count, mt_index edge_room, edge_chains *chains);
void mt_edge_chains_release(mt_context *context, edge_chains *chains);

/* Whether faces that follow each other mostly name the same vertices and their neighbours: then the lists that a face
 * needs are in cache, and chains are faster than sorting. */
bool mt_edge_chains_suit(const mt_mesh *mesh);

/* Steps that a well-behaved mesh stays below: past them a few vertices have very many edges, and sorting is due. */
static inline uint64_t edge_chain_step_limit(uint64_t side_count)
{
    return 16 * side_count + 4096;
}

/* The number of the edge between two different vertices, made if need be: then it is the count before. Edges are thus
 * numbered in the order of their first sides. Always inline, so that a local edge_chains stays in registers. */
MT_ALWAYS_INLINE mt_index edge_chain_find(edge_chains *chains, mt_index lower, mt_index higher)
{
    mt_index at = chains->heads[higher];
    while (at != MT_NONE && chains->entries[at].other != lower) {
        at = chains->entries[at].link;
        chains->steps++;
    }
    if (at == MT_NONE) {
        at = chains->entry_count++;
        chains->entries[at].other = lower;
        chains->entries[at].link = chains->heads[higher];
        chains->heads[higher] = at;
    }
    return at;
}

#endif
