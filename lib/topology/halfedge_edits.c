/* Swapping and splitting edges. The invariant: after each operation every invariant of the half-edge structure holds
 * among what is not deleted. Cost: O(valence) to swap, O(sides) to split. */
#include "lib/topology/edit_entries.h"
#include "lib/topology/halfedge_edit.h"

mt_surgery_verdict mt_halfedge_can_swap_edge(const mt_halfedge_surgery *surgery, mt_index edge)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = 2 * edge;
    if (edge >= own->halfedge_count / 2 || !mt_halfedge_is_alive(surgery, h)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    if (mt_halfedge_edge_is_boundary(own, edge)) {
        return MT_SURGERY_BOUNDARY_EDGE;
    }
    if (!mt_halfedge_in_triangle(own, h) || !mt_halfedge_in_triangle(own, h ^ 1u)) {
        return MT_SURGERY_NOT_TRIANGLES;
    }
    mt_index c = mt_halfedge_head(own, mt_halfedge_next(own, h));
    mt_index d = mt_halfedge_head(own, mt_halfedge_next(own, h ^ 1u));
    bool exists = c == d || mt_halfedge_surgery_find(surgery, c, d) != MT_NONE;
    return exists ? MT_SURGERY_EDGE_EXISTS : MT_SURGERY_ALLOWED;
}

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
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_swap_edge(surgery, edge), 0);
    status = status == MT_OK ? mt_halfedge_reserve(context, surgery, 0, 0, 0, MT_EDIT_SWAP_COUNT) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = 2 * edge, o = h ^ 1u;
    mt_index h1 = own->halfedges[h].next, h2 = own->halfedges[h1].next;
    mt_index o1 = own->halfedges[o].next, o2 = own->halfedges[o1].next;
    mt_index a = own->halfedges[o].head, b = own->halfedges[h].head;
    mt_index c = own->halfedges[h1].head, d = own->halfedges[o1].head;
    mt_edit_swap(&surgery->log, own->halfedges[h].face, own->halfedges[o].face, (const mt_index[]){a, b, c, d});
    own->halfedges[h].head = c;
    own->halfedges[o].head = d;
    mt_halfedge_set_triangle(own, own->halfedges[h].face, h, h2, o1);
    mt_halfedge_set_triangle(own, own->halfedges[o].face, o, o2, h1);
    own->vertex_halfedge[a] = own->vertex_halfedge[a] == o ? h2 : own->vertex_halfedge[a];
    own->vertex_halfedge[b] = own->vertex_halfedge[b] == h ? o2 : own->vertex_halfedge[b];
    return MT_OK;
}

mt_surgery_verdict mt_halfedge_can_split_edge(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    if (!mt_halfedge_is_alive(surgery, halfedge)) {
        return MT_SURGERY_NO_ELEMENT;
    }
    bool are_triangles = mt_halfedge_in_triangle(own, halfedge) && mt_halfedge_in_triangle(own, halfedge ^ 1u);
    mt_index opposite = mt_halfedge_head(own, mt_halfedge_next(own, halfedge));
    bool lie_back_to_back = are_triangles && mt_halfedge_head(own, mt_halfedge_next(own, halfedge ^ 1u)) == opposite;
    return lie_back_to_back ? MT_SURGERY_DUPLICATE_FACE : MT_SURGERY_ALLOWED;
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
 * triangle of `in`, or that of the half-edge after it; returns the new face. */
static mt_index cut_quadrilateral(mt_halfedge_surgery *surgery, mt_index in, bool keep_in)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index out = own->halfedges[in].next, last = own->halfedges[out].next, rest = own->halfedges[last].next;
    mt_index face = own->halfedges[in].face;
    mt_index cut = mt_halfedge_new_edge(surgery, own->halfedges[in].head, own->halfedges[last].head);
    own->halfedges[last].next = cut ^ 1u;
    own->halfedges[cut ^ 1u].next = out;
    own->halfedges[cut].next = rest;
    own->halfedges[in].next = cut;
    mt_index other = mt_halfedge_new_face(surgery, keep_in ? out : in);
    if (keep_in) {
        mt_halfedge_set_triangle(own, face, in, cut, rest);
    } else {
        mt_halfedge_set_triangle(own, face, out, last, cut ^ 1u);
    }
    return other;
}

static mt_index third_vertex(const mt_halfedge_mesh *own, mt_index h)
{
    return mt_halfedge_head(own, mt_halfedge_next(own, h));
}

mt_status mt_halfedge_split_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, double weight,
                                 mt_index *vertex)
{
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_split_edge(surgery, halfedge), weight);
    uint64_t edits = MT_EDIT_SPLIT_EDGE_COUNT + 2 * MT_EDIT_SPLIT_SIDE_COUNT;
    status = status == MT_OK ? mt_halfedge_reserve(context, surgery, 1, 3, 2, edits) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_index h = halfedge, o = h ^ 1u, a = mt_halfedge_tail(own, h), b = mt_halfedge_head(own, h);
    mt_index left = mt_halfedge_face(own, h), right = mt_halfedge_face(own, o);
    bool cut_left = mt_halfedge_in_triangle(own, h), cut_right = mt_halfedge_in_triangle(own, o);
    mt_index c = third_vertex(own, h), d = third_vertex(own, o);
    mt_index middle = mt_halfedge_new_vertex(surgery);
    mt_index after = mt_halfedge_new_edge(surgery, middle, b);
    put_vertex(surgery, h, after, middle);
    mt_index left_other = cut_left ? cut_quadrilateral(surgery, h, true) : MT_NONE;
    mt_index right_other = cut_right ? cut_quadrilateral(surgery, after ^ 1u, false) : MT_NONE;
    mt_edit_split_edge(&surgery->log, a, b, middle, weight);
    if (left != MT_NONE) {
        mt_edit_split_side(&surgery->log, left, left_other, (const mt_index[]){a, b, c}, middle, weight);
    }
    if (right != MT_NONE) {
        mt_edit_split_side(&surgery->log, right, right_other, (const mt_index[]){a, b, d}, middle, weight);
    }
    if (vertex) {
        *vertex = middle;
    }
    return MT_OK;
}
