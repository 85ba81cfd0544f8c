/* Splitting a vertex: the fan is cut along one or two edges, its parts drawn apart, and the gaps filled with triangles,
 * as in Hoppe: Progressive meshes, 1996. Each cut edge stays with the old vertex; the new one gets a copy. Cost:
 * O(valence + sides of the faces beside the cuts). */
#include "lib/topology/edit_entries.h"
#include "lib/topology/halfedge_edit.h"

static bool points_to(const mt_halfedge_surgery *surgery, mt_index halfedge, mt_index vertex)
{
    return mt_halfedge_is_alive(surgery, halfedge) && mt_halfedge_head(&surgery->structure, halfedge) == vertex;
}

mt_surgery_verdict mt_halfedge_can_split_vertex(const mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                                mt_index to)
{
    if (!mt_halfedge_vertex_is_alive(surgery, vertex) || (from == MT_NONE && to == MT_NONE) ||
        (from != MT_NONE && !points_to(surgery, from, vertex)) || (to != MT_NONE && !points_to(surgery, to, vertex))) {
        return MT_SURGERY_NO_ELEMENT;
    }
    if ((from == MT_NONE || to == MT_NONE) && !mt_halfedge_vertex_is_boundary(&surgery->structure, vertex)) {
        return MT_SURGERY_INTERIOR_VERTEX;
    }
    return from == to ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
}

/* The half-edges that pass to the new vertex come clockwise from `begin` on, before `end`. */
typedef struct vertex_cut {
    mt_index from, to;
    mt_index before_from, before_to; /* the half-edges before the twin of `from` and before `to` */
    mt_index boundary;               /* the boundary half-edge into the vertex */
    mt_index begin, end;
} vertex_cut;

static vertex_cut find_cut(const mt_halfedge_mesh *own, mt_index vertex, mt_index from, mt_index to)
{
    vertex_cut cut = {.from = from, .to = to, .before_from = MT_NONE, .before_to = MT_NONE};
    cut.boundary = own->vertex_halfedge[vertex];
    cut.begin = mt_halfedge_clockwise(own, to == MT_NONE ? cut.boundary : to);
    cut.end = from == MT_NONE ? mt_halfedge_clockwise(own, cut.boundary) : from;
    if (from != MT_NONE) {
        cut.before_from = mt_halfedge_previous(own, from ^ 1u);
    }
    if (to != MT_NONE) {
        cut.before_to = mt_halfedge_previous(own, to);
    }
    return cut;
}

static void move_fan(mt_halfedge_surgery *surgery, const vertex_cut *cut, mt_index v, mt_index w)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_edit_split_vertex(&surgery->log, v, w);
    for (mt_index h = cut->begin; h != cut->end;) {
        mt_index following = mt_halfedge_clockwise(own, h);
        own->halfedges[h].head = w;
        mt_edit_move_edge(&surgery->log, v, w, own->halfedges[h ^ 1u].head);
        if (own->halfedges[h].face != MT_NONE) {
            mt_edit_move_corner(&surgery->log, own->halfedges[h].face, v, w);
        }
        h = following;
    }
    if (cut->to != MT_NONE && own->halfedges[cut->to].face != MT_NONE) {
        mt_edit_move_corner(&surgery->log, own->halfedges[cut->to].face, v, w);
    }
}

/* Puts `kept` where `lost` is, after `previous`. */
static void replace(mt_halfedge_mesh *own, mt_index kept, mt_index lost, mt_index previous)
{
    mt_index face = own->halfedges[lost].face;
    own->halfedges[kept].next = own->halfedges[lost].next;
    own->halfedges[kept].face = face;
    own->halfedges[previous].next = kept;
    if (face != MT_NONE && own->face_halfedge[face] == lost) {
        own->face_halfedge[face] = kept;
    }
}

/* The copy of the edge that opens: it runs from w to its other end at `from`, and the other way at `to`. */
static mt_index copy_from(mt_halfedge_surgery *surgery, const vertex_cut *cut, mt_index w)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index out = cut->from ^ 1u, x = own->halfedges[out].head;
    mt_index copy = mt_halfedge_new_edge(surgery, w, x);
    replace(own, copy, out, cut->before_from);
    if (own->vertex_halfedge[x] == out) {
        own->vertex_halfedge[x] = copy;
    }
    return copy;
}

