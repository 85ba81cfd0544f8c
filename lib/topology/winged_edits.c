/* Swapping and splitting edges of the winged-edge structure. The invariant: after each operation every invariant of the
 * structure holds among what is not deleted. Cost: O(1), and O(valence) to see whether a swap is allowed. */
#include "lib/topology/winged_edit.h"

mt_status mt_winged_swap_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_surgery_view view = mt_winged_view(surgery);
    mt_status status = mt_surgery_enter_swap(context, &view, &surgery->log, edge);
    if (status != MT_OK) {
        return status;
    }
    mt_index to_b = 2 * edge, to_a = to_b + 1;
    mt_index b_to_c = winged_side_next(own, to_b), c_to_a = winged_side_next(own, b_to_c);
    mt_index a_to_d = winged_side_next(own, to_a), d_to_b = winged_side_next(own, a_to_d);
    mt_index a = winged_side_tail(own, to_b), b = winged_side_tail(own, to_a);
    mt_index left = winged_side_face(own, to_b), right = winged_side_face(own, to_a);
    winged_side_set_tail(own, to_b, winged_side_tail(own, d_to_b));
    winged_side_set_tail(own, to_a, winged_side_tail(own, c_to_a));
    mt_winged_set_triangle(own, left, to_b, c_to_a, a_to_d);
    mt_winged_set_triangle(own, right, to_a, d_to_b, b_to_c);
    own->vertex_edge[a] = own->vertex_edge[a] == edge ? c_to_a >> 1 : own->vertex_edge[a];
    own->vertex_edge[b] = own->vertex_edge[b] == edge ? d_to_b >> 1 : own->vertex_edge[b];
    return MT_OK;
}

/* The side from a to b becomes that from a to the middle; `after` follows it to b. */
static void put_vertex(mt_winged_edge_mesh *own, mt_index side, mt_index after, mt_index middle)
{
    mt_index twin = side ^ 1u, before = after ^ 1u, head = winged_side_head(own, side);
    mt_index next = winged_side_next(own, side), previous = winged_side_previous(own, twin);
    mt_index right = winged_side_face(own, twin);
    winged_side_set_face(own, after, winged_side_face(own, side));
    winged_side_set_face(own, before, right);
    winged_side_set_tail(own, twin, middle);
    winged_side_link(own, side, after);
    winged_side_link(own, after, next);
    winged_side_link(own, previous, before);
    winged_side_link(own, before, twin);
    if (own->vertex_edge[head] == side >> 1) {
        own->vertex_edge[head] = after >> 1;
    }
    own->vertex_edge[middle] = (right == MT_NONE ? before : side) >> 1;
    if (right != MT_NONE && own->face_edge[right] == side >> 1) {
        own->face_edge[right] = before >> 1;
    }
}

/* Cuts the quadrilateral around the middle, to which `in` points, from it to the opposite corner. The face keeps the
 * triangle of `in`, or that of the side after it. */
static void cut_quadrilateral(mt_winged_surgery *surgery, mt_index in, bool keep_in)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_index out = winged_side_next(own, in), last = winged_side_next(own, out), rest = winged_side_next(own, last);
    mt_index face = winged_side_face(own, in), other = mt_winged_new_face(surgery);
    mt_index cut = mt_winged_new_edge(surgery, winged_side_head(own, in), winged_side_head(own, last));
    mt_winged_set_triangle(own, keep_in ? face : other, in, cut, rest);
    mt_winged_set_triangle(own, keep_in ? other : face, out, last, cut ^ 1u);
}

mt_status mt_winged_split_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge, mt_index tail,
                               double weight, mt_index *vertex)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_status status = mt_winged_reserve(context, surgery, 1, 3, 2);
    mt_index side = mt_winged_side_from(surgery, edge, tail);
    mt_surgery_view view = mt_winged_view(surgery);
    status = status == MT_OK ? mt_surgery_enter_split_edge(context, &view, &surgery->log, side, weight) : status;
    if (status != MT_OK) {
        return status;
    }
    bool cut_left = surgery_in_triangle(&view, side), cut_right = surgery_in_triangle(&view, side ^ 1u);
    mt_index middle = mt_winged_new_vertex(surgery);
    mt_index after = mt_winged_new_edge(surgery, middle, winged_side_head(own, side));
    put_vertex(own, side, after, middle);
    if (cut_left) {
        cut_quadrilateral(surgery, side, true);
    }
    if (cut_right) {
        cut_quadrilateral(surgery, after ^ 1u, false);
    }
    if (vertex) {
        *vertex = middle;
    }
    return MT_OK;
}
