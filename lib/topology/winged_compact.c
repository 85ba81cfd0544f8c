/* What surgery on winged edges left, without gaps. Cost: O(size). */
#include "lib/topology/surgery_mesh.h"
#include "lib/topology/winged_edit.h"

static mt_status number_elements(mt_context *context, const mt_winged_surgery *surgery, mt_surgery_map *map,
                                 mt_winged_edge_mesh *out)
{
    mt_surgery_view view = mt_winged_view(surgery);
    mt_surgery_counts counts;
    mt_status status = mt_surgery_number(context, &view, true, map, &counts);
    out->vertex_count = counts.vertex_count;
    out->face_count = counts.face_count;
    out->edge_count = counts.edge_count;
    return status;
}

static mt_index renumber(const mt_index *map, mt_index old)
{
    return old == MT_NONE ? MT_NONE : map[old];
}

static mt_winged_edge renumber_edge(const mt_surgery_map *map, mt_winged_edge edge)
{
    return (mt_winged_edge){.head = map->vertices[edge.head],
                            .tail = map->vertices[edge.tail],
                            .left = renumber(map->faces, edge.left),
                            .right = renumber(map->faces, edge.right),
                            .lprev = map->edges[edge.lprev],
                            .lnext = map->edges[edge.lnext],
                            .rprev = map->edges[edge.rprev],
                            .rnext = map->edges[edge.rnext]};
}

static mt_status copy_elements(mt_context *context, const mt_winged_edge_mesh *own, const mt_surgery_map *map,
                               mt_winged_edge_mesh *out)
{
    out->edges = mt_allocate_array(context, out->edge_count, sizeof *out->edges);
    out->vertex_edge = mt_allocate_array(context, out->vertex_count, sizeof(mt_index));
    out->face_edge = mt_allocate_array(context, out->face_count, sizeof(mt_index));
    if (!out->edges || !out->vertex_edge || !out->face_edge) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < own->edge_count; i++) {
        if (map->edges[i] != MT_NONE) {
            out->edges[map->edges[i]] = renumber_edge(map, own->edges[i]);
        }
    }
    for (mt_index i = 0; i < own->vertex_count; i++) {
        if (map->vertices[i] != MT_NONE) {
            out->vertex_edge[map->vertices[i]] = renumber(map->edges, own->vertex_edge[i]);
        }
    }
    for (mt_index i = 0; i < own->face_count; i++) {
        if (map->faces[i] != MT_NONE) {
            out->face_edge[map->faces[i]] = map->edges[own->face_edge[i]];
        }
    }
    return MT_OK;
}

mt_status mt_winged_surgery_compact(mt_context *context, const mt_winged_surgery *surgery, mt_surgery_map *map,
                                    mt_winged_edge_mesh **out)
{
    *out = NULL;
    mt_surgery_map own = {0};
    mt_winged_edge_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? number_elements(context, surgery, &own, structure) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? copy_elements(context, &surgery->structure, &own, structure) : status;
    if (status != MT_OK) {
        mt_winged_edge_destroy(context, structure);
        structure = NULL;
    }
    if (status != MT_OK || !map) {
        mt_surgery_map_release(context, &own);
    }
    if (map) {
        *map = own;
    }
    *out = structure;
    return status;
}

mt_status mt_winged_surgery_to_mesh(mt_context *context, const mt_winged_surgery *surgery, const mt_mesh *source,
                                    mt_mesh **out)
{
    mt_surgery_view view = mt_winged_view(surgery);
    return mt_surgery_view_mesh(context, source, &surgery->log, &view, out);
}
