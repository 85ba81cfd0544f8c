/* Turning faces so that neighbours run alike, and closed components outwards.
 *
 * A component's faces are turned to agree with its first face, or all others are, whichever turns fewer; a closed one
 * is then turned as a whole where its volume is negative. A component that no turning orients (a Moebius strip) stays
 * as it is and is counted as left. Volumes are summed about the component's own first vertex, with coordinates scaled
 * by a power of two, over fans that do not depend on the direction of a face: triangulations may, and two volumes of
 * one bent component that are both negative would have it turned for ever. */
#include "lib/algorithms/repair_state.h"

#include <meshtool/components.h>

#include <string.h>

typedef struct component_facts {
    mt_vec3 origin; /* scaled position of its first vertex */
    double volume;  /* six times, after turning to agree with the first face */
    mt_index face_count, turned_count;
    bool has_face, is_open, is_unorientable;
} component_facts;

typedef struct orient_job {
    repair_state *state;
    const mt_edge_pairs *pairs;
    const mt_components *components;
    component_facts *facts;
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

static mt_vec3 relative_position(const mt_mesh *mesh, mt_index corner, double scale, mt_vec3 origin)
{
    return mt_vec3_subtract(mt_vec3_scale(mt_mesh_position(mesh, mesh->corner_vertices[corner]), scale), origin);
}

/* Of the fan about the face's first corner. The fan is run from the end with the lower vertex, so that a face turned
 * over has the same volume, bit for bit, but for its sign. */
static double face_volume(const mt_mesh *mesh, mt_index face, double scale, mt_vec3 origin)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), sides = mt_mesh_face_sides(mesh, face);
    const mt_index *vertices = mesh->corner_vertices + begin;
    bool backwards = vertices[sides - 1] < vertices[1];
    mt_vec3 apex = relative_position(mesh, begin, scale, origin);
    mt_vec3 before = relative_position(mesh, begin + (backwards ? sides - 1 : 1), scale, origin);
    double volume = 0;
    for (mt_index i = 2; i < sides; i++) {
        mt_vec3 point = relative_position(mesh, begin + (backwards ? sides - i : i), scale, origin);
        volume += mt_vec3_dot(apex, mt_vec3_cross(before, point));
        before = point;
    }
    return backwards ? -volume : volume;
}

static void measure_volumes(orient_job *job)
{
    const mt_mesh *mesh = job->state->mesh;
    mt_bounds bounds = mt_mesh_bounds(mesh);
    double scale = mt_power_of_two_scale(fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum)));
    for (mt_index face = 0; face < mesh->face_count; face++) {
        component_facts *facts = &job->facts[job->components->face_component[face]];
        if (!facts->has_face) {
            facts->has_face = true;
            facts->origin = relative_position(mesh, mt_mesh_face_begin(mesh, face), scale, (mt_vec3){0});
        }
        double volume = face_volume(mesh, face, scale, facts->origin);
        facts->volume += job->components->face_turned[face] ? -volume : volume;
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
static bool is_reversed(const component_facts *facts)
{
    if (!facts->is_open && facts->volume != 0) {
        return facts->volume < 0;
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
        const component_facts *facts = &job->facts[components->face_component[face]];
        turn[face] = !facts->is_unorientable && (components->face_turned[face] != 0) != is_reversed(facts);
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
    job->facts = mt_allocate_array_zeroed(state->context, job->components->component_count, sizeof *job->facts);
    uint8_t *turn = mt_allocate(state->context, state->mesh->face_count);
    mt_status status = job->facts && turn ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        look_at_edges(job);
        count_faces(job);
        measure_volumes(job);
        status = choose_turned(job, turn, result);
    }
    if (status == MT_OK && result->count) {
        status = turn_faces(state, turn);
    }
    mt_free(state->context, turn);
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
