/* Dropping what no surface needs: faces without an area, vertices without a face. */
#include "lib/algorithms/repair_state.h"

#include <meshtool/degenerate_faces.h>
#include <meshtool/predicates.h>

#include <string.h>

static bool is_on_a_line(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    mt_vec3 first = mt_mesh_position(mesh, mesh->corner_vertices[begin]), second = first;
    for (mt_index corner = begin; corner < end; corner++) {
        mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
        if (!mt_vec3_is_finite(p)) {
            return false;
        }
        bool second_is_first = second.x == first.x && second.y == first.y && second.z == first.z;
        if (second_is_first) {
            second = p;
        } else if (!mt_collinear(first, second, p)) {
            return false;
        }
    }
    return true;
}

mt_status mt_repair_drop_degenerate(repair_state *state, mt_repair_result *result)
{
    const mt_mesh *mesh = state->mesh;
    uint8_t *drop = mt_allocate(state->context, mesh->face_count);
    if (!drop) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_index degenerate_count;
    mt_status status = mt_find_degenerate_faces(state->context, mesh, drop, &degenerate_count);
    for (mt_index face = 0; status == MT_OK && face < mesh->face_count; face++) {
        drop[face] = drop[face] || is_on_a_line(mesh, face);
    }
    if (status == MT_OK) {
        status = mt_repair_drop_faces(state, drop, result);
    }
    mt_free(state->context, drop);
    return status;
}

static void mark_used(const mt_mesh *mesh, uint8_t *used)
{
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        used[mesh->corner_vertices[corner]] = 1;
    }
    mt_index wire_size = mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0;
    for (mt_index i = 0; i < wire_size; i++) {
        used[mesh->wire_vertices[i]] = 1;
    }
    for (mt_index i = 0; i < mesh->point_count; i++) {
        used[mesh->point_vertices[i]] = 1;
    }
}

static mt_status drop_unused(repair_state *state, const uint8_t *used, mt_index *sources, mt_index *targets,
                             mt_repair_result *result)
{
    const mt_mesh *mesh = state->mesh;
    mt_index kept = 0;
    mt_status status = MT_OK;
    for (mt_index vertex = 0; status == MT_OK && vertex < mesh->vertex_count; vertex++) {
        targets[vertex] = used[vertex] ? kept : MT_NONE;
        if (used[vertex]) {
            sources[kept++] = vertex;
        } else {
            result->count++;
            status = mt_repair_note_vertex(state->context, result, state->vertex_origins[vertex]);
        }
    }
    if (status != MT_OK || result->count == 0) {
        return status;
    }
    mt_derivation derivation = {.vertex_count = kept,
                                .vertex_sources = sources,
                                .vertex_targets = targets,
                                .face_count = mesh->face_count,
                                .face_size = mesh->face_offsets ? 0 : mesh->face_size,
                                .face_offsets = mesh->face_offsets,
                                .corner_count = mesh->corner_count};
    return mt_repair_replace(state, &derivation);
}

mt_status mt_repair_drop_isolated(repair_state *state, mt_repair_result *result)
{
    mt_context *context = state->context;
    mt_index count = state->mesh->vertex_count;
    uint8_t *used = mt_allocate_zeroed(context, count);
    mt_index *sources = mt_allocate_array(context, count, sizeof *sources);
    mt_index *targets = mt_allocate_array(context, count, sizeof *targets);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (used && sources && targets) {
        mark_used(state->mesh, used);
        status = drop_unused(state, used, sources, targets, result);
    }
    mt_free(context, targets);
    mt_free(context, sources);
    mt_free(context, used);
    return status;
}
