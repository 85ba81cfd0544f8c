/* Collapsing a half-edge. The invariant: after it every invariant of the half-edge structure holds among what is not
 * deleted. Cost: O(valences + sides of the faces at the tail). */
#include "lib/topology/halfedge_edit.h"

/* `kept` takes the place of `lost` in its face; `previous` came before it. */
static void take_place(mt_halfedge_mesh *own, mt_index kept, mt_index lost, mt_index previous)
{
    mt_index face = own->halfedges[lost].face;
    own->halfedges[kept].next = own->halfedges[lost].next;
    own->halfedges[kept].face = face;
    own->halfedges[previous].next = kept;
    if (face != MT_NONE && own->face_halfedge[face] == lost) {
        own->face_halfedge[face] = kept;
    }
}

/* One side of the edge. Of a triangle the side at the tail goes, whose twin is `lost`; `kept` is its side at the head.
 * `previous` comes before `lost`, and where there is no triangle before the edge's side. */
typedef struct flank {
    mt_index side, kept, lost, previous;
} flank;

static flank find_flank(const mt_halfedge_mesh *own, mt_index side, bool tail_first)
{
    if (!mt_halfedge_in_triangle(own, side)) {
        return (flank){side, MT_NONE, MT_NONE, mt_halfedge_previous(own, side)};
    }
    mt_index next = mt_halfedge_next(own, side), last = mt_halfedge_next(own, next);
    mt_index kept = tail_first ? next : last, lost = (tail_first ? last : next) ^ 1u;
    return (flank){side, kept, lost, mt_halfedge_previous(own, lost)};
}

static void close_flank(mt_halfedge_surgery *surgery, const flank *at)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index face = own->halfedges[at->side].face;
    if (at->kept != MT_NONE) {
        own->face_halfedge[face] = MT_NONE;
        take_place(own, at->kept, at->lost, at->previous);
        mt_halfedge_delete_edge(surgery, at->lost);
        return;
    }
    own->halfedges[at->previous].next = own->halfedges[at->side].next;
    if (face != MT_NONE && own->face_halfedge[face] == at->side) {
        own->face_halfedge[face] = own->halfedges[at->side].next;
    }
}

/* What came before a side without a triangle may have gone with the triangle on the other one. */
static void anchor_flank(mt_halfedge_surgery *surgery, const flank *at)
{
    if (at->kept != MT_NONE) {
        mt_halfedge_anchor(&surgery->structure, at->kept);
        mt_halfedge_anchor(&surgery->structure, at->kept ^ 1u);
    } else if (mt_halfedge_is_alive(surgery, at->previous)) {
        mt_halfedge_anchor(&surgery->structure, at->previous);
    }
}

mt_status mt_halfedge_collapse_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, double weight)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_surgery_view view = mt_halfedge_view(surgery);
    mt_status status = mt_surgery_enter_collapse(context, &view, &surgery->log, halfedge, weight);
    if (status != MT_OK) {
        return status;
    }
    mt_index twin = halfedge ^ 1u, kept = own->halfedges[halfedge].head, gone = own->halfedges[twin].head;
    flank left = find_flank(own, halfedge, true), right = find_flank(own, twin, false);
    mt_index x = twin;
    do {
        mt_index following = mt_halfedge_clockwise(own, x);
        own->halfedges[x].head = kept;
        x = following;
    } while (x != twin);
    close_flank(surgery, &left);
    close_flank(surgery, &right);
    mt_halfedge_delete_edge(surgery, halfedge);
    own->vertex_halfedge[gone] = MT_NONE;
    surgery->vertex_deleted[gone] = 1;
    anchor_flank(surgery, &left);
    anchor_flank(surgery, &right);
    return MT_OK;
}
