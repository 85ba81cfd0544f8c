#include "lib/topology/surgery_view.h"

static mt_status number_edges(mt_context *context, const mt_surgery_view *view, mt_surgery_map *map, mt_index *count)
{
    map->edge_count = view->side_count / 2;
    map->edges = mt_allocate_array(context, map->edge_count, sizeof(mt_index));
    if (!map->edges) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index edge = 0; edge < map->edge_count; edge++) {
        map->edges[edge] = surgery_head(view, 2 * edge) == MT_NONE ? MT_NONE : (*count)++;
    }
    return MT_OK;
}

mt_status mt_surgery_number(mt_context *context, const mt_surgery_view *view, bool numbers_edges, mt_surgery_map *map,
                            mt_surgery_counts *counts)
{
    *counts = (mt_surgery_counts){0};
    *map = (mt_surgery_map){.vertex_count = view->vertex_count,
                            .face_count = view->face_count,
                            .vertices = mt_allocate_array(context, view->vertex_count, sizeof(mt_index)),
                            .faces = mt_allocate_array(context, view->face_count, sizeof(mt_index))};
    if (!map->vertices || !map->faces) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index vertex = 0; vertex < view->vertex_count; vertex++) {
        map->vertices[vertex] = view->vertex_deleted[vertex] ? MT_NONE : counts->vertex_count++;
    }
    for (mt_index face = 0; face < view->face_count; face++) {
        map->faces[face] = surgery_has_face(view, face) ? counts->face_count++ : MT_NONE;
    }
    return numbers_edges ? number_edges(context, view, map, &counts->edge_count) : MT_OK;
}
