/* Giving each fan of corners a vertex of its own. */
#ifndef MT_TOPOLOGY_SPLIT_FANS_H
#define MT_TOPOLOGY_SPLIT_FANS_H

#include <meshtool/edge_pairs.h>

typedef struct fan_splitting {
    mt_mesh mesh;               /* faces and vertices as far as they are split; corner_vertices and the count change */
    const uint8_t *misoriented; /* per corner, whether its edge is to stay one although its sides agree in direction */
    mt_index vertex_room;       /* an old vertex and a corner: each new vertex has a corner of its own */
    mt_index *corner_face;      /* NULL when all faces have the same size */
    mt_index *sources;          /* per vertex the one that it is a copy of */
    mt_index *vertex_run;       /* scratch, a vertex */
    mt_index *face_run;         /* scratch, a face */
    uint8_t *corner_done;       /* scratch, a corner */
    uint8_t *vertex_seen;       /* scratch, a vertex */
    mt_index run_count;
} fan_splitting;

/* Walks the fans: corners joined across the sides that `pairs` (of splitting->mesh as it is) pairs well. Of a vertex's
 * fans all but the first get a new vertex. With `cut`, a fan is cut too before a corner that would bring a neighbour or
 * a face for the second time, so that no edge keeps a third side and no face names a vertex twice. O(vertices +
 * corners). */
void mt_split_fans(fan_splitting *splitting, const mt_edge_pairs *pairs, bool cut);

#endif
