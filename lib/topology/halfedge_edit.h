/* What the operations on half-edges share. */
#ifndef MT_TOPOLOGY_HALFEDGE_EDIT_H
#define MT_TOPOLOGY_HALFEDGE_EDIT_H

#include "lib/topology/surgery_view.h"

#include <meshtool/halfedge_surgery.h>

/* What the predicates read, and the log's entries are made of; it holds until the surgery grows. */
mt_surgery_view mt_halfedge_view(const mt_halfedge_surgery *surgery);

/* Makes room for new elements. */
mt_status mt_halfedge_reserve(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertices, mt_index edges,
                              mt_index faces);

/* New elements, in room that was made. The edge's first half-edge runs from tail to head; it has no face yet. */
mt_index mt_halfedge_new_vertex(mt_halfedge_surgery *surgery);
mt_index mt_halfedge_new_edge(mt_halfedge_surgery *surgery, mt_index tail, mt_index head);
mt_index mt_halfedge_new_face(mt_halfedge_surgery *surgery, mt_index halfedge);
void mt_halfedge_delete_edge(mt_halfedge_surgery *surgery, mt_index halfedge);

static inline bool mt_halfedge_is_alive(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    return halfedge < surgery->structure.halfedge_count && surgery->structure.halfedges[halfedge].head != MT_NONE;
}

/* Whether there is a face, and it is a triangle. */
static inline bool mt_halfedge_in_triangle(const mt_halfedge_mesh *structure, mt_index h)
{
    return !mt_halfedge_is_boundary(structure, h) &&
           mt_halfedge_next(structure, mt_halfedge_next(structure, mt_halfedge_next(structure, h))) == h;
}

/* Links three half-edges to a face that begins with the first. */
void mt_halfedge_set_triangle(mt_halfedge_mesh *structure, mt_index face, mt_index a, mt_index b, mt_index c);

/* Gives the vertex the boundary half-edge around it, or this one. */
void mt_halfedge_anchor(mt_halfedge_mesh *structure, mt_index halfedge);

#endif
