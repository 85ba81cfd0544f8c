#include "lib/algorithms/repair_state.h"

#include <meshtool/split_non_manifold.h>

mt_status mt_repair_split(repair_state *state, mt_repair_result *result)
{
    mt_context *context = state->context;
    mt_mesh *mesh;
    mt_index *sources;
    mt_index before = state->mesh->vertex_count;
    mt_status status = mt_split_non_manifold(context, state->mesh, &mesh, &sources);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_destroy(context, state->mesh);
    state->mesh = mesh;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        sources[vertex] = state->vertex_origins[sources[vertex]];
    }
    mt_free(context, state->vertex_origins);
    state->vertex_origins = sources;
    result->count = mesh->vertex_count - before;
    for (mt_index vertex = before; status == MT_OK && vertex < mesh->vertex_count; vertex++) {
        status = mt_repair_note_vertex(context, result, vertex);
    }
    return status;
}
