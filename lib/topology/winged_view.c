/* Winged edges as surgery reads them, and the predicates. */
#include "lib/topology/winged_edit.h"

static mt_index next_side(const void *structure, mt_index side)
{
    return winged_side_next(structure, side);
}

static mt_index side_head(const void *structure, mt_index side)
{
    return winged_side_head(structure, side);
}

static mt_index side_face(const void *structure, mt_index side)
{
    return winged_side_face(structure, side);
}

static mt_index vertex_side(const void *structure, mt_index vertex)
{
    const mt_winged_edge_mesh *own = structure;
    mt_index edge = own->vertex_edge[vertex];
    return edge == MT_NONE ? MT_NONE : 2 * edge + (own->edges[edge].head != vertex);
}

static mt_index face_side(const void *structure, mt_index face)
{
    const mt_winged_edge_mesh *own = structure;
    mt_index edge = own->face_edge[face];
    return edge == MT_NONE ? MT_NONE : 2 * edge + (own->edges[edge].left != face);
}

mt_surgery_view mt_winged_view(const mt_winged_surgery *surgery)
{
    const mt_winged_edge_mesh *own = &surgery->structure;
    return (mt_surgery_view){.structure = own,
                             .vertex_count = own->vertex_count,
                             .face_count = own->face_count,
                             .side_count = 2 * own->edge_count,
                             .next = next_side,
                             .head = side_head,
                             .face = side_face,
                             .vertex_side = vertex_side,
                             .face_side = face_side,
                             .vertex_deleted = surgery->vertex_deleted,
                             .marks = surgery->marks};
}

mt_index mt_winged_side_from(const mt_winged_surgery *surgery, mt_index edge, mt_index tail)
{
    const mt_winged_edge_mesh *own = &surgery->structure;
    if (edge >= own->edge_count || tail >= own->vertex_count) {
        return 2 * own->edge_count;
    }
    const mt_winged_edge *at = &own->edges[edge];
    return at->tail == tail ? 2 * edge : at->head == tail ? 2 * edge + 1 : 2 * own->edge_count;
}

mt_index mt_winged_surgery_find(const mt_winged_surgery *surgery, mt_index vertex, mt_index other)
{
    mt_surgery_view view = mt_winged_view(surgery);
    mt_index side = mt_surgery_find_side(&view, vertex, other);
    return side == MT_NONE ? MT_NONE : side >> 1;
}

mt_surgery_verdict mt_winged_can_swap_edge(const mt_winged_surgery *surgery, mt_index edge)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_swap(&view, edge);
}

mt_surgery_verdict mt_winged_can_split_edge(const mt_winged_surgery *surgery, mt_index edge, mt_index tail)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_split_edge(&view, mt_winged_side_from(surgery, edge, tail));
}

mt_surgery_verdict mt_winged_can_collapse_edge(const mt_winged_surgery *surgery, mt_index edge, mt_index tail)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_collapse(&view, mt_winged_side_from(surgery, edge, tail));
}

mt_surgery_verdict mt_winged_can_remove_face(const mt_winged_surgery *surgery, mt_index face)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_remove_face(&view, face);
}

mt_surgery_verdict mt_winged_can_add_face(const mt_winged_surgery *surgery, mt_index count, const mt_index *vertices)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_judge_add_face(&view, count, vertices);
}
