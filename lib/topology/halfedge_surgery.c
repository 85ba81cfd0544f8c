/* The growing copy that surgery works on. Cost: amortised O(1) for each new element. */
#include "lib/topology/halfedge_edit.h"
#include "lib/topology/surgery_room.h"

#include <string.h>

void mt_halfedge_surgery_destroy(mt_context *context, mt_halfedge_surgery *surgery)
{
    if (surgery) {
        mt_free(context, surgery->structure.halfedges);
        mt_free(context, surgery->structure.vertex_halfedge);
        mt_free(context, surgery->structure.face_halfedge);
        mt_free(context, surgery->vertex_deleted);
        mt_free(context, surgery->marks);
        mt_edit_log_release(context, &surgery->log);
        mt_free(context, surgery);
    }
}

static mt_status make_vertex_room(mt_context *context, mt_halfedge_surgery *surgery, uint64_t needed)
{
    mt_surgery_block blocks[3] = {
        {surgery->structure.vertex_halfedge, sizeof(mt_index)}, {surgery->vertex_deleted, 1}, {surgery->marks, 1}};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->vertex_capacity, blocks, 3);
    surgery->structure.vertex_halfedge = blocks[0].block;
    surgery->vertex_deleted = blocks[1].block;
    surgery->marks = blocks[2].block;
    return status;
}

static mt_status make_room(mt_context *context, mt_halfedge_surgery *surgery, uint64_t vertices, uint64_t halfedges,
                           uint64_t faces)
{
    mt_surgery_block halfedge_block = {surgery->structure.halfedges, sizeof *surgery->structure.halfedges};
    mt_surgery_block face_block = {surgery->structure.face_halfedge, sizeof(mt_index)};
    mt_status status = make_vertex_room(context, surgery, vertices);
    if (status == MT_OK) {
        status = mt_surgery_make_room(context, halfedges, &surgery->halfedge_capacity, &halfedge_block, 1);
        surgery->structure.halfedges = halfedge_block.block;
    }
    if (status == MT_OK) {
        status = mt_surgery_make_room(context, faces, &surgery->face_capacity, &face_block, 1);
        surgery->structure.face_halfedge = face_block.block;
    }
    return status;
}

mt_status mt_halfedge_reserve(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertices, mt_index edges,
                              mt_index faces)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    return make_room(context, surgery, (uint64_t)own->vertex_count + vertices,
                     (uint64_t)own->halfedge_count + 2 * (uint64_t)edges, (uint64_t)own->face_count + faces);
}

mt_status mt_halfedge_surgery_create(mt_context *context, const mt_halfedge_mesh *structure, mt_halfedge_surgery **out)
{
    *out = NULL;
    mt_halfedge_surgery *surgery = mt_allocate_zeroed(context, sizeof *surgery);
    if (!surgery) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = make_room(context, surgery, (uint64_t)structure->vertex_count + 1,
                                 (uint64_t)structure->halfedge_count + 2, (uint64_t)structure->face_count + 1);
    if (status != MT_OK) {
        mt_halfedge_surgery_destroy(context, surgery);
        return status;
    }
    own->vertex_count = structure->vertex_count;
    own->face_count = structure->face_count;
    own->halfedge_count = structure->halfedge_count;
    surgery->log.vertex_count = structure->vertex_count;
    surgery->log.face_count = structure->face_count;
    memcpy(own->halfedges, structure->halfedges, (size_t)own->halfedge_count * sizeof *own->halfedges);
    memcpy(own->vertex_halfedge, structure->vertex_halfedge, (size_t)own->vertex_count * sizeof(mt_index));
    memcpy(own->face_halfedge, structure->face_halfedge, (size_t)own->face_count * sizeof(mt_index));
    memset(surgery->vertex_deleted, 0, own->vertex_count);
    memset(surgery->marks, 0, own->vertex_count);
    *out = surgery;
    return MT_OK;
}

mt_index mt_halfedge_new_vertex(mt_halfedge_surgery *surgery)
{
    mt_index vertex = surgery->structure.vertex_count++;
    surgery->structure.vertex_halfedge[vertex] = MT_NONE;
    surgery->vertex_deleted[vertex] = 0;
    surgery->marks[vertex] = 0;
    return vertex;
}

mt_index mt_halfedge_new_edge(mt_halfedge_surgery *surgery, mt_index tail, mt_index head)
{
    mt_index halfedge = surgery->structure.halfedge_count;
    surgery->structure.halfedge_count += 2;
    surgery->structure.halfedges[halfedge] = (mt_halfedge){MT_NONE, head, MT_NONE};
    surgery->structure.halfedges[halfedge + 1] = (mt_halfedge){MT_NONE, tail, MT_NONE};
    return halfedge;
}

mt_index mt_halfedge_new_face(mt_halfedge_surgery *surgery, mt_index halfedge)
{
    mt_index face = surgery->structure.face_count++;
    surgery->structure.face_halfedge[face] = halfedge;
    mt_index h = halfedge;
    do {
        surgery->structure.halfedges[h].face = face;
        h = surgery->structure.halfedges[h].next;
    } while (h != halfedge);
    return face;
}

void mt_halfedge_delete_edge(mt_halfedge_surgery *surgery, mt_index halfedge)
{
    const mt_halfedge nothing = {MT_NONE, MT_NONE, MT_NONE};
    surgery->structure.halfedges[halfedge] = nothing;
    surgery->structure.halfedges[halfedge ^ 1u] = nothing;
}

void mt_halfedge_anchor(mt_halfedge_mesh *structure, mt_index halfedge)
{
    mt_index h = halfedge;
    while (!mt_halfedge_is_boundary(structure, h)) {
        h = mt_halfedge_clockwise(structure, h);
        if (h == halfedge) {
            break;
        }
    }
    structure->vertex_halfedge[mt_halfedge_head(structure, halfedge)] = h;
}
