/* Triangle neighbours as surgery reads them, and the predicates. */
#include "lib/topology/triangle_edit.h"

static mt_index next_side(const void *structure, mt_index side)
{
    return triangle_side_next(structure, side);
}

static mt_index side_head(const void *structure, mt_index side)
{
    return triangle_side_head(structure, side);
}

static mt_index side_face(const void *structure, mt_index side)
{
    return mt_triangle_of_corner(triangle_side_corner(structure, side));
}

static mt_index vertex_side(const void *structure, mt_index vertex)
{
    const mt_triangle_neighbor_mesh *own = structure;
    mt_index corner = own->vertex_corner[vertex];
    return corner == MT_NONE ? MT_NONE : triangle_side(own, corner) ^ 1u;
}

static mt_index face_side(const void *structure, mt_index face)
{
    const mt_triangle_neighbor_mesh *own = structure;
    return own->vertices[3 * face] == MT_NONE ? MT_NONE : triangle_side(own, 3 * face);
}

mt_surgery_view mt_triangle_view(const mt_triangle_surgery *surgery)
{
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    return (mt_surgery_view){.structure = own,
                             .vertex_count = own->vertex_count,
                             .face_count = own->triangle_count,
                             .side_count = 6 * own->triangle_count,
                             .triangles_only = true,
                             .next = next_side,
                             .head = side_head,
                             .face = side_face,
                             .vertex_side = vertex_side,
                             .face_side = face_side,
                             .vertex_deleted = surgery->vertex_deleted,
                             .marks = surgery->marks};
}

mt_index mt_triangle_side_from(const mt_triangle_surgery *surgery, mt_index corner, mt_index tail)
{
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index none = 6 * own->triangle_count;
    if (corner >= 3 * own->triangle_count || tail >= own->vertex_count) {
        return none;
    }
    if (own->vertices[corner] == tail) {
        return triangle_side(own, corner);
    }
    return own->vertices[mt_triangle_next_corner(corner)] == tail ? triangle_side(own, corner) ^ 1u : none;
}

mt_index mt_triangle_surgery_find(const mt_triangle_surgery *surgery, mt_index tail, mt_index head)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    mt_index side = mt_surgery_find_side(&view, tail, head);
    if (side == MT_NONE) {
        return MT_NONE;
    }
    mt_index corner = triangle_side_corner(&surgery->structure, side);
    return corner != MT_NONE ? corner : side >> 1;
}

mt_surgery_verdict mt_triangle_can_swap_edge(const mt_triangle_surgery *surgery, mt_index side)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    bool exists = side < 3 * view.face_count && surgery->structure.vertices[side] != MT_NONE;
    return mt_surgery_judge_swap(&view, exists ? triangle_side(&surgery->structure, side) >> 1 : MT_NONE);
}

mt_surgery_verdict mt_triangle_can_split_edge(const mt_triangle_surgery *surgery, mt_index side, mt_index tail)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_judge_split_edge(&view, mt_triangle_side_from(surgery, side, tail));
}

mt_surgery_verdict mt_triangle_can_split_vertex(const mt_triangle_surgery *surgery, mt_index vertex, mt_index from,
                                                mt_index to)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_judge_split_vertex(&view, vertex,
                                         from == MT_NONE ? MT_NONE : mt_triangle_side_from(surgery, from, vertex) ^ 1u,
                                         to == MT_NONE ? MT_NONE : mt_triangle_side_from(surgery, to, vertex) ^ 1u);
}

mt_surgery_verdict mt_triangle_can_collapse_edge(const mt_triangle_surgery *surgery, mt_index side, mt_index tail)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_judge_collapse(&view, mt_triangle_side_from(surgery, side, tail));
}

mt_surgery_verdict mt_triangle_can_remove_face(const mt_triangle_surgery *surgery, mt_index triangle)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_judge_remove_face(&view, triangle);
}

mt_surgery_verdict mt_triangle_can_add_face(const mt_triangle_surgery *surgery, mt_index count,
                                            const mt_index *vertices)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_judge_add_face(&view, count, vertices);
}