static mt_index copy_to(mt_halfedge_surgery *surgery, const vertex_cut *cut, mt_index w)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index copy = mt_halfedge_new_edge(surgery, mt_halfedge_tail(own, cut->to), w);
    replace(own, copy, cut->to, cut->before_to);
    return copy;
}

/* The gap that opens at one cut: its three sides, the faces on either side of the edge, w's first, and its far end. */
typedef struct gap {
    mt_index sides[3], parents[2], end;
} gap;

static void fill_gap(mt_halfedge_surgery *surgery, const gap *at, mt_index v, mt_index w)
{
    mt_halfedge_mesh *own = &surgery->structure;
    for (int i = 0; i < 3; i++) {
        own->halfedges[at->sides[i]].next = at->sides[(i + 1) % 3];
    }
    mt_index face = mt_halfedge_new_face(surgery, at->sides[0]);
    mt_index parent = at->parents[at->parents[0] == MT_NONE];
    mt_edit_open_edge(&surgery->log, face, parent, v, w, at->end);
}

/* Joins v and w; where a cut is missing, the outside passes along the new edge. */
static void join(mt_halfedge_surgery *surgery, const vertex_cut *cut, mt_index v, mt_index w, gap gaps[2])
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index edge = mt_halfedge_new_edge(surgery, w, v), back = edge ^ 1u;
    if (cut->from != MT_NONE) {
        gaps[0].sides[2] = edge;
        fill_gap(surgery, &gaps[0], v, w);
    } else {
        mt_index into = cut->to == cut->boundary ? gaps[1].sides[1] ^ 1u : cut->boundary;
        own->halfedges[edge].next = own->halfedges[into].next;
        own->halfedges[into].next = edge;
    }
    if (cut->to != MT_NONE) {
        gaps[1].sides[0] = back;
        fill_gap(surgery, &gaps[1], v, w);
    } else {
        own->halfedges[back].next = own->halfedges[cut->boundary].next;
        own->halfedges[cut->boundary].next = back;
    }
    mt_halfedge_anchor(own, edge);
    mt_halfedge_anchor(own, back);
}

/* Moves the fan and copies the cut edges; what is left between v and w are the gaps. */
static void open_fan(mt_halfedge_surgery *surgery, const vertex_cut *cut, mt_index v, mt_index w, gap gaps[2])
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_index from = cut->from, to = cut->to;
    if (from != MT_NONE) {
        gaps[0] = (gap){{from ^ 1u, MT_NONE, MT_NONE},
                        {mt_halfedge_face(own, from ^ 1u), mt_halfedge_face(own, from)},
                        mt_halfedge_tail(own, from)};
    }
    if (to != MT_NONE) {
        gaps[1] = (gap){{MT_NONE, MT_NONE, to},
                        {mt_halfedge_face(own, to), mt_halfedge_face(own, to ^ 1u)},
                        mt_halfedge_tail(own, to)};
    }
    move_fan(surgery, cut, v, w);
    if (from != MT_NONE) {
        gaps[0].sides[1] = copy_from(surgery, cut, w) ^ 1u;
    }
    if (to != MT_NONE) {
        gaps[1].sides[1] = copy_to(surgery, cut, w) ^ 1u;
    }
}

mt_status mt_halfedge_split_vertex(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                   mt_index to, mt_index *out)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_split_vertex(surgery, vertex, from, to), 0);
    if (status != MT_OK) {
        return status;
    }
    uint64_t edits = MT_EDIT_SPLIT_VERTEX_COUNT + 2 * MT_EDIT_OPEN_EDGE_COUNT + MT_EDIT_MOVE_CORNER_COUNT +
                     mt_halfedge_valence(own, vertex) * (uint64_t)(MT_EDIT_MOVE_EDGE_COUNT + MT_EDIT_MOVE_CORNER_COUNT);
    status = mt_halfedge_reserve(context, surgery, 1, 3, 2, edits);
    if (status != MT_OK) {
        return status;
    }
    vertex_cut cut = find_cut(own, vertex, from, to);
    gap gaps[2] = {0};
    mt_index w = mt_halfedge_new_vertex(surgery);
    open_fan(surgery, &cut, vertex, w, gaps);
    join(surgery, &cut, vertex, w, gaps);
    if (out) {
        *out = w;
    }
    return MT_OK;
}
