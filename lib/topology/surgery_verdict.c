/* The predicates of surgery but that of collapse, each in the order of precedence that surgery.h gives. Cost:
 * O(valences + sides). */
#include "lib/topology/surgery_view.h"

mt_index mt_surgery_find_side(const mt_surgery_view *view, mt_index tail, mt_index head)
{
    if (!surgery_has_vertex(view, tail) || !surgery_has_vertex(view, head)) {
        return MT_NONE;
    }
    mt_index begin = view->vertex_side(view->structure, head), side = begin;
    while (side != MT_NONE && surgery_tail(view, side) != tail) {
        side = surgery_clockwise(view, side);
        side = side == begin ? MT_NONE : side;
    }
    return side;
}

mt_surgery_verdict mt_surgery_judge_swap(const mt_surgery_view *view, mt_index edge)
{
    if (edge > MT_INDEX_MAX / 2 || !surgery_has_side(view, 2 * edge)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    mt_index left = 2 * edge, right = left + 1;
    if (surgery_face(view, left) == MT_NONE || surgery_face(view, right) == MT_NONE) {
        return MT_SURGERY_BOUNDARY_EDGE;
    }
    if (!surgery_in_triangle(view, left) || !surgery_in_triangle(view, right)) {
        return MT_SURGERY_NOT_TRIANGLES;
    }
    mt_index c = surgery_head(view, surgery_next(view, left)), d = surgery_head(view, surgery_next(view, right));
    return c == d || mt_surgery_find_side(view, c, d) != MT_NONE ? MT_SURGERY_EDGE_EXISTS : MT_SURGERY_ALLOWED;
}

mt_surgery_verdict mt_surgery_judge_split_edge(const mt_surgery_view *view, mt_index side)
{
    if (!surgery_has_side(view, side)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    if (!surgery_in_triangle(view, side) || !surgery_in_triangle(view, side ^ 1u)) {
        return MT_SURGERY_ALLOWED;
    }
    mt_index c = surgery_head(view, surgery_next(view, side)), d = surgery_head(view, surgery_next(view, side ^ 1u));
    return c == d ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
}

mt_surgery_verdict mt_surgery_judge_split_vertex(const mt_surgery_view *view, mt_index vertex, mt_index from,
                                                 mt_index to)
{
    bool opens_from = from != MT_NONE, opens_to = to != MT_NONE;
    if (!surgery_has_vertex(view, vertex) || (!opens_from && !opens_to) ||
        (opens_from && (!surgery_has_side(view, from) || surgery_head(view, from) != vertex)) ||
        (opens_to && (!surgery_has_side(view, to) || surgery_head(view, to) != vertex))) {
        return MT_SURGERY_NO_ELEMENT;
    }
    if ((!opens_from || !opens_to) && !surgery_vertex_is_boundary(view, vertex)) {
        return MT_SURGERY_INTERIOR_VERTEX;
    }
    return from == to ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
}

mt_surgery_verdict mt_surgery_judge_remove_face(const mt_surgery_view *view, mt_index face)
{
    if (!surgery_has_face(view, face)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    mt_index begin = view->face_side(view->structure, face), side = begin;
    do {
        mt_index next = surgery_next(view, side);
        if (surgery_face(view, side ^ 1u) != MT_NONE && surgery_face(view, next ^ 1u) != MT_NONE &&
            surgery_vertex_is_boundary(view, surgery_head(view, side))) {
            return MT_SURGERY_PINCH;
        }
        side = next;
    } while (side != begin);
    return MT_SURGERY_ALLOWED;
}

/* Whether they are fewer than three, one is missing, or one comes twice. */
static mt_surgery_verdict judge_vertices(const mt_surgery_view *view, mt_index count, const mt_index *vertices)
{
    if (count < 3) {
        return MT_SURGERY_NOT_A_FACE;
    }
    for (mt_index i = 0; i < count; i++) {
        if (!surgery_has_vertex(view, vertices[i])) {
            return MT_SURGERY_NO_ELEMENT;
        }
    }
    bool repeats = false;
    for (mt_index i = 0; i < count; i++) {
        repeats |= view->marks[vertices[i]];
        view->marks[vertices[i]] = 1;
    }
    for (mt_index i = 0; i < count; i++) {
        view->marks[vertices[i]] = 0;
    }
    return repeats ? MT_SURGERY_NOT_A_FACE : MT_SURGERY_ALLOWED;
}

/* Whether the face along `side` outside, of `count` sides, lies along each of the new face's sides. */
static bool repeats_face(const mt_surgery_view *view, mt_index count, const mt_index *vertices)
{
    mt_index first = mt_surgery_find_side(view, vertices[1], vertices[0]);
    mt_index face = first == MT_NONE ? MT_NONE : surgery_face(view, first);
    if (face == MT_NONE) {
        return false;
    }
    mt_index side = first;
    for (mt_index i = 0; i < count; i++) {
        if (surgery_head(view, side) != vertices[(count - i) % count]) {
            return false;
        }
        side = surgery_next(view, side);
    }
    return side == first;
}

mt_surgery_verdict mt_surgery_judge_add_face(const mt_surgery_view *view, mt_index count, const mt_index *vertices)
{
    mt_surgery_verdict verdict = judge_vertices(view, count, vertices);
    if (verdict != MT_SURGERY_ALLOWED) {
        return verdict;
    }
    if (view->triangles_only && count != 3) {
        return MT_SURGERY_NOT_TRIANGLES;
    }
    bool pinches = false, was_joined = mt_surgery_find_side(view, vertices[count - 1], vertices[0]) != MT_NONE;
    for (mt_index i = 0; i < count; i++) {
        mt_index vertex = vertices[i];
        mt_index side = mt_surgery_find_side(view, vertex, vertices[(i + 1) % count]);
        if (side != MT_NONE && surgery_face(view, side) != MT_NONE) {
            return MT_SURGERY_EDGE_EXISTS;
        }
        bool is_joined = side != MT_NONE;
        pinches |= !was_joined && !is_joined && view->vertex_side(view->structure, vertex) != MT_NONE;
        was_joined = is_joined;
    }
    if (pinches) {
        return MT_SURGERY_PINCH;
    }
    return repeats_face(view, count, vertices) ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
}
