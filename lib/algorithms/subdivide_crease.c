#include "lib/algorithms/subdivide_crease.h"

#include <string.h>

mt_status mt_subdivide_creases_create(mt_context *context, mt_subdivide_state *state)
{
    const mt_mesh *mesh = state->mesh;
    mt_sharp_input input = {.crease_count = mesh->crease_count,
                            .creases = mesh->creases,
                            .vertex_count = mesh->sharp_vertex_count,
                            .vertices = mesh->sharp_vertices,
                            .corners = state->settings.boundary == MT_SUBDIVIDE_BOUNDARY_CORNERS,
                            .chaikin = state->settings.crease_method == MT_SUBDIVIDE_CREASES_CHAIKIN};
    return mt_subdivide_sharp_create(context, &state->topologies[0], &input, &state->sharp);
}

static mt_status finish_edges(mt_context *context, const mt_subdivide_state *state, mt_mesh *result)
{
    const mt_subdivide_sharp *sharp = &state->sharp;
    const mt_subdivide_topology *topology = &state->topologies[0];
    uint64_t count = (uint64_t)sharp->edge_count + sharp->missing_count;
    result->creases = mt_allocate_array(context, count, sizeof *result->creases);
    if (!result->creases) {
        return mt_context_error(context)->status;
    }
    for (mt_index edge = 0; edge < sharp->edge_count; edge++) {
        mt_index side = sharp->edges[edge].side;
        mt_index end = mt_subdivide_next(topology, side, topology->face_size);
        result->creases[edge] = (mt_edge_value){topology->corner_vertices[side], topology->corner_vertices[end],
                                                (double)sharp->edges[edge].sharpness};
    }
    if (sharp->missing_count) {
        memcpy(result->creases + sharp->edge_count, sharp->missing, sharp->missing_count * sizeof *sharp->missing);
    }
    result->crease_count = (mt_index)count;
    return MT_OK;
}

static mt_status finish_vertices(mt_context *context, const mt_mesh *mesh, unsigned level_count, mt_mesh *result)
{
    result->sharp_vertices = mt_allocate_array(context, mesh->sharp_vertex_count, sizeof *result->sharp_vertices);
    if (!result->sharp_vertices) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        float sharpness = (float)mesh->sharp_vertices[i].value;
        for (unsigned level = 0; level < level_count; level++) {
            sharpness = mt_sharpness_next(sharpness);
        }
        if (sharpness > 0) {
            mt_vertex_value left = {mesh->sharp_vertices[i].vertex, (double)sharpness};
            result->sharp_vertices[result->sharp_vertex_count++] = left;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_creases_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                      mt_mesh *result)
{
    mt_status status = finish_edges(context, state, result);
    return status == MT_OK ? finish_vertices(context, state->mesh, level_count, result) : status;
}
