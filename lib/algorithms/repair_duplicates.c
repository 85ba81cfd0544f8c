#include "lib/algorithms/manifold_check.h"
#include "lib/algorithms/repair_state.h"

static mt_status drop_flagged(repair_state *state, manifold_check *check, mt_repair_result *result)
{
    mt_status status = mt_manifold_find_duplicates(check);
    for (mt_index face = 0; status == MT_OK && face < state->mesh->face_count; face++) {
        check->face_flags[face] &= FACE_DUPLICATE;
    }
    mt_free(state->context, check->duplicates);
    return status == MT_OK ? mt_repair_drop_faces(state, check->face_flags, result) : status;
}

mt_status mt_repair_drop_duplicates(repair_state *state, mt_repair_result *result)
{
    mt_context *context = state->context;
    mt_manifold_report report = {0};
    manifold_check check = {.context = context, .mesh = state->mesh, .report = &report};
    mt_status status = mt_edge_pairs_create(context, state->mesh, &check.pairs);
    if (status != MT_OK) {
        return status;
    }
    check.face_flags = mt_allocate_zeroed(context, state->mesh->face_count);
    status = check.face_flags ? drop_flagged(state, &check, result) : MT_ERROR_OUT_OF_MEMORY;
    mt_free(context, check.face_flags);
    mt_edge_pairs_destroy(context, check.pairs);
    return status;
}
