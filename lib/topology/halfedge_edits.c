/* Swapping and splitting edges. The invariant: after each operation every invariant of the half-edge structure holds
 * among what is not deleted. Cost: O(valence) to swap, O(sides) to split. */
#include "lib/topology/halfedge_edit.h"

void mt_halfedge_set_triangle(mt_halfedge_mesh *structure, mt_index face, mt_index a, mt_index b, mt_index c)
{
    mt_halfedge *halfedges = structure->halfedges;
    halfedges[a].next = b;
    halfedges[b].next = c;
    halfedges[c].next = a;
    halfedges[a].face = halfedges[b].face = halfedges[c].face = face;
    structure->face_halfedge[face] = a;
}

mt_status mt_halfedge_swap_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    mt_status status = mt_surgery_enter_swap(context, &view, &surgery->log, edge);
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = 2 * edge, o = h ^ 1u;
    mt_index h1 = own->halfedges[h].next, h2 = own->halfedges[h1].next;
    mt_index o1 = own->halfedges[o].next, o2 = own->halfedges[o1].next;
    mt_index a = own->halfedges[o].head, b = own->halfedges[h].head;
    mt_index c = own->halfedges[h1].head, d = own->halfedges[o1].head;
    own->halfedges[h].head = c;
    own->halfedges[o].head = d;
    mt_halfedge_set_triangle(own, own->halfedges[h].face, h, h2, o1);
    mt_halfedge_set_triangle(own, own->halfedges[o].face, o, o2, h1);
    own->vertex_halfedge[a] = own->vertex_halfedge[a] == o ? h2 : own->vertex_halfedge[a];
    own->vertex_halfedge[b] = own->vertex_halfedge[b] == h ? o2 : own->vertex_halfedge[b];
    return MT_OK;
}

/* The edge from a to b becomes that from a to the middle, and a new one, whose half-edge `after` follows h. */
static void put_vertex(mt_halfedge_surgery *surgery, mt_index h, mt_index after, mt_index middle)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index o = h ^ 1u, before = after ^ 1u, head = own->halfedges[h].head;
    mt_index previous = mt_halfedge_previous(own, o), right = own->halfedges[o].face;
    own->halfedges[after] = (mt_halfedge){own->halfedges[h].next, head, own->halfedges[h].face};
    own->halfedges[before] = (mt_halfedge){o, middle, right};
    own->halfedges[h].next = after;
    own->halfedges[h].head = middle;
    own->halfedges[previous].next = before;
    if (own->vertex_halfedge[head] == h) {
        own->vertex_halfedge[head] = after;
    }
    own->vertex_halfedge[middle] = right == MT_NONE ? before : h;
    if (right != MT_NONE && own->face_halfedge[right] == o) {
        own->face_halfedge[right] = before;
    }
}

/* Cuts the quadrilateral around the middle, to which `in` points, from it to the opposite corner. The face keeps the
 * triangle of `in`, or that of the half-edge after it. */
static void cut_quadrilateral(mt_halfedge_surgery *surgery, mt_index in, bool keep_in)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index out = own->halfedges[in].next, last = own->halfedges[out].next, rest = own->halfedges[last].next;
    mt_index face = own->halfedges[in].face;
    mt_index cut = mt_halfedge_new_edge(surgery, own->halfedges[in].head, own->halfedges[last].head);
    own->halfedges[last].next = cut ^ 1u;
    own->halfedges[cut ^ 1u].next = out;
    own->halfedges[cut].next = rest;
    own->halfedges[in].next = cut;
    mt_halfedge_new_face(surgery, keep_in ? out : in);
    if (keep_in) {
        mt_halfedge_set_triangle(own, face, in, cut, rest);
    } else {
        mt_halfedge_set_triangle(own, face, out, last, cut ^ 1u);
    }
}

mt_status mt_halfedge_split_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, double weight,
                                 mt_index *vertex)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = mt_halfedge_reserve(context, surgery, 1, 3, 2);
    mt_surgery_view view = mt_halfedge_view(surgery);
    status = status == MT_OK ? mt_surgery_enter_split_edge(context, &view, &surgery->log, halfedge, weight) : status;
    if (status != MT_OK) {
        return status;
    }
    bool cut_left = mt_halfedge_in_triangle(own, halfedge), cut_right = mt_halfedge_in_triangle(own, halfedge ^ 1u);
    mt_index middle = mt_halfedge_new_vertex(surgery);
    mt_index after = mt_halfedge_new_edge(surgery, middle, mt_halfedge_head(own, halfedge));
    put_vertex(surgery, halfedge, after, middle);
    if (cut_left) {
        cut_quadrilateral(surgery, halfedge, true);
    }
    if (cut_right) {
        cut_quadrilateral(surgery, after ^ 1u, false);
    }
    if (vertex) {
        *vertex = middle;
    }
    return MT_OK;
}
