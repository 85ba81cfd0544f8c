/* Swapping and splitting edges. The invariant: after each operation every invariant of the half-edge structure holds
 * among what is not deleted. Cost: O(valence). */
#include "lib/topology/halfedge_edit.h"

mt_surgery_verdict mt_halfedge_can_swap_edge(const mt_halfedge_surgery *surgery, mt_index edge)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    if (edge >= own->halfedge_count / 2 || !mt_halfedge_is_alive(surgery, 2 * edge)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    mt_index h = 2 * edge;
    if (mt_halfedge_edge_is_boundary(own, edge)) {
        return MT_SURGERY_BOUNDARY_EDGE;
    }
    if (!mt_halfedge_in_triangle(own, h) || !mt_halfedge_in_triangle(own, h ^ 1u)) {
        return MT_SURGERY_NOT_TRIANGLES;
    }
    mt_index c = mt_halfedge_head(own, mt_halfedge_next(own, h));
    mt_index d = mt_halfedge_head(own, mt_halfedge_next(own, h ^ 1u));
    return c == d || mt_halfedge_find(own, c, d) != MT_NONE ? MT_SURGERY_EDGE_EXISTS : MT_SURGERY_ALLOWED;
}

static void set_triangle(mt_halfedge_mesh *own, mt_index face, mt_index a, mt_index b, mt_index c)
{
    own->halfedges[a].next = b;
    own->halfedges[b].next = c;
    own->halfedges[c].next = a;
    own->halfedges[a].face = own->halfedges[b].face = own->halfedges[c].face = face;
    own->face_halfedge[face] = a;
}

mt_status mt_halfedge_swap_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge)
{
    mt_status status = mt_halfedge_prepare(context, surgery, mt_halfedge_can_swap_edge(surgery, edge), 0, 0, 0, 2);
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = 2 * edge, o = h ^ 1u;
    mt_index h1 = own->halfedges[h].next, h2 = own->halfedges[h1].next;
    mt_index o1 = own->halfedges[o].next, o2 = own->halfedges[o1].next;
    mt_index a = own->halfedges[o].head, b = own->halfedges[h].head;
    mt_halfedge_copy_corner(surgery, h, o2);
    mt_halfedge_copy_corner(surgery, o, h2);
    own->halfedges[h].head = own->halfedges[h1].head;
    own->halfedges[o].head = own->halfedges[o1].head;
    set_triangle(own, own->halfedges[h].face, h, h2, o1);
    set_triangle(own, own->halfedges[o].face, o, o2, h1);
    own->vertex_halfedge[a] = own->vertex_halfedge[a] == o ? h2 : own->vertex_halfedge[a];
    own->vertex_halfedge[b] = own->vertex_halfedge[b] == h ? o2 : own->vertex_halfedge[b];
    return MT_OK;
}

mt_surgery_verdict mt_halfedge_can_split_edge(const mt_halfedge_surgery *surgery, mt_index edge)
{
    bool exists = edge < surgery->structure.halfedge_count / 2 && mt_halfedge_is_alive(surgery, 2 * edge);
    return exists ? MT_SURGERY_ALLOWED : MT_SURGERY_NO_ELEMENT;
}

/* Cuts the quadrilateral of h with an edge from the head of h to the opposite corner; what lies after h is new. */
static void cut_quadrilateral(mt_halfedge_surgery *surgery, mt_index h)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index after = own->halfedges[h].next, last = own->halfedges[after].next, rest = own->halfedges[last].next;
    mt_index face = own->halfedges[h].face;
    mt_index cut = mt_halfedge_new_edge(surgery, own->halfedges[h].head, own->halfedges[last].head);
    own->halfedges[last].next = cut ^ 1u;
    own->halfedges[cut ^ 1u].next = after;
    mt_index other = mt_halfedge_new_face(surgery, after);
    set_triangle(own, face, h, cut, rest);
    mt_halfedge_copy_corner(surgery, cut, after);
    mt_halfedge_copy_corner(surgery, cut ^ 1u, rest);
    mt_edit_log_add(&surgery->log, MT_DOMAIN_FACE, other, face, face, 0);
}

/* The new vertex on h gives it a half-edge `after` and its twin one before it. */
static void put_vertex(mt_halfedge_surgery *surgery, mt_index h, mt_index after, mt_index vertex, double weight)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index o = h ^ 1u, before = after ^ 1u, head = own->halfedges[h].head;
    mt_index previous = mt_halfedge_previous(own, o);
    mt_halfedge_copy_corner(surgery, before, o);
    mt_edit_log_add(&surgery->log, MT_DOMAIN_CORNER, after, h, before, weight);
    if (!mt_halfedge_is_boundary(own, h)) {
        mt_edit_log_add(&surgery->log, MT_DOMAIN_CORNER, after, h, own->halfedges[h].next, weight);
    }
    if (!mt_halfedge_is_boundary(own, o)) {
        mt_edit_log_add(&surgery->log, MT_DOMAIN_CORNER, o, own->halfedges[o].next, before, weight);
    }
    own->halfedges[after] = (mt_halfedge){own->halfedges[h].next, head, own->halfedges[h].face};
    own->halfedges[before] = (mt_halfedge){o, vertex, own->halfedges[o].face};
    own->halfedges[h].next = after;
    own->halfedges[h].head = vertex;
    own->halfedges[previous].next = before;
    if (own->vertex_halfedge[head] == h) {
        own->vertex_halfedge[head] = after;
    }
    own->vertex_halfedge[vertex] = mt_halfedge_is_boundary(own, o) ? before : h;
    if (!mt_halfedge_is_boundary(own, o) && own->face_halfedge[own->halfedges[o].face] == o) {
        own->face_halfedge[own->halfedges[o].face] = before;
    }
}

mt_status mt_halfedge_split_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge, double weight,
                                 mt_index *vertex)
{
    mt_status status = mt_halfedge_prepare(context, surgery, mt_halfedge_can_split_edge(surgery, edge), 1, 3, 2, 12);
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = 2 * edge, tail = own->halfedges[h ^ 1u].head, head = own->halfedges[h].head;
    bool left = !mt_halfedge_is_boundary(own, h) && mt_halfedge_in_triangle(own, h);
    bool right = !mt_halfedge_is_boundary(own, h ^ 1u) && mt_halfedge_in_triangle(own, h ^ 1u);
    mt_index middle = mt_halfedge_new_vertex(surgery);
    mt_index after = mt_halfedge_new_edge(surgery, middle, head);
    mt_edit_log_add(&surgery->log, MT_DOMAIN_VERTEX, middle, tail, head, weight);
    put_vertex(surgery, h, after, middle, weight);
    if (left) {
        cut_quadrilateral(surgery, h);
    }
    if (right) {
        cut_quadrilateral(surgery, after ^ 1u);
    }
    if (vertex) {
        *vertex = middle;
    }
    return MT_OK;
}
