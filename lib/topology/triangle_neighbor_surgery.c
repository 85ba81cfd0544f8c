/* The growing copy of triangle neighbours that surgery works on, and its compaction. Cost: amortised O(1) for each new
 * element; O(size) to compact. */
#include "lib/topology/surgery_mesh.h"
#include "lib/topology/surgery_room.h"
#include "lib/topology/triangle_edit.h"

#include <string.h>

void mt_triangle_surgery_destroy(mt_context *context, mt_triangle_surgery *surgery)
{
    if (surgery) {
        mt_free(context, surgery->structure.vertices);
        mt_free(context, surgery->structure.neighbors);
        mt_free(context, surgery->structure.vertex_corner);
        mt_free(context, surgery->vertex_deleted);
        mt_free(context, surgery->marks);
        mt_edit_log_release(context, &surgery->log);
        mt_free(context, surgery);
    }
}

static mt_status make_vertex_room(mt_context *context, mt_triangle_surgery *surgery, uint64_t needed)
{
    mt_surgery_block blocks[3] = {
        {surgery->structure.vertex_corner, sizeof(mt_index)}, {surgery->vertex_deleted, 1}, {surgery->marks, 1}};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->vertex_capacity, blocks, 3);
    surgery->structure.vertex_corner = blocks[0].block;
    surgery->vertex_deleted = blocks[1].block;
    surgery->marks = blocks[2].block;
    return status;
}

static mt_status make_triangle_room(mt_context *context, mt_triangle_surgery *surgery, uint64_t needed)
{
    if (6 * needed >= MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more sides of triangles than an index can number");
    }
    mt_surgery_block blocks[2] = {{surgery->structure.vertices, 3 * sizeof(mt_index)},
                                  {surgery->structure.neighbors, 3 * sizeof(mt_index)}};
    mt_status status = mt_surgery_make_room(context, needed, &surgery->triangle_capacity, blocks, 2);
    surgery->structure.vertices = blocks[0].block;
    surgery->structure.neighbors = blocks[1].block;
    return status;
}

static mt_status make_room(mt_context *context, mt_triangle_surgery *surgery, uint64_t vertices, uint64_t triangles)
{
    mt_status status = make_vertex_room(context, surgery, vertices);
    return status == MT_OK ? make_triangle_room(context, surgery, triangles) : status;
}

mt_status mt_triangle_reserve(mt_context *context, mt_triangle_surgery *surgery, mt_index vertices, mt_index triangles)
{
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    return make_room(context, surgery, (uint64_t)own->vertex_count + vertices,
                     (uint64_t)own->triangle_count + triangles);
}

mt_status mt_triangle_surgery_create(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                     mt_triangle_surgery **out)
{
    *out = NULL;
    mt_triangle_surgery *surgery = mt_allocate_zeroed(context, sizeof *surgery);
    if (!surgery) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_status status =
        make_room(context, surgery, (uint64_t)structure->vertex_count + 1, (uint64_t)structure->triangle_count + 1);
    if (status != MT_OK) {
        mt_triangle_surgery_destroy(context, surgery);
        return status;
    }
    own->vertex_count = surgery->log.vertex_count = structure->vertex_count;
    own->triangle_count = surgery->log.face_count = structure->triangle_count;
    memcpy(own->vertices, structure->vertices, 3 * (size_t)own->triangle_count * sizeof(mt_index));
    memcpy(own->neighbors, structure->neighbors, 3 * (size_t)own->triangle_count * sizeof(mt_index));
    memcpy(own->vertex_corner, structure->vertex_corner, (size_t)own->vertex_count * sizeof(mt_index));
    memset(surgery->vertex_deleted, 0, own->vertex_count);
    memset(surgery->marks, 0, own->vertex_count);
    *out = surgery;
    return MT_OK;
}

mt_index mt_triangle_new_vertex(mt_triangle_surgery *surgery)
{
    mt_index vertex = surgery->structure.vertex_count++;
    surgery->structure.vertex_corner[vertex] = MT_NONE;
    surgery->vertex_deleted[vertex] = 0;
    surgery->marks[vertex] = 0;
    return vertex;
}

