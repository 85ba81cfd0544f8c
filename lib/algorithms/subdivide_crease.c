#include "lib/algorithms/subdivide_crease.h"

#include "lib/algorithms/subdivide_angle.h"

#include <string.h>

mt_status mt_subdivide_join_creases(mt_context *context, const mt_mesh *mesh, const mt_index *twins,
                                    const mt_subdivide_options *settings, mt_edge_value **joined, mt_index *count)
{
    mt_edge_value *angled = NULL;
    mt_index angled_count = 0;
    mt_status status = MT_OK;
    if (settings->crease_angle > 0) {
        status = mt_creases_of_angle(context, mesh, twins, settings->crease_angle, (double)MT_SHARPNESS_INFINITE,
                                     &angled, &angled_count);
    }
    uint64_t total = (uint64_t)mesh->crease_count + angled_count + settings->crease_count;
    *joined = status == MT_OK ? mt_allocate_array(context, total, sizeof **joined) : NULL;
    const mt_edge_value *parts[] = {mesh->creases, angled, settings->creases};
    const mt_index counts[] = {mesh->crease_count, angled_count, settings->crease_count};
    *count = 0;
    for (unsigned i = 0; *joined && i < 3; i++) {
        if (counts[i]) {
            memcpy(*joined + *count, parts[i], counts[i] * sizeof **joined);
        }
        *count += counts[i];
    }
    mt_free(context, angled);
    return *joined ? MT_OK : mt_context_error(context)->status;
}

mt_status mt_subdivide_join_corners(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *settings,
                                    mt_vertex_value **joined, mt_index *count)
{
    uint64_t total = (uint64_t)mesh->sharp_vertex_count + settings->sharp_vertex_count;
    *joined = mt_allocate_array(context, total, sizeof **joined);
    *count = 0;
    if (!*joined) {
        return mt_context_error(context)->status;
    }
    if (mesh->sharp_vertex_count) {
        memcpy(*joined, mesh->sharp_vertices, mesh->sharp_vertex_count * sizeof **joined);
    }
    if (settings->sharp_vertex_count) {
        memcpy(*joined + mesh->sharp_vertex_count, settings->sharp_vertices,
               settings->sharp_vertex_count * sizeof **joined);
    }
    *count = (mt_index)total;
    return MT_OK;
}

mt_status mt_subdivide_creases_create(mt_context *context, mt_subdivide_state *state)
{
    mt_sharp_input input = {.corners = state->settings.boundary == MT_SUBDIVIDE_BOUNDARY_CORNERS && !state->cut,
                            .chaikin = state->settings.crease_method == MT_SUBDIVIDE_CREASES_CHAIKIN};
    mt_edge_value *creases = NULL;
    mt_status status = mt_subdivide_join_creases(context, state->mesh, state->topologies[0].twins, &state->settings,
                                                 &creases, &input.crease_count);
    if (status == MT_OK) {
        status = mt_subdivide_join_corners(context, state->mesh, &state->settings, &state->sharp_vertices,
                                           &state->sharp_vertex_count);
    }
    if (status == MT_OK) {
        input.asked_crease_count = state->cut ? state->cut->asked_crease_count : input.crease_count;
        input.creases = creases;
        input.vertices = state->sharp_vertices;
        input.vertex_count = state->sharp_vertex_count;
        status = mt_subdivide_sharp_create(context, &state->topologies[0], &input, &state->sharp);
    }
    mt_free(context, creases);
    return status;
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
        mt_edge_value crease = {topology->corner_vertices[side], topology->corner_vertices[end],
                                (double)sharp->edges[edge].sharpness};
        if (!sharp->edges[edge].implied) {
            result->creases[result->crease_count++] = crease;
        }
    }
    if (sharp->missing_count) {
        memcpy(result->creases + result->crease_count, sharp->missing, sharp->missing_count * sizeof *sharp->missing);
        result->crease_count += sharp->missing_count;
    }
    return MT_OK;
}

static mt_status finish_vertices(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                 mt_mesh *result)
{
    result->sharp_vertices = mt_allocate_array(context, state->sharp_vertex_count, sizeof *result->sharp_vertices);
    if (!result->sharp_vertices) {
        return mt_context_error(context)->status;
    }
    mt_index asked_count = state->cut ? state->cut->asked_corner_count : state->sharp_vertex_count;
    for (mt_index i = 0; i < asked_count; i++) {
        float sharpness = (float)state->sharp_vertices[i].value;
        for (unsigned level = 0; level < level_count; level++) {
            sharpness = mt_sharpness_next(sharpness);
        }
        if (sharpness > 0) {
            mt_vertex_value left = {state->sharp_vertices[i].vertex, (double)sharpness};
            result->sharp_vertices[result->sharp_vertex_count++] = left;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_creases_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                      mt_mesh *result)
{
    mt_status status = finish_edges(context, state, result);
    return status == MT_OK ? finish_vertices(context, state, level_count, result) : status;
}
