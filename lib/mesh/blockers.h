/* The corners that can lie inside an ear: those where the polygon does not turn left, and those that share their place
 * with another. They stand in a tree of boxes over their Z-order, from which they are taken as they vanish. */
#ifndef MT_MESH_BLOCKERS_H
#define MT_MESH_BLOCKERS_H

#include "lib/mesh/polygon.h"

typedef struct mt_box2 {
    double minimum[2], maximum[2]; /* minimum > maximum: empty */
} mt_box2;

typedef struct mt_blockers {
    mt_point2 *points;
    const mt_index *previous, *next; /* the ring of the corners still there */
    mt_index count;                  /* blockers still there */
    mt_index slot_count;
    mt_index leaf_count; /* a power of two */
    mt_index *slots;     /* corners in Z-order, MT_NONE where taken */
    mt_index *slot_of;   /* per corner its slot, MT_NONE: blocks nothing */
    bool *has_twin;      /* per corner whether another one has its place */
    mt_box2 *boxes;      /* 2 * leaf_count, of node i the children are 2i and 2i + 1 */
} mt_blockers;

/* The memory that a build works in, and that the blockers keep. */
typedef struct mt_blocker_memory {
    mt_box2 *boxes;    /* mt_blocker_box_count(count) */
    uint64_t *keys;    /* count */
    mt_index *slots;   /* count */
    mt_index *slot_of; /* count */
    mt_index *scratch; /* count */
    bool *has_twin;    /* count */
} mt_blocker_memory;
size_t mt_blocker_box_count(mt_index count);

/* Gathers the corners with turns[i] <= 0 and those whose place occurs twice. */
void mt_blockers_build(mt_blockers *blockers, mt_point2 *points, mt_index count, const int8_t *turns,
                       const mt_blocker_memory *memory);

/* Takes a corner away, if it is there. */
void mt_blockers_remove(mt_blockers *blockers, mt_index corner);

/* Whether a blocker forbids cutting off corner `tip` between its neighbours. strict: one that lies on the cut
 * between two other corners does. */
bool mt_blockers_forbid(const mt_blockers *blockers, mt_index tip, bool strict);

#endif
