/* Removing and adding faces. The invariant: a vertex on the boundary has one gap in its fan, whose half-edge towards it
 * the vertex keeps, and whose next leaves it. Cost: O(sides) to remove, O(valences) to add. */
#include "lib/topology/edit_entries.h"
#include "lib/topology/halfedge_edit.h"

/* Takes the face out of the fan of the vertex between two of its sides, and links the boundary past it. */
static void leave_vertex(mt_halfedge_mesh *own, mt_index in, mt_index out)
{
    mt_index vertex = own->halfedges[in].head;
    bool in_alone = mt_halfedge_is_boundary(own, in ^ 1u), out_alone = mt_halfedge_is_boundary(own, out ^ 1u);
    if (in_alone && out_alone) {
        own->vertex_halfedge[vertex] = MT_NONE;
    } else if (in_alone) {
        own->halfedges[own->vertex_halfedge[vertex]].next = out;
    } else {
        own->halfedges[in].next = out_alone ? own->halfedges[out ^ 1u].next : out;
        own->vertex_halfedge[vertex] = in;
    }
}

/* A side without its face: the edge is deleted when there is none across either. */
static void leave_side(mt_halfedge_surgery *surgery, mt_index side)
{
    surgery->structure.halfedges[side].face = MT_NONE;
    if (mt_halfedge_is_boundary(&surgery->structure, side ^ 1u)) {
        mt_halfedge_delete_edge(surgery, side);
    }
}

mt_status mt_halfedge_remove_face(mt_context *context, mt_halfedge_surgery *surgery, mt_index face)
{
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_remove_face(surgery, face), 0);
    if (status != MT_OK) {
        return status;
    }
    mt_index begin = own->face_halfedge[face], in = begin;
    do {
        mt_index out = own->halfedges[in].next;
        leave_vertex(own, in, out);
        if (in != begin) {
            leave_side(surgery, in);
        }
        in = out;
    } while (in != begin);
    leave_side(surgery, begin);
    own->face_halfedge[face] = MT_NONE;
    return MT_OK;
}

static mt_index find_side(const mt_halfedge_surgery *surgery, mt_index count, const mt_index *vertices, mt_index i)
{
    return mt_halfedge_surgery_find(surgery, vertices[i], vertices[i + 1 < count ? i + 1 : 0]);
}

/* Puts the face into the fan of the vertex between two of its sides, and links the boundary past it. */
static void enter_vertex(mt_halfedge_mesh *own, mt_index vertex, mt_index in, mt_index out, bool in_is_new,
                         bool out_is_new)
{
    mt_index gap = own->vertex_halfedge[vertex];
    if (in_is_new && out_is_new) {
        own->halfedges[out ^ 1u].next = in ^ 1u;
        own->vertex_halfedge[vertex] = out ^ 1u;
    } else if (in_is_new) {
        own->halfedges[gap].next = in ^ 1u;
    } else if (out_is_new) {
        own->halfedges[out ^ 1u].next = own->halfedges[in].next;
        own->vertex_halfedge[vertex] = out ^ 1u;
    }
    own->halfedges[in].next = out;
}

/* Joins the vertices; sides[i] runs from vertex i to the next one. */
static void enter_sides(mt_halfedge_surgery *surgery, mt_index count, const mt_index *vertices, mt_index *sides)
{
    mt_index first_new = surgery->structure.halfedge_count;
    for (mt_index i = 0; i < count; i++) {
        sides[i] = find_side(surgery, count, vertices, i);
    }
    for (mt_index i = 0; i < count; i++) {
        if (sides[i] == MT_NONE) {
            sides[i] = mt_halfedge_new_edge(surgery, vertices[i], vertices[i + 1 < count ? i + 1 : 0]);
        }
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index in = sides[i], out = sides[i + 1 < count ? i + 1 : 0];
        enter_vertex(&surgery->structure, vertices[i + 1 < count ? i + 1 : 0], in, out, in >= first_new,
                     out >= first_new);
    }
}

mt_status mt_halfedge_add_face(mt_context *context, mt_halfedge_surgery *surgery, mt_index count,
                               const mt_index *vertices, mt_index *face)
{
    mt_status status = mt_surgery_expect(context, mt_halfedge_can_add_face(surgery, count, vertices), 0);
    status = status == MT_OK ? mt_halfedge_reserve(context, surgery, 0, count, 1) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_index *sides = mt_allocate_array(context, count, sizeof *sides);
    if (!sides) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    enter_sides(surgery, count, vertices, sides);
    mt_index added = mt_halfedge_new_face(surgery, sides[0]);
    mt_free(context, sides);
    if (face) {
        *face = added;
    }
    return MT_OK;
}
