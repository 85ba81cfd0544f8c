/* What surgery on half-edges left, without gaps. Cost: O(size), and O(log) for a mesh. */
#include "lib/topology/halfedge_edit.h"
#include "lib/topology/surgery_mesh.h"

static mt_status number_elements(mt_context *context, const mt_halfedge_surgery *surgery, mt_surgery_map *map,
                                 mt_halfedge_mesh *out)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    mt_surgery_counts counts;
    mt_status status = mt_surgery_number(context, &view, true, map, &counts);
    out->vertex_count = counts.vertex_count;
    out->face_count = counts.face_count;
    out->halfedge_count = 2 * counts.edge_count;
    return status;
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
    mt_surgery_map own = {0};
    mt_halfedge_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? number_elements(context, surgery, &own, structure) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? copy_elements(context, &surgery->structure, &own, structure) : status;
    if (status != MT_OK) {
        mt_halfedge_destroy(context, structure);
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

mt_status mt_halfedge_surgery_to_mesh(mt_context *context, const mt_halfedge_surgery *surgery, const mt_mesh *source,
                                      mt_mesh **out)
{
    mt_surgery_view view = mt_halfedge_view(surgery);
    return mt_surgery_view_mesh(context, source, &surgery->log, &view, out);
}
