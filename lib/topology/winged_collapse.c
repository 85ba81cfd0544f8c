/* Collapsing an edge of the winged-edge structure. A triangle beside the edge leaves its side at the head, which takes
 * the place of the side at the tail in the face beyond. The invariant: after it every invariant of the structure holds
 * among what is not deleted. Cost: O(valences). */
#include "lib/topology/winged_edit.h"

/* One side of the edge. Of a triangle there `lost`, which lies in the face beyond its side at the tail, gives its place
 * to `kept`; MT_NONE where there is none. */
typedef struct flank {
    mt_index side, previous, next, face;
    mt_index kept, lost, lost_previous, lost_next, lost_face;
} flank;

static flank find_flank(const mt_surgery_view *view, mt_index side, bool from_tail)
{
    const mt_winged_edge_mesh *own = view->structure;
    flank at = {.side = side,
                .previous = winged_side_previous(own, side),
                .next = winged_side_next(own, side),
                .face = winged_side_face(own, side),
                .kept = MT_NONE,
                .lost = MT_NONE};
    if (surgery_in_triangle(view, side)) {
        at.kept = from_tail ? at.next : at.previous;
        at.lost = (from_tail ? at.previous : at.next) ^ 1u;
        at.lost_previous = winged_side_previous(own, at.lost);
        at.lost_next = winged_side_next(own, at.lost);
        at.lost_face = winged_side_face(own, at.lost);
    }
    return at;
}

/* What stands where the side stood, once both triangles are gone. */
static mt_index substitute(const flank flanks[2], mt_index side)
{
    return side == flanks[0].lost ? flanks[0].kept : side == flanks[1].lost ? flanks[1].kept : side;
}

static void replace_face_edge(mt_winged_edge_mesh *own, mt_index face, mt_index old, mt_index new)
{
    if (face != MT_NONE && own->face_edge[face] == old >> 1) {
        own->face_edge[face] = new >> 1;
    }
}

/* Triangles come first: at a tail of two edges the face beyond one is the other face beside the edge, which then closes
 * the gap anew. */
static void close_triangle(mt_winged_surgery *surgery, const flank flanks[2], const flank *at)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    if (at->kept != MT_NONE) {
        winged_side_link(own, substitute(flanks, at->lost_previous), at->kept);
        winged_side_link(own, at->kept, substitute(flanks, at->lost_next));
        winged_side_set_face(own, at->kept, at->lost_face);
        replace_face_edge(own, at->lost_face, at->lost, at->kept);
        own->face_edge[at->face] = MT_NONE;
    }
}

static void close_polygon(mt_winged_surgery *surgery, const flank flanks[2], const flank *at)
{
    if (at->kept == MT_NONE) {
        mt_index next = substitute(flanks, at->next);
        winged_side_link(&surgery->structure, substitute(flanks, at->previous), next);
        replace_face_edge(&surgery->structure, at->face, at->side, next);
    }
}

/* The edge of `begin` itself goes, and keeps its ends until then: by them the walk finds its way back. */
static void move_ring(mt_winged_edge_mesh *own, mt_index begin, mt_index vertex)
{
    mt_index side = winged_side_clockwise(own, begin);
    while (side != begin) {
        mt_index following = winged_side_clockwise(own, side);
        winged_side_set_tail(own, side ^ 1u, vertex);
        side = following;
    }
}

mt_status mt_winged_collapse_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge, mt_index tail,
                                  double weight)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_index side = mt_winged_side_from(surgery, edge, tail), twin = side ^ 1u;
    mt_surgery_view view = mt_winged_view(surgery);
    mt_status status = mt_surgery_enter_collapse(context, &view, &surgery->log, side, weight);
    if (status != MT_OK) {
        return status;
    }
    const flank flanks[2] = {find_flank(&view, side, true), find_flank(&view, twin, false)};
    move_ring(own, twin, winged_side_head(own, side));
    for (int i = 0; i < 2; i++) {
        close_triangle(surgery, flanks, &flanks[i]);
    }
    for (int i = 0; i < 2; i++) {
        close_polygon(surgery, flanks, &flanks[i]);
        if (flanks[i].lost != MT_NONE) {
            mt_winged_delete_edge(surgery, flanks[i].lost >> 1);
        }
    }
    mt_winged_delete_edge(surgery, edge);
    own->vertex_edge[tail] = MT_NONE;
    surgery->vertex_deleted[tail] = 1;
    mt_winged_anchor(own, flanks[1].kept != MT_NONE ? flanks[1].kept : flanks[1].previous);
    for (int i = 0; i < 2; i++) {
        if (flanks[i].kept != MT_NONE) {
            mt_winged_anchor(own, flanks[i].kept ^ (i == 1));
        }
    }
    return MT_OK;
}
