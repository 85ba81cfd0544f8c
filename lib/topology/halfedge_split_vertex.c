/* Splitting a vertex: the fan is cut along one or two edges, its parts drawn apart, and the gaps filled with triangles,
 * as in Hoppe: Progressive meshes, 1996. Each cut edge stays with the old vertex; the new one gets a copy. Cost:
 * O(valence + sides of the faces beside the cuts). */
#include "lib/topology/halfedge_edit.h"

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

static void move_fan(mt_halfedge_mesh *own, const vertex_cut *cut, mt_index w)
{
    for (mt_index h = cut->begin; h != cut->end;) {
        mt_index following = mt_halfedge_clockwise(own, h);
        own->halfedges[h].head = w;
        h = following;
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

static void add_triangle(mt_halfedge_surgery *surgery, mt_index a, mt_index b, mt_index c)
{
    mt_halfedge_mesh *own = &surgery->structure;
    own->halfedges[a].next = b;
    own->halfedges[b].next = c;
    own->halfedges[c].next = a;
    mt_halfedge_new_face(surgery, a);
}

/* Joins v and w by triangles on the copied edges; where a cut is missing, the outside passes along the new edge. */
static void join(mt_halfedge_surgery *surgery, const vertex_cut *cut, const mt_index copies[2], mt_index v, mt_index w)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index edge = mt_halfedge_new_edge(surgery, w, v), back = edge ^ 1u;
    if (cut->from != MT_NONE) {
        add_triangle(surgery, cut->from ^ 1u, copies[0] ^ 1u, edge);
    } else {
        mt_index into = cut->to == cut->boundary ? copies[1] : cut->boundary;
        own->halfedges[edge].next = own->halfedges[into].next;
        own->halfedges[into].next = edge;
    }
    if (cut->to != MT_NONE) {
        add_triangle(surgery, back, copies[1] ^ 1u, cut->to);
    } else {
        own->halfedges[back].next = own->halfedges[cut->boundary].next;
        own->halfedges[cut->boundary].next = back;
    }
    mt_halfedge_anchor(own, edge);
    mt_halfedge_anchor(own, back);
}

mt_status mt_halfedge_split_vertex(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                   mt_index to, mt_index *out)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = mt_halfedge_reserve(context, surgery, 1, 3, 2);
    mt_surgery_view view = mt_halfedge_view(surgery);
    status = status == MT_OK ? mt_surgery_enter_split_vertex(context, &view, &surgery->log, vertex, from, to) : status;
    if (status != MT_OK) {
        return status;
    }
    vertex_cut cut = find_cut(own, vertex, from, to);
    mt_index added = mt_halfedge_new_vertex(surgery), copies[2] = {MT_NONE, MT_NONE};
    move_fan(own, &cut, added);
    if (from != MT_NONE) {
        copies[0] = copy_from(surgery, &cut, added);
    }
    if (to != MT_NONE) {
        copies[1] = copy_to(surgery, &cut, added);
    }
    join(surgery, &cut, copies, vertex, added);
    if (out) {
        *out = added;
    }
    return MT_OK;
}
