/* When an edge may collapse: the link condition (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge
 * contraction, 1999), the boundary closed by an imagined vertex, and what it does not see: faces back to back. Cost:
 * O(valences + sides of the faces at the ends). */
#include "lib/topology/surgery_view.h"

static void mark_neighbors(const mt_surgery_view *view, mt_index begin, uint8_t mark)
{
    mt_index side = begin;
    do {
        view->marks[surgery_tail(view, side)] = mark;
        side = surgery_clockwise(view, side);
    } while (side != begin);
}

static mt_index count_common_neighbors(const mt_surgery_view *view, mt_index begin)
{
    mt_index count = 0, side = begin;
    mark_neighbors(view, begin ^ 1u, 1);
    do {
        count += view->marks[surgery_tail(view, side)];
        side = surgery_clockwise(view, side);
    } while (side != begin);
    mark_neighbors(view, begin ^ 1u, 0);
    return count;
}

/* Whether a face at the tail, but not beside the edge, names the head. */
static bool has_common_face(const mt_surgery_view *view, mt_index side)
{
    mt_index begin = side ^ 1u, head = surgery_head(view, side), at = begin;
    mt_index left = surgery_face(view, side), right = surgery_face(view, begin);
    do {
        mt_index face = surgery_face(view, at);
        bool other = face != MT_NONE && face != left && face != right;
        for (mt_index of = surgery_next(view, at); other && of != at; of = surgery_next(view, of)) {
            if (surgery_head(view, of) == head) {
                return true;
            }
        }
        at = surgery_clockwise(view, at);
    } while (at != begin);
    return false;
}

/* Sides of a face, and how many of them lie in `other` too. */
static mt_index count_sides(const mt_surgery_view *view, mt_index begin, mt_index other, mt_index *shared)
{
    mt_index count = 0, side = begin;
    *shared = 0;
    do {
        *shared += surgery_face(view, side ^ 1u) == other;
        count++;
        side = surgery_next(view, side);
    } while (side != begin);
    return count;
}

/* Whether the faces across the other two sides of the triangle at `side` would be left back to back. Each may be the
 * one on the edge's other side, which loses a side; then its whole rest must be shared, else all but one at each end.
 */
static bool leaves_duplicates(const mt_surgery_view *view, mt_index side)
{
    mt_index at_head = surgery_next(view, side) ^ 1u, at_tail = surgery_next(view, surgery_next(view, side)) ^ 1u;
    mt_index one = surgery_face(view, at_head), two = surgery_face(view, at_tail);
    if (one == MT_NONE || two == MT_NONE || one == two) {
        return false;
    }
    mt_index across = surgery_face(view, side ^ 1u);
    mt_index shared = 0, shared_again = 0;
    mt_index count = count_sides(view, at_head, two, &shared) - (one == across);
    mt_index other_count = count_sides(view, at_tail, one, &shared_again) - (two == across);
    bool loses = one == across || two == across;
    return count == other_count && shared + (loses ? 1 : 2) >= count;
}

static mt_surgery_verdict judge_lone(const mt_surgery_view *view, mt_index side)
{
    mt_index next = surgery_next(view, side);
    bool lone = surgery_in_triangle(view, side) && surgery_face(view, next ^ 1u) == MT_NONE &&
                surgery_face(view, surgery_next(view, next) ^ 1u) == MT_NONE;
    return lone ? MT_SURGERY_LONE_FACE : MT_SURGERY_ALLOWED;
}

mt_surgery_verdict mt_surgery_judge_collapse(const mt_surgery_view *view, mt_index side)
{
    if (!surgery_has_side(view, side)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    if (judge_lone(view, side) != MT_SURGERY_ALLOWED || judge_lone(view, side ^ 1u) != MT_SURGERY_ALLOWED) {
        return MT_SURGERY_LONE_FACE;
    }
    bool left = surgery_in_triangle(view, side), right = surgery_in_triangle(view, side ^ 1u);
    if ((left && leaves_duplicates(view, side)) || (right && leaves_duplicates(view, side ^ 1u))) {
        return MT_SURGERY_DUPLICATE_FACE;
    }
    bool boundary = surgery_face(view, side) == MT_NONE || surgery_face(view, side ^ 1u) == MT_NONE;
    if (!boundary && surgery_vertex_is_boundary(view, surgery_head(view, side)) &&
        surgery_vertex_is_boundary(view, surgery_tail(view, side))) {
        return MT_SURGERY_PINCH;
    }
    if (count_common_neighbors(view, side) != (mt_index)left + right) {
        return MT_SURGERY_COMMON_NEIGHBOR;
    }
    return has_common_face(view, side) ? MT_SURGERY_COMMON_FACE : MT_SURGERY_ALLOWED;
}
