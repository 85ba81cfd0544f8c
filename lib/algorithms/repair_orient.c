/* Turning faces so that neighbours run alike, and closed components outwards.
 *
 * A component's faces are turned to agree with its first face, or all others are, whichever turns fewer; a closed one
 * is then turned as a whole where its volume is negative (component_volume.c). A component that no turning orients (a
 * Moebius strip) stays as it is and is counted as left. */
#include "lib/algorithms/component_volume.h"
#include "lib/algorithms/repair_state.h"

#include <string.h>

typedef struct component_facts {
    mt_index face_count, turned_count;
    bool is_open, is_unorientable;
} component_facts;

typedef struct orient_job {
    repair_state *state;
    const mt_edge_pairs *pairs;
    const mt_components *components;
    component_facts *facts;
    int8_t *volume_signs; /* after turning to agree with the first face */
} orient_job;

/* Edges tell what closed and orientable mean: an edge of one side opens its component, one whose two sides disagree
 * after turning, or with three sides or more, makes it one that cannot be oriented. */
static void look_at_edges(orient_job *job)
{
    const mt_mesh *mesh = job->state->mesh;
    const uint8_t *turned = job->components->face_turned;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        component_facts *facts = &job->facts[job->components->face_component[face]];
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            mt_edge_class edge = mt_edge_class_of(mesh, job->pairs, corner);
            if (edge == MT_EDGE_BOUNDARY || edge == MT_EDGE_NON_MANIFOLD) {
                facts->is_open = true;
            } else if (edge != MT_EDGE_NONE) {
                mt_index other = mt_mesh_corner_face(mesh, job->pairs->next_side[corner]);
                bool disagree = (turned[face] != turned[other]) != (edge == MT_EDGE_MISORIENTED);
                facts->is_unorientable = facts->is_unorientable || disagree;
            }
        }
    }
}

static void count_faces(orient_job *job)
{
    for (mt_index face = 0; face < job->state->mesh->face_count; face++) {
        component_facts *facts = &job->facts[job->components->face_component[face]];
        facts->face_count++;
        facts->turned_count += job->components->face_turned[face];
    }
}

/* Whether all faces of the component are turned once more than its first face asks. */
static bool is_reversed(const component_facts *facts, int volume_sign)
{
    if (!facts->is_open && volume_sign != 0) {
        return volume_sign < 0;
    }
    return facts->turned_count > facts->face_count - facts->turned_count;
}

static mt_status choose_turned(orient_job *job, uint8_t *turn, mt_repair_result *result)
{
    const mt_components *components = job->components;
    mt_status status = MT_OK;
    for (mt_index i = 0; i < components->component_count; i++) {
        result->left_count += job->facts[i].is_unorientable;
    }
    for (mt_index face = 0; status == MT_OK && face < job->state->mesh->face_count; face++) {
        mt_index component = components->face_component[face];
        const component_facts *facts = &job->facts[component];
        bool reversed = is_reversed(facts, job->volume_signs[component]);
        turn[face] = !facts->is_unorientable && (components->face_turned[face] != 0) != reversed;
        if (turn[face]) {
            result->count++;
            status = mt_repair_note_face(job->state->context, result, job->state->face_origins[face]);
        }
    }
    return status;
}

/* A turned face keeps its first corner and runs through the others backwards. */
static mt_status turn_faces(repair_state *state, const uint8_t *turn)
{
    const mt_mesh *mesh = state->mesh;
    mt_index *corners = mt_allocate_array(state->context, mesh->corner_count, sizeof *corners);
    if (!corners) {
        return mt_context_error(state->context)->status;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        corners[begin] = begin;
        for (mt_index corner = begin + 1; corner < end; corner++) {
            corners[corner] = turn[face] ? end - (corner - begin) : corner;
        }
    }
    mt_derivation derivation = {.vertex_count = mesh->vertex_count,
                                .face_count = mesh->face_count,
                                .face_size = mesh->face_offsets ? 0 : mesh->face_size,
                                .face_offsets = mesh->face_offsets,
                                .corner_count = mesh->corner_count,
                                .corner_sources = corners};
    mt_status status = mt_repair_replace(state, &derivation);
    mt_free(state->context, corners);
    return status;
}

static mt_status orient(orient_job *job, mt_repair_result *result)
{
    repair_state *state = job->state;
    mt_index component_count = job->components->component_count;
    job->facts = mt_allocate_array_zeroed(state->context, component_count, sizeof *job->facts);
    job->volume_signs = mt_allocate(state->context, component_count);
    uint8_t *turn = mt_allocate(state->context, state->mesh->face_count);
    mt_status status = job->facts && job->volume_signs && turn ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        status = mt_component_volume_signs(state->context, state->mesh, job->components, MT_ARITHMETIC_ADAPTIVE,
                                           job->volume_signs);
    }
    if (status == MT_OK) {
        look_at_edges(job);
        count_faces(job);
        status = choose_turned(job, turn, result);
    }
    if (status == MT_OK && result->count) {
        status = turn_faces(state, turn);
    }
    mt_free(state->context, turn);
    mt_free(state->context, job->volume_signs);
    mt_free(state->context, job->facts);
    return status;
}

mt_status mt_repair_orient(repair_state *state, mt_repair_result *result)
{
    mt_edge_pairs *pairs;
    mt_status status = mt_edge_pairs_create(state->context, state->mesh, &pairs);
    if (status != MT_OK) {
        return status;
    }
    mt_components *components;
    status = mt_components_create(state->context, state->mesh, pairs, true, &components);
    if (status == MT_OK) {
        orient_job job = {.state = state, .pairs = pairs, .components = components};
        status = orient(&job, result);
        mt_components_destroy(state->context, components);
    }
    mt_edge_pairs_destroy(state->context, pairs);
    return status;
}
