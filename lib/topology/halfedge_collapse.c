/* Edge collapse with the full link condition (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction,
 * 1999); the boundary counts as closed by an imagined vertex. Cost: O(valences + sides of the faces at the tail). */
#include "lib/topology/edit_entries.h"
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

static mt_index count_sides(const mt_halfedge_mesh *own, mt_index begin)
{
    mt_index count = 0, h = begin;
    do {
        count++;
        h = mt_halfedge_next(own, h);
    } while (h != begin);
    return count;
}

/* Whether the faces across the other two sides of a triangle would lie back to back: as many sides, and all of them
 * shared but those at the edge. */
static bool leaves_duplicates(const mt_halfedge_mesh *own, mt_index side)
{
    mt_index across_b = mt_halfedge_next(own, side) ^ 1u;
    mt_index across_a = mt_halfedge_next(own, mt_halfedge_next(own, side)) ^ 1u;
    mt_index face_a = mt_halfedge_face(own, across_a), face_b = mt_halfedge_face(own, across_b);
    mt_index beyond = mt_halfedge_face(own, side ^ 1u);
    if (face_a == MT_NONE || face_b == MT_NONE || face_a == face_b) {
        return false;
    }
    mt_index count_a = count_sides(own, across_a) - (face_a == beyond);
    mt_index count_b = count_sides(own, across_b) - (face_b == beyond);
    mt_index shared = face_a == beyond || face_b == beyond ? 1 : 2;
    for (mt_index h = mt_halfedge_next(own, across_a); h != across_a; h = mt_halfedge_next(own, h)) {
        shared += mt_halfedge_face(own, h ^ 1u) == face_b;
    }
    return shared >= count_a && count_a == count_b;
}

static bool is_lone_triangle(const mt_halfedge_mesh *own, mt_index side)
{
    mt_index next = mt_halfedge_next(own, side), last = mt_halfedge_next(own, next);
    return mt_halfedge_in_triangle(own, side) && mt_halfedge_is_boundary(own, next ^ 1u) &&
           mt_halfedge_is_boundary(own, last ^ 1u);
}

mt_surgery_verdict mt_halfedge_can_collapse_edge(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    if (!mt_halfedge_is_alive(surgery, halfedge)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    mt_index twin = halfedge ^ 1u;
    bool left = mt_halfedge_in_triangle(own, halfedge), right = mt_halfedge_in_triangle(own, twin);
    if (is_lone_triangle(own, halfedge) || is_lone_triangle(own, twin)) {
        return MT_SURGERY_LONE_FACE;
    }
    if ((left && leaves_duplicates(own, halfedge)) || (right && leaves_duplicates(own, twin))) {
        return MT_SURGERY_DUPLICATE_FACE;
    }
    if (!mt_halfedge_edge_is_boundary(own, halfedge >> 1) &&
        mt_halfedge_vertex_is_boundary(own, mt_halfedge_head(own, halfedge)) &&
        mt_halfedge_vertex_is_boundary(own, mt_halfedge_tail(own, halfedge))) {
        return MT_SURGERY_PINCH;
    }
    if (count_common_neighbors(surgery, halfedge) != (mt_index)left + right) {
        return MT_SURGERY_COMMON_NEIGHBOR;
    }
    return has_common_face(own, halfedge) ? MT_SURGERY_COMMON_FACE : MT_SURGERY_ALLOWED;
}

static uint64_t count_edits(const mt_halfedge_mesh *own, mt_index halfedge)
{
    uint64_t valences = (uint64_t)mt_halfedge_valence(own, mt_halfedge_head(own, halfedge)) +
                        mt_halfedge_valence(own, mt_halfedge_tail(own, halfedge));
    return MT_EDIT_COLLAPSE_VERTEX_COUNT + 2 * MT_EDIT_COLLAPSE_SIDE_COUNT +
           valences * (MT_EDIT_COLLAPSE_EDGE_COUNT + MT_EDIT_COLLAPSE_CORNER_COUNT);
}

static void log_corners(mt_halfedge_surgery *surgery, const mt_edit_collapse *collapse, mt_index vertex)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_halfedge_ring ring = mt_halfedge_ring_begin_clockwise(own, vertex);
    for (; mt_halfedge_ring_goes_on(&ring); mt_halfedge_ring_clockwise(own, &ring)) {
        if (vertex == collapse->gone && ring.neighbor != collapse->kept) {
            mt_edit_collapse_edge(&surgery->log, collapse, ring.neighbor);
        }
        if (ring.face != MT_NONE && ring.face != collapse->left && ring.face != collapse->right) {
            mt_edit_collapse_corner(&surgery->log, collapse, ring.face, vertex);
        }
    }
}

static void log_collapse(mt_halfedge_surgery *surgery, mt_index halfedge, double weight)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_index twin = halfedge ^ 1u;
    mt_edit_collapse collapse = {mt_halfedge_head(own, halfedge), mt_halfedge_tail(own, halfedge),
                                 mt_halfedge_face(own, halfedge), mt_halfedge_face(own, twin), weight};
    mt_edit_collapse_vertex(&surgery->log, &collapse);
    log_corners(surgery, &collapse, collapse.gone);
    log_corners(surgery, &collapse, collapse.kept);
    if (collapse.left != MT_NONE && !mt_halfedge_in_triangle(own, halfedge)) {
        mt_edit_collapse_side(&surgery->log, &collapse, collapse.left);
    }
    if (collapse.right != MT_NONE && !mt_halfedge_in_triangle(own, twin)) {
        mt_edit_collapse_side(&surgery->log, &collapse, collapse.right);
    }
}

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
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_collapse_edge(surgery, halfedge), weight);
    status = status == MT_OK ? mt_halfedge_reserve(context, surgery, 0, 0, 0, count_edits(own, halfedge)) : status;
    if (status != MT_OK) {
        return status;
    }
    log_collapse(surgery, halfedge, weight);
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
