#include "lib/algorithms/repair_state.h"

#include <meshtool/weld.h>

static mt_status number_vertices(repair_state *state, double tolerance, mt_index *numbers, mt_index *distinct_count)
{
    mt_mesh *mesh = state->mesh;
    if (tolerance > 0) {
        return mt_weld_within(state->context, mesh->positions, mesh->position_type, mesh->vertex_count, tolerance,
                              numbers, distinct_count);
    }
    void *distinct = mt_allocate_array(state->context, mesh->vertex_count, 3 * mt_type_size(mesh->position_type));
    if (!distinct) {
        return mt_context_error(state->context)->status;
    }
    mt_status status = mt_weld_exact(state->context, mesh->positions, mesh->position_type, mesh->vertex_count, distinct,
                                     numbers, distinct_count);
    mt_free(state->context, distinct);
    return status;
}

/* Notes the vertices that joined an earlier one, and keeps the origins of the others. */
static mt_status note_joined(repair_state *state, const mt_index *numbers, mt_repair_result *result)
{
    mt_index kept = 0;
    mt_status status = MT_OK;
    for (mt_index vertex = 0; status == MT_OK && vertex < state->mesh->vertex_count; vertex++) {
        if (numbers[vertex] == kept) {
            state->vertex_origins[kept++] = state->vertex_origins[vertex];
        } else {
            result->count++;
            status = mt_repair_note_vertex(state->context, result, state->vertex_origins[vertex]);
        }
    }
    return status;
}

mt_status mt_repair_join(repair_state *state, const mt_index *numbers, mt_index distinct_count,
                         mt_repair_result *result)
{
    mt_status status = note_joined(state, numbers, result);
    if (status == MT_OK && result->count) {
        status = mt_mesh_join_vertices(state->context, state->mesh, numbers, distinct_count);
    }
    return status;
}

mt_status mt_repair_weld(repair_state *state, const mt_repair_options *options, mt_repair_result *result)
{
    mt_index *numbers = mt_allocate_array(state->context, state->mesh->vertex_count, sizeof *numbers);
    if (!numbers) {
        return mt_context_error(state->context)->status;
    }
    mt_index distinct_count = 0;
    mt_status status = number_vertices(state, options->weld_tolerance, numbers, &distinct_count);
    if (status == MT_OK && options->steps[MT_REPAIR_SPLIT] && distinct_count < state->mesh->vertex_count) {
        status = mt_repair_choose_welds(state, options, numbers, &distinct_count);
    }
    if (status == MT_OK) {
        status = mt_repair_join(state, numbers, distinct_count, result);
    }
    mt_free(state->context, numbers);
    return status;
}