mt_index mt_triangle_new(mt_triangle_surgery *surgery, mt_index a, mt_index b, mt_index c)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index corner = 3 * own->triangle_count++;
    own->vertices[corner] = a;
    own->vertices[corner + 1] = b;
    own->vertices[corner + 2] = c;
    own->neighbors[corner] = own->neighbors[corner + 1] = own->neighbors[corner + 2] = MT_NONE;
    return corner;
}

void mt_triangle_delete(mt_triangle_surgery *surgery, mt_index triangle)
{
    for (mt_index corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
        surgery->structure.vertices[corner] = surgery->structure.neighbors[corner] = MT_NONE;
    }
}

void mt_triangle_anchor(mt_triangle_neighbor_mesh *own, mt_index corner)
{
    mt_index at = corner;
    while (own->neighbors[at] != MT_NONE) {
        at = mt_triangle_next_corner(own->neighbors[at]);
        if (at == corner) {
            break;
        }
    }
    own->vertex_corner[own->vertices[corner]] = at;
}

static mt_status number_elements(mt_context *context, const mt_triangle_surgery *surgery, mt_surgery_map *map,
                                 mt_triangle_neighbor_mesh *out)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    mt_surgery_counts counts;
    mt_status status = mt_surgery_number(context, &view, false, map, &counts);
    out->vertex_count = counts.vertex_count;
    out->triangle_count = counts.face_count;
    return status;
}

static mt_index renumber(const mt_surgery_map *map, mt_index corner)
{
    return corner == MT_NONE ? MT_NONE : 3 * map->faces[corner / 3] + corner % 3;
}

static mt_status copy_elements(mt_context *context, const mt_triangle_neighbor_mesh *own, const mt_surgery_map *map,
                               mt_triangle_neighbor_mesh *out)
{
    out->vertices = mt_allocate_array(context, 3 * (uint64_t)out->triangle_count, sizeof(mt_index));
    out->neighbors = mt_allocate_array(context, 3 * (uint64_t)out->triangle_count, sizeof(mt_index));
    out->vertex_corner = mt_allocate_array(context, out->vertex_count, sizeof(mt_index));
    if (!out->vertices || !out->neighbors || !out->vertex_corner) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < own->vertex_count; i++) {
        if (map->vertices[i] != MT_NONE) {
            out->vertex_corner[map->vertices[i]] = renumber(map, own->vertex_corner[i]);
        }
    }
    for (mt_index corner = 0; corner < 3 * own->triangle_count; corner++) {
        mt_index to = map->faces[corner / 3] == MT_NONE ? MT_NONE : renumber(map, corner);
        if (to != MT_NONE) {
            out->vertices[to] = map->vertices[own->vertices[corner]];
            out->neighbors[to] = renumber(map, own->neighbors[corner]);
        }
    }
    return MT_OK;
}

/* The highest corner, as where the structure is built: only on the boundary it must be a certain one. */
static void raise_corners(mt_triangle_neighbor_mesh *out)
{
    for (mt_index corner = 0; corner < 3 * out->triangle_count; corner++) {
        mt_index *own = &out->vertex_corner[out->vertices[corner]];
        if (out->neighbors[*own] != MT_NONE && corner > *own) {
            *own = corner;
        }
    }
}

mt_status mt_triangle_surgery_compact(mt_context *context, const mt_triangle_surgery *surgery, mt_surgery_map *map,
                                      mt_triangle_neighbor_mesh **out)
{
    *out = NULL;
    mt_surgery_map own = {0};
    mt_triangle_neighbor_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? number_elements(context, surgery, &own, structure) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? copy_elements(context, &surgery->structure, &own, structure) : status;
    if (status == MT_OK) {
        raise_corners(structure);
        *out = structure;
    } else {
        mt_triangle_neighbor_destroy(context, structure);
    }
    if (status != MT_OK || !map) {
        mt_surgery_map_release(context, &own);
    }
    if (map) {
        *map = own;
    }
    return status;
}

mt_status mt_triangle_surgery_to_mesh(mt_context *context, const mt_triangle_surgery *surgery, const mt_mesh *source,
                                      mt_mesh **out)
{
    mt_surgery_view view = mt_triangle_view(surgery);
    return mt_surgery_view_mesh(context, source, &surgery->log, &view, out);
}
