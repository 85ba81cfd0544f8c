/* Removing and adding faces of the winged-edge structure, and the boundary that opens or closes with them. The
 * invariant: after each operation every invariant of the structure holds among what is not deleted. Cost: O(sides), and
 * O(valences) to find the sides of a new face. */
#include "lib/topology/edit_entries.h"
#include "lib/topology/winged_edit.h"

/* The face's sides `in` and `out` meet in a vertex; those that had a face on their other side now bound the hole. */
static void open_corner(mt_winged_edge_mesh *own, mt_index in, mt_index out)
{
    mt_index vertex = winged_side_tail(own, out);
    bool keeps_in = winged_side_face(own, in ^ 1u) != MT_NONE, keeps_out = winged_side_face(own, out ^ 1u) != MT_NONE;
    if (!keeps_in && !keeps_out) {
        own->vertex_edge[vertex] = MT_NONE;
        return;
    }
    mt_index before = keeps_in ? in : winged_side_previous(own, in ^ 1u);
    mt_index after = keeps_out ? out : winged_side_next(own, out ^ 1u);
    winged_side_link(own, before, after);
    own->vertex_edge[vertex] = before >> 1;
}

static void leave_face(mt_winged_surgery *surgery, mt_index side)
{
    winged_side_set_face(&surgery->structure, side, MT_NONE);
    if (winged_side_face(&surgery->structure, side ^ 1u) == MT_NONE) {
        mt_winged_delete_edge(surgery, side >> 1);
    }
}

mt_status mt_winged_remove_face(mt_context *context, mt_winged_surgery *surgery, mt_index face)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_surgery_view view = mt_winged_view(surgery);
    mt_status status = mt_surgery_expect(context, mt_surgery_judge_remove_face(&view, face), 0);
    if (status != MT_OK) {
        return status;
    }
    mt_index begin = view.face_side(own, face), side = begin;
    do {
        mt_index next = winged_side_next(own, side);
        open_corner(own, side, next);
        if (side != begin) {
            leave_face(surgery, side);
        }
        side = next;
    } while (side != begin);
    leave_face(surgery, begin);
    own->face_edge[face] = MT_NONE;
    return MT_OK;
}

/* The new face's sides `in` and `out` meet in a vertex. Those that are new bound the outside with their twins; those
 * that bounded it do so no more. */
static void close_corner(mt_winged_edge_mesh *own, mt_index in, bool in_is_new, mt_index out, bool out_is_new)
{
    mt_index vertex = winged_side_tail(own, out);
    if (in_is_new || out_is_new) {
        mt_index before = out_is_new ? out ^ 1u : winged_side_previous(own, out);
        mt_index after = in_is_new ? in ^ 1u : winged_side_next(own, in);
        winged_side_link(own, before, after);
        own->vertex_edge[vertex] = before >> 1;
    }
    winged_side_link(own, in, out);
}

static void add_face(mt_winged_surgery *surgery, mt_index count, const mt_index *vertices, mt_index *sides)
{
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_surgery_view view = mt_winged_view(surgery);
    mt_index first_new = own->edge_count, face = mt_winged_new_face(surgery);
    for (mt_index i = 0; i < count; i++) {
        mt_index head = vertices[(i + 1) % count];
        mt_index side = mt_surgery_find_side(&view, vertices[i], head);
        sides[i] = side != MT_NONE ? side : mt_winged_new_edge(surgery, vertices[i], head);
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index in = sides[(i + count - 1) % count], out = sides[i];
        close_corner(own, in, in >> 1 >= first_new, out, out >> 1 >= first_new);
    }
    for (mt_index i = 0; i < count; i++) {
        winged_side_set_face(own, sides[i], face);
    }
    own->face_edge[face] = sides[0] >> 1;
}

mt_status mt_winged_add_face(mt_context *context, mt_winged_surgery *surgery, mt_index count, const mt_index *vertices,
                             mt_index *face)
{
    mt_status status = mt_surgery_expect(context, mt_winged_can_add_face(surgery, count, vertices), 0);
    status = status == MT_OK ? mt_winged_reserve(context, surgery, 0, count, 1) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_index *sides = mt_allocate_array(context, count, sizeof *sides);
    if (!sides) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    add_face(surgery, count, vertices, sides);
    mt_free(context, sides);
    if (face) {
        *face = surgery->structure.face_count - 1;
    }
    return MT_OK;
}
