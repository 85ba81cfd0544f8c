/* Splitting a vertex of the triangle-neighbour structure: the fan is cut along one or two edges, its parts drawn apart,
 * and the gaps filled with triangles. The invariant: after it every invariant of the structure holds among what is not
 * deleted. Cost: O(valence). */
#include "lib/topology/triangle_edit.h"

/* What lies on the new vertex's side of a cut edge, and on the old one's: sides, MT_NONE outside or without a cut. */
typedef struct cut_edge {
    mt_index end; /* the edge's other end; MT_NONE without a cut */
    mt_index added_side, old_side;
} cut_edge;

/* `into` points to the vertex. The cut at `to` has the new vertex clockwise of it, the one at `from` on the other side.
 */
static cut_edge find_cut(const mt_triangle_neighbor_mesh *own, mt_index into, bool is_to)
{
    if (into == MT_NONE) {
        return (cut_edge){MT_NONE, MT_NONE, MT_NONE};
    }
    mt_index clockwise = triangle_side_corner(own, into), other = triangle_side_corner(own, into ^ 1u);
    return (cut_edge){triangle_side_head(own, into ^ 1u), is_to ? clockwise : other, is_to ? other : clockwise};
}

static void move_corner(mt_triangle_neighbor_mesh *own, mt_index side, mt_index vertex)
{
    mt_index corner = triangle_side_corner(own, side);
    if (corner != MT_NONE) {
        own->vertices[mt_triangle_next_corner(corner)] = vertex;
    }
}

/* The walk goes by neighbours alone, so that renamed corners do not mislead it. */
static void move_fan(mt_triangle_neighbor_mesh *own, mt_surgery_fan fan, mt_index to, mt_index vertex)
{
    for (mt_index side = fan.begin; side != fan.end; side = triangle_side_next(own, side) ^ 1u) {
        move_corner(own, side, vertex);
    }
    if (to != MT_NONE) {
        move_corner(own, to, vertex);
    }
}

/* The triangle (v x w); returns its side from w to v. */
static mt_index open_from(mt_triangle_surgery *surgery, const cut_edge *cut, mt_index v, mt_index w)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index triangle = mt_triangle_new(surgery, v, cut->end, w);
    triangle_pair(own, triangle, cut->old_side);
    triangle_pair(own, triangle + 1, cut->added_side);
    if (cut->added_side == MT_NONE) {
        own->vertex_corner[cut->end] = triangle + 1;
    }
    return triangle + 2;
}

/* The triangle (v w y); returns its side from v to w. */
static mt_index open_to(mt_triangle_surgery *surgery, const cut_edge *cut, mt_index v, mt_index w)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index triangle = mt_triangle_new(surgery, v, w, cut->end);
    triangle_pair(own, triangle + 1, cut->added_side);
    triangle_pair(own, triangle + 2, cut->old_side);
    if (cut->old_side == MT_NONE) {
        own->vertex_corner[cut->end] = triangle + 2;
    }
    return triangle;
}

mt_status mt_triangle_split_vertex(mt_context *context, mt_triangle_surgery *surgery, mt_index vertex, mt_index from,
                                   mt_index to, mt_index *out)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_status status = mt_triangle_reserve(context, surgery, 1, 2);
    mt_surgery_view view = mt_triangle_view(surgery);
    mt_index into_from = from == MT_NONE ? MT_NONE : mt_triangle_side_from(surgery, from, vertex) ^ 1u;
    mt_index into_to = to == MT_NONE ? MT_NONE : mt_triangle_side_from(surgery, to, vertex) ^ 1u;
    status = status == MT_OK ? mt_surgery_enter_split_vertex(context, &view, &surgery->log, vertex, into_from, into_to)
                             : status;
    if (status != MT_OK) {
        return status;
    }
    cut_edge cuts[2] = {find_cut(own, into_from, false), find_cut(own, into_to, true)};
    mt_surgery_fan fan = mt_surgery_find_fan(&view, vertex, into_from, into_to);
    mt_index added = mt_triangle_new_vertex(surgery), to_old = MT_NONE, to_added = MT_NONE;
    move_fan(own, fan, into_to, added);
    if (from != MT_NONE) {
        to_old = open_from(surgery, &cuts[0], vertex, added);
    }
    if (to != MT_NONE) {
        to_added = open_to(surgery, &cuts[1], vertex, added);
    }
    triangle_pair(own, to_old, to_added);
    mt_index joint = to_old != MT_NONE ? to_old : to_added;
    mt_triangle_anchor(own, joint);
    mt_triangle_anchor(own, mt_triangle_next_corner(joint));
    if (out) {
        *out = added;
    }
    return MT_OK;
}
