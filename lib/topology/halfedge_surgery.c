/* The growing copy that surgery works on, and its compaction. Cost: amortised O(1) for each new element. */
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

mt_status mt_halfedge_prepare(mt_context *context, mt_halfedge_surgery *surgery, mt_surgery_verdict verdict,
                              mt_index vertices, mt_index edges, mt_index faces, uint64_t edits)
{
    if (verdict != MT_SURGERY_ALLOWED) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the mesh cannot be changed so: %s",
                       mt_surgery_verdict_words(verdict));
    }
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

mt_index mt_halfedge_find(const mt_halfedge_mesh *structure, mt_index tail, mt_index head)
{
    mt_index begin = structure->vertex_halfedge[head], h = begin;
    while (h != MT_NONE && mt_halfedge_tail(structure, h) != tail) {
        h = mt_halfedge_clockwise(structure, h);
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

void mt_halfedge_copy_corner(mt_halfedge_surgery *surgery, mt_index target, mt_index parent)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    mt_index from = mt_halfedge_is_boundary(own, parent) ? mt_halfedge_next(own, parent ^ 1u) : parent;
    mt_edit_log_add(&surgery->log, MT_DOMAIN_CORNER, target, from, from, 0);
}

void mt_surgery_map_release(mt_context *context, mt_surgery_map *map)
{
    mt_free(context, map->vertices);
    mt_free(context, map->edges);
    mt_free(context, map->faces);
    *map = (mt_surgery_map){0};
}

static mt_status number_elements(mt_context *context, const mt_halfedge_surgery *surgery, mt_surgery_map *map,
                                 mt_halfedge_mesh *out)
{
    const mt_halfedge_mesh *own = &surgery->structure;
    map->vertices = mt_allocate_array(context, own->vertex_count, sizeof(mt_index));
    map->edges = mt_allocate_array(context, own->halfedge_count / 2, sizeof(mt_index));
    map->faces = mt_allocate_array(context, own->face_count, sizeof(mt_index));
    if (!map->vertices || !map->edges || !map->faces) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < own->vertex_count; i++) {
        map->vertices[i] = surgery->vertex_deleted[i] ? MT_NONE : out->vertex_count++;
    }
    for (mt_index i = 0; i < own->halfedge_count / 2; i++) {
        map->edges[i] = own->halfedges[2 * i].head == MT_NONE ? MT_NONE : out->halfedge_count++;
    }
    for (mt_index i = 0; i < own->face_count; i++) {
        map->faces[i] = own->face_halfedge[i] == MT_NONE ? MT_NONE : out->face_count++;
    }
    out->halfedge_count *= 2;
    return MT_OK;
}

static mt_index renumber(const mt_surgery_map *map, mt_index halfedge)
{
    return halfedge == MT_NONE ? MT_NONE : 2 * map->edges[halfedge >> 1] + (halfedge & 1u);
}

static mt_status copy_elements(mt_context *context, const mt_halfedge_mesh *own, const mt_surgery_map *map,
                               mt_halfedge_mesh *out)
{
    out->halfedges = mt_allocate_array(context, out->halfedge_count, sizeof *out->halfedges);
    out->vertex_halfedge = mt_allocate_array(context, out->vertex_count, sizeof(mt_index));
    out->face_halfedge = mt_allocate_array(context, out->face_count, sizeof(mt_index));
    if (!out->halfedges || !out->vertex_halfedge || !out->face_halfedge) {
        return mt_context_error(context)->status;
    }
    for (mt_index h = 0; h < own->halfedge_count; h++) {
        mt_halfedge from = own->halfedges[h];
        if (from.head != MT_NONE) {
            out->halfedges[renumber(map, h)] = (mt_halfedge){renumber(map, from.next), map->vertices[from.head],
                                                             from.face == MT_NONE ? MT_NONE : map->faces[from.face]};
        }
    }
    for (mt_index i = 0; i < own->vertex_count; i++) {
        if (map->vertices[i] != MT_NONE) {
            out->vertex_halfedge[map->vertices[i]] = renumber(map, own->vertex_halfedge[i]);
        }
    }
    for (mt_index i = 0; i < own->face_count; i++) {
        if (map->faces[i] != MT_NONE) {
            out->face_halfedge[map->faces[i]] = renumber(map, own->face_halfedge[i]);
        }
    }
    return MT_OK;
}

mt_status mt_halfedge_surgery_compact(mt_context *context, const mt_halfedge_surgery *surgery, mt_surgery_map *map,
                                      mt_halfedge_mesh **out)
{
    *out = NULL;
    *map = (mt_surgery_map){0};
    mt_halfedge_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? number_elements(context, surgery, map, structure) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? copy_elements(context, &surgery->structure, map, structure) : status;
    if (status != MT_OK) {
        mt_halfedge_destroy(context, structure);
        mt_surgery_map_release(context, map);
        return status;
    }
    *out = structure;
    return MT_OK;
}
