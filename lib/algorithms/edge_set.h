/* A set of edges, by their two vertices in either order. */
#ifndef MT_ALGORITHMS_EDGE_SET_H
#define MT_ALGORITHMS_EDGE_SET_H

#include <meshtool/context.h>

/* All zeros is an empty set. Open addressing; at most half full. */
typedef struct edge_set {
    uint64_t count, capacity;
    uint64_t *keys; /* UINT64_MAX: free */
} edge_set;

mt_status mt_edge_set_add(mt_context *context, edge_set *set, mt_index a, mt_index b);
bool mt_edge_set_has(const edge_set *set, mt_index a, mt_index b);
void mt_edge_set_release(mt_context *context, edge_set *set);

#endif
