/* The rings of a mesh's vertices, gathered from its topology. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_LIMIT_RINGS_H
#define LIB_ALGORITHMS_SUBDIVIDE_LIMIT_RINGS_H

#include "lib/algorithms/subdivide_limit_ring.h"
#include "lib/algorithms/subdivide_sharp.h"

/* Rings of up to this many faces fit on a stack. */
#define MT_LIMIT_SMALL_RING 16

typedef struct mt_limit_rings {
    const mt_subdivide_topology *topology; /* of quads, of triangles for Loop's scheme; a corner for each vertex */
    const mt_mesh *mesh;
    const mt_subdivide_sharp *sharp;
    const float *halves;      /* per spoke number its half's sharpness at the next level */
    mt_index irregular_count; /* only so many first vertices may have other than four faces */

    mt_index *edge_slots; /* per edge its number among the sharp ones; NULL when there are none */
    mt_index large_count;
    mt_index *large;          /* vertices of rings that are not small */
    mt_limit_sharp_ring ring; /* with room for the largest */
    mt_index *corners;        /* per face of that ring the vertex's corner in it */
    mt_index *starts;         /* and its sharp spokes, those of a boundary among them */
} mt_limit_rings;

/* Allocates what comes after irregular_count; all before that, which is borrowed, must be set. */
mt_status mt_limit_rings_create(mt_context *context, mt_limit_rings *rings);
void mt_limit_rings_release(mt_context *context, mt_limit_rings *rings);

/* The ring of a vertex that has faces, into the given memory; false when it has more than `room` of them. corners may
 * be NULL, else receives the vertex's corner in each face. O(faces). */
bool mt_limit_ring_gather(const mt_limit_rings *rings, mt_index vertex, mt_index room, mt_limit_ring *ring,
                          mt_index *corners);

/* The ring of sharp vertex `number` into rings->ring and rings->corners. */
void mt_limit_rings_gather_sharp(mt_limit_rings *rings, mt_index number);

/* After mt_limit_refine: lists the sharp spokes of rings->ring in rings->starts and returns the count of its sectors,
 * at least 1. */
mt_index mt_limit_rings_part(mt_limit_rings *rings);
mt_limit_sector mt_limit_rings_sector(const mt_limit_rings *rings, mt_index number, mt_index sector_count);

/* Sectors that infinitely sharp edges part beyond the first of each vertex. */
mt_index mt_limit_rings_extra_sectors(const mt_limit_rings *rings);

#endif
