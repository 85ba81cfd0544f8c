/* What the operations on half-edges share. */
#ifndef MT_TOPOLOGY_HALFEDGE_EDIT_H
#define MT_TOPOLOGY_HALFEDGE_EDIT_H

#include <meshtool/halfedge_surgery.h>

/* Fails unless the verdict is MT_SURGERY_ALLOWED, else makes room for the new elements and for `edits` in the log. */
mt_status mt_halfedge_prepare(mt_context *context, mt_halfedge_surgery *surgery, mt_surgery_verdict verdict,
                              mt_index vertices, mt_index edges, mt_index faces, uint64_t edits);

/* New elements, in room that was made. The edge's first half-edge runs from tail to head; it has no face yet. */
mt_index mt_halfedge_new_vertex(mt_halfedge_surgery *surgery);
mt_index mt_halfedge_new_edge(mt_halfedge_surgery *surgery, mt_index tail, mt_index head);
mt_index mt_halfedge_new_face(mt_halfedge_surgery *surgery, mt_index halfedge);
void mt_halfedge_delete_edge(mt_halfedge_surgery *surgery, mt_index halfedge);

static inline bool mt_halfedge_is_alive(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    return halfedge < surgery->structure.halfedge_count && surgery->structure.halfedges[halfedge].head != MT_NONE;
}

static inline bool mt_halfedge_in_triangle(const mt_halfedge_mesh *structure, mt_index h)
{
    return mt_halfedge_next(structure, mt_halfedge_next(structure, mt_halfedge_next(structure, h))) == h;
}

/* The half-edge between two vertices that points to `head`, or MT_NONE. */
mt_index mt_halfedge_find(const mt_halfedge_mesh *structure, mt_index tail, mt_index head);

/* Gives the vertex the boundary half-edge around it, or this one. */
void mt_halfedge_anchor(mt_halfedge_mesh *structure, mt_index halfedge);

/* The target's corner takes the value of the parent's, or of one beside it where the parent has no face. */
void mt_halfedge_copy_corner(mt_halfedge_surgery *surgery, mt_index target, mt_index parent);

#endif
