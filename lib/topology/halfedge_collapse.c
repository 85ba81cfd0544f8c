/* Edge collapse with the full link condition (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction,
 * 1999); the boundary counts as closed by an imagined vertex. Cost: O(valences + sides of the faces at the tail). */
#include "lib/topology/halfedge_edit.h"

static void mark_neighbors(const mt_halfedge_surgery *surgery, mt_index begin, uint8_t mark)
{
    mt_index h = begin;
    do {
        surgery->marks[mt_halfedge_tail(&surgery->structure, h)] = mark;
        h = mt_halfedge_clockwise(&surgery->structure, h);
    } while (h != begin);
}

static mt_index count_common_neighbors(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    mt_index count = 0, h = halfedge;
    mark_neighbors(surgery, halfedge ^ 1u, 1);
    do {
        count += surgery->marks[mt_halfedge_tail(&surgery->structure, h)];
        h = mt_halfedge_clockwise(&surgery->structure, h);
    } while (h != halfedge);
    mark_neighbors(surgery, halfedge ^ 1u, 0);
    return count;
}

/* Whether a face at the tail, but not beside the edge, names the head. */
static bool has_common_face(const mt_halfedge_mesh *own, mt_index halfedge)
{
    mt_index begin = halfedge ^ 1u, head = mt_halfedge_head(own, halfedge);
    mt_index left = mt_halfedge_face(own, halfedge), right = mt_halfedge_face(own, begin);
    mt_index h = begin;
    do {
        mt_index face = mt_halfedge_face(own, h);
        bool other = face != MT_NONE && face != left && face != right;
        for (mt_index side = mt_halfedge_next(own, h); other && side != h; side = mt_halfedge_next(own, side)) {
            if (mt_halfedge_head(own, side) == head) {
                return true;
            }
        }
        h = mt_halfedge_clockwise(own, h);
    } while (h != begin);
    return false;
}

/* Whether the faces across the two other sides would lie back to back: as many sides, and the same other vertices. */
static bool leaves_duplicates(const mt_halfedge_mesh *own, mt_index side)
{
    mt_index n = mt_halfedge_next(own, side), p = mt_halfedge_next(own, n);
    mt_index at = mt_halfedge_next(own, p ^ 1u);
    mt_index count = 2;
    if (mt_halfedge_is_boundary(own, n ^ 1u) || mt_halfedge_is_boundary(own, p ^ 1u)) {
        return false;
    }
    while (at != (p ^ 1u)) {
        at = mt_halfedge_next(own, at);
        count++;
    }
    mt_index other = mt_halfedge_next(own, n ^ 1u), other_count = 2;
    while (other != (n ^ 1u)) {
        other = mt_halfedge_next(own, other);
        other_count++;
    }
    if (count != other_count) {
        return false;
    }
    /* Every side of one but those at the collapsed vertices has its twin in the other. */
    mt_index face = mt_halfedge_face(own, n ^ 1u);
    mt_index shared = 0;
    for (at = mt_halfedge_next(own, p ^ 1u); at != (p ^ 1u); at = mt_halfedge_next(own, at)) {
        shared += mt_halfedge_face(own, at ^ 1u) == face;
    }
    return shared + 3 >= count;
}

static mt_surgery_verdict judge_side(const mt_halfedge_mesh *own, mt_index side)
{
    if (mt_halfedge_is_boundary(own, side)) {
        return MT_SURGERY_ALLOWED;
    }
    if (!mt_halfedge_in_triangle(own, side)) {
        return MT_SURGERY_NOT_TRIANGLES;
    }
    mt_index n = mt_halfedge_next(own, side), p = mt_halfedge_next(own, n);
    if (mt_halfedge_is_boundary(own, n ^ 1u) && mt_halfedge_is_boundary(own, p ^ 1u)) {
        return MT_SURGERY_LONE_FACE;
    }
    return leaves_duplicates(own, side) ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
}

