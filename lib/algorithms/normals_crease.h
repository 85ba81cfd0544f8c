/* The corners around one vertex: their fans, the creases between them, and the normal of each. */
#ifndef MT_ALGORITHMS_NORMALS_CREASE_H
#define MT_ALGORITHMS_NORMALS_CREASE_H

#include "lib/algorithms/normals_ring.h"

typedef struct mt_crease_corner {
    mt_scaled_vector term; /* what it adds */
    mt_vec3 unit;          /* of its face */
    mt_index corner, face;
    mt_index fan; /* the first corner around the vertex that it hangs together with; while joining, one nearer to it */
    mt_index patch;           /* the same without crossing creases */
    mt_scaled_vector fan_sum; /* of the first corner of a fan: what all its corners add */
    mt_vec3 normal;           /* the answer */
} mt_crease_corner;

/* A number to sort by, and what it stands for. */
typedef struct mt_sort_entry {
    uint64_t key;
    mt_index index;
} mt_sort_entry;

/* A box around the unit normals of some corners, and the sum of their terms. */
typedef struct mt_crease_node {
    mt_vec3 low, high;
    mt_scaled_vector sum;
} mt_crease_node;

/* Room for a vertex of as many corners as any of some has. */
typedef struct mt_crease_star {
    mt_crease_corner *corners;
    mt_sort_entry *entries, *spare; /* 2 a corner */
    mt_crease_node *nodes;          /* NULL: for no vertex of more than MT_CREASE_PAIRS_MAXIMUM corners */
    mt_index count;
    double limit; /* the cosine that must be exceeded */
    bool reachable_only;
} mt_crease_star;

/* Corners that are compared each with each; with more, faces of like normals are taken together. */
#define MT_CREASE_PAIRS_MAXIMUM 64

/* False when memory is missing. May be called inside a parallel body. */
bool mt_crease_star_init(mt_context *context, mt_index most, mt_crease_star *star);
void mt_crease_star_release(mt_context *context, mt_crease_star *star);

/* Finds the normal of each corner at a vertex. */
void mt_crease_star_solve(mt_crease_star *star, const mt_normal_rings *rings, mt_index vertex);

/* Sums by a tree of the corners' unit normals, for the `count` corners that entries name by index; they are re-ordered.
 * O(n log n) where the normals lie along curves. */
void mt_crease_sum_many(mt_crease_star *star, mt_sort_entry *entries, mt_index count);

/* Sorts by key, equal ones in their order. */
void mt_sort_entries(mt_sort_entry *entries, mt_sort_entry *spare, mt_index count);

#endif
