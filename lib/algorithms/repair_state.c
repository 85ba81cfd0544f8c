#include "lib/algorithms/repair_state.h"

#include <string.h>

static mt_index *identity(mt_context *context, mt_index count)
{
    mt_index *numbers = mt_allocate_array(context, count, sizeof *numbers);
    for (mt_index i = 0; numbers && i < count; i++) {
        numbers[i] = i;
    }
    return numbers;
}

mt_status mt_repair_state_init(mt_context *context, const mt_mesh *mesh, repair_state *state)
{
    *state = (repair_state){.context = context};
    mt_status status = mt_mesh_copy(context, mesh, &state->mesh);
    if (status != MT_OK) {
        return status;
    }
    state->face_origins = identity(context, mesh->face_count);
    state->vertex_origins = identity(context, mesh->vertex_count);
    return state->face_origins && state->vertex_origins ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

void mt_repair_state_release(repair_state *state)
{
    mt_mesh_destroy(state->context, state->mesh);
    mt_free(state->context, state->face_origins);
    mt_free(state->context, state->vertex_origins);
}

/* The room doubles at each power of two. */
static mt_status append(mt_context *context, mt_index **list, uint64_t *count, mt_index number)
{
    if ((*count & (*count - 1)) == 0) {
        mt_index *grown = mt_reallocate(context, *list, (*count ? 2 * *count : 1) * sizeof **list);
        if (!grown) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        *list = grown;
    }
    (*list)[(*count)++] = number;
    return MT_OK;
}

mt_status mt_repair_note_face(mt_context *context, mt_repair_result *result, mt_index face)
{
    return append(context, &result->faces, &result->face_count, face);
}

mt_status mt_repair_note_vertex(mt_context *context, mt_repair_result *result, mt_index vertex)
{
    return append(context, &result->vertices, &result->vertex_count, vertex);
}

static mt_status replace_origins(mt_context *context, mt_index **origins, const mt_index *sources, mt_index count)
{
    if (!sources) {
        return MT_OK;
    }
    mt_index *fresh = mt_allocate_array(context, count, sizeof *fresh);
    if (!fresh) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < count; i++) {
        fresh[i] = sources[i] == MT_NONE ? MT_NONE : (*origins)[sources[i]];
    }
    mt_free(context, *origins);
    *origins = fresh;
    return MT_OK;
}

mt_status mt_repair_replace(repair_state *state, const mt_derivation *derivation)
{
    mt_mesh *mesh;
    mt_status status = mt_mesh_derive(state->context, state->mesh, derivation, &mesh);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_destroy(state->context, state->mesh);
    state->mesh = mesh;
    status = replace_origins(state->context, &state->face_origins, derivation->face_sources, mesh->face_count);
    if (status == MT_OK) {
        status =
            replace_origins(state->context, &state->vertex_origins, derivation->vertex_sources, mesh->vertex_count);
    }
    return status;
}

static mt_status note_dropped(repair_state *state, const uint8_t *drop, mt_repair_result *result)
{
    mt_status status = MT_OK;
    for (mt_index face = 0; status == MT_OK && face < state->mesh->face_count; face++) {
        if (drop[face]) {
            result->count++;
            status = mt_repair_note_face(state->context, result, state->face_origins[face]);
        }
    }
    return status;
}

static void list_kept(const mt_mesh *mesh, const uint8_t *drop, mt_derivation *derivation, mt_index *faces,
                      mt_index *offsets, mt_index *corners)
{
    mt_index face_count = 0, corner_count = 0;
    offsets[0] = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (drop[face]) {
            continue;
        }
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            corners[corner_count++] = corner;
        }
        faces[face_count++] = face;
        offsets[face_count] = corner_count;
    }
    derivation->vertex_count = mesh->vertex_count;
    derivation->face_count = face_count;
    derivation->corner_count = corner_count;
    derivation->face_sources = faces;
    derivation->corner_sources = corners;
    derivation->face_size = mesh->face_offsets ? 0 : mesh->face_size;
    derivation->face_offsets = offsets;
}

mt_status mt_repair_drop_faces(repair_state *state, const uint8_t *drop, mt_repair_result *result)
{
    mt_context *context = state->context;
    uint64_t before = result->count;
    mt_status status = note_dropped(state, drop, result);
    if (status != MT_OK || result->count == before) {
        return status;
    }
    const mt_mesh *mesh = state->mesh;
    mt_index *faces = mt_allocate_array(context, mesh->face_count, sizeof *faces);
    mt_index *offsets = mt_allocate_array(context, (uint64_t)mesh->face_count + 1, sizeof *offsets);
    mt_index *corners = mt_allocate_array(context, mesh->corner_count, sizeof *corners);
    status = MT_ERROR_OUT_OF_MEMORY;
    if (faces && offsets && corners) {
        mt_derivation derivation = {0};
        list_kept(mesh, drop, &derivation, faces, offsets, corners);
        status = mt_repair_replace(state, &derivation);
    }
    mt_free(context, corners);
    mt_free(context, offsets);
    mt_free(context, faces);
    return status;
}
