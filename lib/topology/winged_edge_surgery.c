/* The growing copy of winged edges that surgery works on. Cost: amortised O(1) for each new element. */
#include "lib/topology/surgery_room.h"
#include "lib/topology/winged_edit.h"

#include <string.h>

void mt_winged_surgery_destroy(mt_context *context, mt_winged_surgery *surgery)
{
    if (surgery) {
        mt_free(context, surgery->structure.edges);
        mt_free(context, surgery->structure.vertex_edge);
        mt_free(context, surgery->structure.face_edge);
        mt_free(context, surgery->vertex_deleted);
        mt_free(context, surgery->marks);
        mt_edit_log_release(context, &surgery->log);
        mt_free(context, surgery);
    }
}

static mt_status make_vertex_room(mt_context *context, mt_winged_surgery *surgery, uint64_t needed)
{
    mt_surgery_block blocks[3] = {
        {surgery->structure.vertex_edge, sizeof(mt_index)}, {surgery->vertex_deleted, 1}, {surgery->marks, 1}};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->vertex_capacity, blocks, 3);
    surgery->structure.vertex_edge = blocks[0].block;
    surgery->vertex_deleted = blocks[1].block;
    surgery->marks = blocks[2].block;
    return status;
}

static mt_status make_edge_room(mt_context *context, mt_winged_surgery *surgery, uint64_t needed)
{
    if (2 * needed >= MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more sides of edges than an index can number");
    }
    mt_surgery_block block = {surgery->structure.edges, sizeof *surgery->structure.edges};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->edge_capacity, &block, 1);
    surgery->structure.edges = block.block;
    return status;
}

static mt_status make_face_room(mt_context *context, mt_winged_surgery *surgery, uint64_t needed)
{
    mt_surgery_block block = {surgery->structure.face_edge, sizeof(mt_index)};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->face_capacity, &block, 1);
    surgery->structure.face_edge = block.block;
    return status;
}

static mt_status make_room(mt_context *context, mt_winged_surgery *surgery, uint64_t vertices, uint64_t edges,
                           uint64_t faces)
{
    mt_status status = make_vertex_room(context, surgery, vertices);
    status = status == MT_OK ? make_edge_room(context, surgery, edges) : status;
    return status == MT_OK ? make_face_room(context, surgery, faces) : status;
}

mt_status mt_winged_reserve(mt_context *context, mt_winged_surgery *surgery, mt_index vertices, mt_index edges,
                            mt_index faces)
{
    const mt_winged_edge_mesh *own = &surgery->structure;
    return make_room(context, surgery, (uint64_t)own->vertex_count + vertices, (uint64_t)own->edge_count + edges,
                     (uint64_t)own->face_count + faces);
}

mt_status mt_winged_surgery_create(mt_context *context, const mt_winged_edge_mesh *structure, mt_winged_surgery **out)
{
    *out = NULL;
    mt_winged_surgery *surgery = mt_allocate_zeroed(context, sizeof *surgery);
    if (!surgery) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_winged_edge_mesh *own = &surgery->structure;
    mt_status status = make_room(context, surgery, (uint64_t)structure->vertex_count + 1,
                                 (uint64_t)structure->edge_count + 1, (uint64_t)structure->face_count + 1);
    if (status != MT_OK) {
        mt_winged_surgery_destroy(context, surgery);
        return status;
    }
    own->vertex_count = surgery->log.vertex_count = structure->vertex_count;
    own->face_count = surgery->log.face_count = structure->face_count;
    own->edge_count = structure->edge_count;
    memcpy(own->edges, structure->edges, (size_t)own->edge_count * sizeof *own->edges);
    memcpy(own->vertex_edge, structure->vertex_edge, (size_t)own->vertex_count * sizeof(mt_index));
    memcpy(own->face_edge, structure->face_edge, (size_t)own->face_count * sizeof(mt_index));
    memset(surgery->vertex_deleted, 0, own->vertex_count);
    memset(surgery->marks, 0, own->vertex_count);
    *out = surgery;
    return MT_OK;
}

mt_index mt_winged_new_vertex(mt_winged_surgery *surgery)
{
    mt_index vertex = surgery->structure.vertex_count++;
    surgery->structure.vertex_edge[vertex] = MT_NONE;
    surgery->vertex_deleted[vertex] = 0;
    surgery->marks[vertex] = 0;
    return vertex;
}

mt_index mt_winged_new_edge(mt_winged_surgery *surgery, mt_index tail, mt_index head)
{
    mt_index edge = surgery->structure.edge_count++;
    surgery->structure.edges[edge] = (mt_winged_edge){head, tail, MT_NONE, MT_NONE, MT_NONE, MT_NONE, MT_NONE, MT_NONE};
    return 2 * edge;
}

mt_index mt_winged_new_face(mt_winged_surgery *surgery)
{
    return surgery->structure.face_count++;
}

void mt_winged_delete_edge(mt_winged_surgery *surgery, mt_index edge)
{
    memset(&surgery->structure.edges[edge], 0xff, sizeof surgery->structure.edges[edge]);
}

void mt_winged_set_triangle(mt_winged_edge_mesh *own, mt_index face, mt_index a, mt_index b, mt_index c)
{
    winged_side_link(own, a, b);
    winged_side_link(own, b, c);
    winged_side_link(own, c, a);
    winged_side_set_face(own, a, face);
    winged_side_set_face(own, b, face);
    winged_side_set_face(own, c, face);
    own->face_edge[face] = a >> 1;
}

void mt_winged_anchor(mt_winged_edge_mesh *own, mt_index side)
{
    mt_index at = side;
    while (winged_side_face(own, at) != MT_NONE) {
        at = winged_side_clockwise(own, at);
        if (at == side) {
            break;
        }
    }
    own->vertex_edge[winged_side_head(own, side)] = at >> 1;
}
