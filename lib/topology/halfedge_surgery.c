/* The growing copy that surgery works on. Cost: amortised O(1) for each new element. */
#include "lib/topology/halfedge_edit.h"

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

static bool grow(mt_context *context, void **block, uint64_t capacity, size_t size)
{
    void *grown = mt_reallocate(context, *block, capacity * size);
    *block = grown ? grown : *block;
    return grown != NULL;
}

static uint64_t wider(uint64_t capacity, uint64_t needed)
{
    return needed <= capacity ? capacity : needed + needed / 2;
}

static mt_status reserve(mt_context *context, mt_halfedge_surgery *surgery, uint64_t vertices, uint64_t halfedges,
                         uint64_t faces)
{
    if (vertices > MT_INDEX_MAX || halfedges > MT_INDEX_MAX || faces > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more elements than an index can number");
    }
    mt_halfedge_mesh *structure = &surgery->structure;
    uint64_t vertex_room = wider(surgery->vertex_capacity, vertices);
    uint64_t halfedge_room = wider(surgery->halfedge_capacity, halfedges);
    uint64_t face_room = wider(surgery->face_capacity, faces);
    void *grown[] = {structure->vertex_halfedge, surgery->vertex_deleted, surgery->marks, structure->halfedges,
                     structure->face_halfedge};
    bool fits = true;
    if (vertex_room > surgery->vertex_capacity) {
        fits = grow(context, &grown[0], vertex_room, sizeof(mt_index)) && grow(context, &grown[1], vertex_room, 1) &&
               grow(context, &grown[2], vertex_room, 1);
    }
    fits = fits && (halfedge_room == surgery->halfedge_capacity ||
                    grow(context, &grown[3], halfedge_room, sizeof *structure->halfedges));
    fits = fits && (face_room == surgery->face_capacity || grow(context, &grown[4], face_room, sizeof(mt_index)));
    structure->vertex_halfedge = grown[0];
    surgery->vertex_deleted = grown[1];
    surgery->marks = grown[2];
    structure->halfedges = grown[3];
    structure->face_halfedge = grown[4];
    if (!fits) {
        return mt_context_error(context)->status;
    }
    surgery->vertex_capacity = vertex_room;
    surgery->halfedge_capacity = halfedge_room;
    surgery->face_capacity = face_room;
    return MT_OK;
}

mt_status mt_halfedge_reserve(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertices, mt_index edges,
                              mt_index faces, uint64_t edits)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = reserve(context, surgery, (uint64_t)own->vertex_count + vertices,
                               (uint64_t)own->halfedge_count + 2 * (uint64_t)edges, (uint64_t)own->face_count + faces);
    return status == MT_OK ? mt_edit_log_reserve(context, &surgery->log, edits) : status;
}

mt_status mt_halfedge_surgery_create(mt_context *context, const mt_halfedge_mesh *structure, mt_halfedge_surgery **out)
{
    *out = NULL;
    mt_halfedge_surgery *surgery = mt_allocate_zeroed(context, sizeof *surgery);
    if (!surgery) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_halfedge_mesh *own = &surgery->structure;
    mt_status status = reserve(context, surgery, (uint64_t)structure->vertex_count + 1,
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

mt_index mt_halfedge_surgery_find(const mt_halfedge_surgery *surgery, mt_index tail, mt_index head)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    if (tail >= own->vertex_count || head >= own->vertex_count) {
        return MT_NONE;
    }
    mt_index begin = own->vertex_halfedge[head], h = begin;
    while (h != MT_NONE && mt_halfedge_tail(own, h) != tail) {
        h = mt_halfedge_clockwise(own, h);
        h = h == begin ? MT_NONE : h;
    }
    return h;
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