mt_surgery_verdict mt_halfedge_can_collapse_edge(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    if (!mt_halfedge_is_alive(surgery, halfedge)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    mt_surgery_verdict verdict = judge_side(own, halfedge);
    verdict = verdict == MT_SURGERY_ALLOWED ? judge_side(own, halfedge ^ 1u) : verdict;
    if (verdict != MT_SURGERY_ALLOWED) {
        return verdict;
    }
    bool boundary = mt_halfedge_edge_is_boundary(own, halfedge >> 1);
    if (!boundary && mt_halfedge_vertex_is_boundary(own, mt_halfedge_head(own, halfedge)) &&
        mt_halfedge_vertex_is_boundary(own, mt_halfedge_tail(own, halfedge))) {
        return MT_SURGERY_PINCH;
    }
    if (count_common_neighbors(surgery, halfedge) != (boundary ? 1u : 2u)) {
        return MT_SURGERY_COMMON_NEIGHBOR;
    }
    return has_common_face(own, halfedge) ? MT_SURGERY_COMMON_FACE : MT_SURGERY_ALLOWED;
}

/* `kept` takes the place of `lost` in its face; `previous` came before it. */
static void take_place(mt_halfedge_surgery *surgery, mt_index kept, mt_index lost, mt_index previous)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index face = own->halfedges[lost].face;
    mt_halfedge_copy_corner(surgery, kept, lost);
    own->halfedges[kept].next = own->halfedges[lost].next;
    own->halfedges[kept].face = face;
    own->halfedges[previous].next = kept;
    if (face != MT_NONE && own->face_halfedge[face] == lost) {
        own->face_halfedge[face] = kept;
    }
}

/* Closes one side; `lost` is the twin of the triangle's side at the tail, `kept` the one at the head. Returns a
 * half-edge of the edge that is left of a triangle, MT_NONE on the boundary. */
static mt_index close_side(mt_halfedge_surgery *surgery, mt_index side, mt_index kept, mt_index lost, mt_index previous)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index face = own->halfedges[side].face;
    if (face == MT_NONE) {
        own->halfedges[previous].next = own->halfedges[side].next;
        return MT_NONE;
    }
    take_place(surgery, kept, lost, previous);
    own->face_halfedge[face] = MT_NONE;
    mt_halfedge_delete_edge(surgery, lost);
    return kept;
}

mt_status mt_halfedge_collapse_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, double weight)
{
    mt_status status =
        mt_halfedge_prepare(context, surgery, mt_halfedge_can_collapse_edge(surgery, halfedge), 0, 0, 0, 3);
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = halfedge, o = h ^ 1u, kept = own->halfedges[h].head, gone = own->halfedges[o].head;
    bool left = own->halfedges[h].face != MT_NONE, right = own->halfedges[o].face != MT_NONE;
    mt_index n = own->halfedges[h].next, lost_left = left ? own->halfedges[n].next ^ 1u : MT_NONE;
    mt_index m = own->halfedges[o].next, kept_right = right ? own->halfedges[m].next : MT_NONE;
    mt_index previous_left = mt_halfedge_previous(own, left ? lost_left : h);
    mt_index previous_right = mt_halfedge_previous(own, right ? m ^ 1u : o);
    mt_edit_log_add(&surgery->log, MT_DOMAIN_VERTEX, kept, kept, gone, weight);
    mt_index x = o;
    do {
        mt_index following = mt_halfedge_clockwise(own, x);
        own->halfedges[x].head = kept;
        x = following;
    } while (x != o);
    mt_index one = close_side(surgery, h, n, lost_left, previous_left);
    mt_index two = close_side(surgery, o, kept_right, m ^ 1u, previous_right);
    mt_halfedge_delete_edge(surgery, h);
    own->vertex_halfedge[gone] = MT_NONE;
    surgery->vertex_deleted[gone] = 1;
    mt_index ends[] = {one, one == MT_NONE ? MT_NONE : one ^ 1u, two, two == MT_NONE ? MT_NONE : two ^ 1u};
    for (int i = 0; i < 4; i++) {
        if (mt_halfedge_is_alive(surgery, ends[i])) {
            mt_halfedge_anchor(own, ends[i]);
        }
    }
    return MT_OK;
}
