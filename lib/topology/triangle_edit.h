/* What the operations on triangle neighbours share. */
#ifndef MT_TOPOLOGY_TRIANGLE_EDIT_H
#define MT_TOPOLOGY_TRIANGLE_EDIT_H

#include "lib/topology/surgery_view.h"
#include "lib/topology/triangle_side.h"

#include <meshtool/triangle_neighbor_surgery.h>

/* What the predicates read; it holds until the surgery grows. */
mt_surgery_view mt_triangle_view(const mt_triangle_surgery *surgery);

/* The side, as a half-edge, that runs from the vertex `tail` along the edge of the corner; when there is none a number
 * that is out of range. */
mt_index mt_triangle_side_from(const mt_triangle_surgery *surgery, mt_index corner, mt_index tail);

/* Makes room for new elements. */
mt_status mt_triangle_reserve(mt_context *context, mt_triangle_surgery *surgery, mt_index vertices, mt_index triangles);

/* New elements, in room that was made. The triangle, whose first corner is returned, has no neighbours yet. */
mt_index mt_triangle_new_vertex(mt_triangle_surgery *surgery);
mt_index mt_triangle_new(mt_triangle_surgery *surgery, mt_index a, mt_index b, mt_index c);
void mt_triangle_delete(mt_triangle_surgery *surgery, mt_index triangle);

/* Two sides, each of which may be MT_NONE, become neighbours. */
static inline void triangle_pair(mt_triangle_neighbor_mesh *own, mt_index side, mt_index other)
{
    if (side != MT_NONE) {
        own->neighbors[side] = other;
    }
    if (other != MT_NONE) {
        own->neighbors[other] = side;
    }
}

/* Gives the corner's vertex the corner where its ring begins, this one when it has no boundary. O(valence). */
void mt_triangle_anchor(mt_triangle_neighbor_mesh *own, mt_index corner);

#endif
