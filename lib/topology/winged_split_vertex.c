/* Splitting a vertex of the winged-edge structure: the fan is cut along one or two edges, its parts drawn apart, and
 * the gaps filled with triangles. Each cut edge stays with the old vertex; the new one gets a copy. The invariant:
 * after it every invariant of the structure holds among what is not deleted. Cost: O(valence). */
#include "lib/topology/winged_edit.h"

mt_surgery_verdict mt_winged_can_split_vertex(const mt_winged_surgery *surgery, mt_index vertex, mt_index from,
                                              mt_index to)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_split_vertex(&view, vertex,
                                         from == MT_NONE ? MT_NONE : mt_winged_side_from(surgery, from, vertex) ^ 1u,
                                         to == MT_NONE ? MT_NONE : mt_winged_side_from(surgery, to, vertex) ^ 1u);
}

/* All of the fan that must be known before anything moves. Sides point to the vertex; MT_NONE where the outside takes
 * the place of a cut. */
typedef struct vertex_cut {
    mt_index from, to;
    mt_index before_from, after_from; /* around the face counter-clockwise of `from` */
    mt_index before_to, after_to;     /* around the face clockwise of `to` */
    mt_index from_face, to_face;      /* these faces */
    mt_index outer, outer_next;       /* the sides of the outside at the vertex, of any face when there is none */
} vertex_cut;

static vertex_cut find_cut(const mt_winged_edge_mesh *own, mt_index outer, mt_index from, mt_index to)
{
    vertex_cut cut = {.from = from, .to = to, .outer = outer, .outer_next = winged_side_next(own, outer)};
    if (from != MT_NONE) {
        cut.before_from = winged_side_previous(own, from ^ 1u);
        cut.after_from = winged_side_next(own, from ^ 1u);
        cut.from_face = winged_side_face(own, from ^ 1u);
    }
    if (to != MT_NONE) {
        cut.before_to = winged_side_previous(own, to);
        cut.after_to = winged_side_next(own, to);
        cut.to_face = winged_side_face(own, to);
    }
    return cut;
}

static void move_fan(mt_winged_edge_mesh *own, mt_surgery_fan fan, mt_index vertex)
{
    for (mt_index side = fan.begin; side != fan.end;) {
        mt_index following = winged_side_clockwise(own, side);
        winged_side_set_tail(own, side ^ 1u, vertex);
        side = following;
    }
}

/* The copy runs from the new vertex to the edge's other end, in the place of the twin of `from`. */
static mt_index copy_from(mt_winged_surgery *surgery, const vertex_cut *cut, mt_index added)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_index end = winged_side_tail(own, cut->from), copy = mt_winged_new_edge(surgery, added, end);
    winged_side_link(own, cut->before_from, copy);
    winged_side_link(own, copy, cut->after_from);
    winged_side_set_face(own, copy, cut->from_face);
    if (cut->from_face == MT_NONE) {
        own->vertex_edge[end] = copy >> 1;
    } else if (own->face_edge[cut->from_face] == cut->from >> 1) {
        own->face_edge[cut->from_face] = copy >> 1;
    }
    return copy;
}

/* This one runs to the new vertex, in the place of `to`, and follows or comes before the other copy when no edge passes
 * to the new vertex. */
static mt_index copy_to(mt_winged_surgery *surgery, const vertex_cut *cut, mt_index added, mt_index from_copy)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_index copy = mt_winged_new_edge(surgery, winged_side_tail(own, cut->to), added);
    bool meets = cut->from != MT_NONE && cut->before_from == cut->to;
    winged_side_link(own, cut->before_to, copy);
    winged_side_link(own, copy, meets ? from_copy : cut->after_to);
    winged_side_set_face(own, copy, cut->to_face);
    if (cut->to_face != MT_NONE && own->face_edge[cut->to_face] == cut->to >> 1) {
        own->face_edge[cut->to_face] = copy >> 1;
    }
    return copy;
}

/* The edge from the new vertex to the old one; triangles fill the cuts, the outside is closed elsewhere. */
static void join(mt_winged_surgery *surgery, const vertex_cut *cut, mt_index joint, const mt_index copies[2])
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_index back = joint ^ 1u;
    if (cut->from != MT_NONE) {
        mt_index face = mt_winged_new_face(surgery);
        mt_winged_set_triangle(own, face, cut->from ^ 1u, copies[0] ^ 1u, joint);
    } else {
        winged_side_link(own, cut->to == cut->outer ? copies[1] : cut->outer, joint);
        winged_side_link(own, joint, cut->outer_next);
    }
    if (cut->to != MT_NONE) {
        mt_index face = mt_winged_new_face(surgery);
        mt_winged_set_triangle(own, face, back, copies[1] ^ 1u, cut->to);
    } else {
        winged_side_link(own, cut->outer, back);
        winged_side_link(own, back, (cut->from ^ 1u) == cut->outer_next ? copies[0] : cut->outer_next);
    }
    mt_winged_anchor(own, joint);
    mt_winged_anchor(own, back);
}

mt_status mt_winged_split_vertex(mt_context *context, mt_winged_surgery *surgery, mt_index vertex, mt_index from,
                                 mt_index to, mt_index *out)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_status status = mt_winged_reserve(context, surgery, 1, 3, 2);
    mt_surgery_view view = mt_winged_view(surgery);
    mt_index into[2] = {from == MT_NONE ? MT_NONE : mt_winged_side_from(surgery, from, vertex) ^ 1u,
                        to == MT_NONE ? MT_NONE : mt_winged_side_from(surgery, to, vertex) ^ 1u};
    status = status == MT_OK ? mt_surgery_enter_split_vertex(context, &view, &surgery->log, vertex, into[0], into[1])
                             : status;
    if (status != MT_OK) {
        return status;
    }
    vertex_cut cut = find_cut(own, view.vertex_side(own, vertex), into[0], into[1]);
    mt_surgery_fan fan = mt_surgery_find_fan(&view, vertex, into[0], into[1]);
    mt_index added = mt_winged_new_vertex(surgery), copies[2] = {MT_NONE, MT_NONE};
    move_fan(own, fan, added);
    if (from != MT_NONE) {
        copies[0] = copy_from(surgery, &cut, added);
    }
    if (to != MT_NONE) {
        copies[1] = copy_to(surgery, &cut, added, copies[0]);
    }
    join(surgery, &cut, mt_winged_new_edge(surgery, added, vertex), copies);
    if (out) {
        *out = added;
    }
    return MT_OK;
}
