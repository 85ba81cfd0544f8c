/* Half-edges as surgery reads them, and the predicates. */
#include "lib/topology/halfedge_edit.h"

static mt_index next_side(const void *structure, mt_index side)
{
    return mt_halfedge_next(structure, side);
}

static mt_index side_head(const void *structure, mt_index side)
{
    return mt_halfedge_head(structure, side);
}

static mt_index side_face(const void *structure, mt_index side)
{
    return mt_halfedge_face(structure, side);
}

static mt_index vertex_side(const void *structure, mt_index vertex)
{
    return ((const mt_halfedge_mesh *)structure)->vertex_halfedge[vertex];
}

static mt_index face_side(const void *structure, mt_index face)
{
    return ((const mt_halfedge_mesh *)structure)->face_halfedge[face];
}

mt_surgery_view mt_halfedge_view(const mt_halfedge_surgery *surgery)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    return (mt_surgery_view){.structure = own,
                             .vertex_count = own->vertex_count,
                             .face_count = own->face_count,
                             .side_count = own->halfedge_count,
                             .next = next_side,
                             .head = side_head,
                             .face = side_face,
                             .vertex_side = vertex_side,
                             .face_side = face_side,
                             .vertex_deleted = surgery->vertex_deleted,
                             .marks = surgery->marks};
}

mt_index mt_halfedge_surgery_find(const mt_halfedge_surgery *surgery, mt_index tail, mt_index head)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_find_side(&view, tail, head);
}

mt_surgery_verdict mt_halfedge_can_swap_edge(const mt_halfedge_surgery *surgery, mt_index edge)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_swap(&view, edge);
}

mt_surgery_verdict mt_halfedge_can_split_edge(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_split_edge(&view, halfedge);
}

mt_surgery_verdict mt_halfedge_can_split_vertex(const mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                                mt_index to)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_split_vertex(&view, vertex, from, to);
}

mt_surgery_verdict mt_halfedge_can_collapse_edge(const mt_halfedge_surgery *surgery, mt_index halfedge)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_collapse(&view, halfedge);
}

mt_surgery_verdict mt_halfedge_can_remove_face(const mt_halfedge_surgery *surgery, mt_index face)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_remove_face(&view, face);
}

mt_surgery_verdict mt_halfedge_can_add_face(const mt_halfedge_surgery *surgery, mt_index count,
                                            const mt_index *vertices)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_judge_add_face(&view, count, vertices);
}
