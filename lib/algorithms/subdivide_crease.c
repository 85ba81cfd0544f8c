/* Semi-sharp creases and corners lose 1 a level, as in DeRose, Kass and Truong, "Subdivision Surfaces in Character
 * Animation", SIGGRAPH 1998; from 10 on they are infinite and stay, as RenderMan has it.
 * Cost: for each crease the smaller valence of its two ends. */
#include "lib/algorithms/subdivide_crease.h"

#define INFINITE_SHARPNESS 10.0

static double next_sharpness(double sharpness)
{
    return sharpness >= INFINITE_SHARPNESS ? sharpness : sharpness - 1;
}

/* A walk around a vertex for the side that joins it to another. */
typedef struct ring_walk {
    mt_index start, corner, target;
    bool ended;
} ring_walk;

static ring_walk begin_walk(const mt_subdivide_topology *topology, mt_index vertex, mt_index target)
{
    mt_index start = topology->vertex_corners[vertex];
    ring_walk walk = {start, start, target, start == MT_NONE};
    return walk;
}

/* Looks at one face; returns the side when it was found, else MT_NONE. */
static mt_index step_walk(const mt_subdivide_topology *topology, ring_walk *walk, bool quads)
{
    mt_index previous = mt_subdivide_previous(topology, walk->corner, quads);
    if (topology->corner_vertices[mt_subdivide_next(topology, walk->corner, quads)] == walk->target) {
        return walk->corner;
    }
    if (topology->corner_vertices[previous] == walk->target) {
        return previous;
    }
    walk->corner = topology->twins[previous];
    walk->ended = walk->corner == previous || walk->corner == walk->start;
    return MT_NONE;
}

/* A side of the edge a-b, MT_NONE when no face has it. Both ends are tried in step, so that a hub of many spokes
 * costs no more than their rims. */
static mt_index find_side(const mt_subdivide_topology *topology, mt_index a, mt_index b)
{
    bool quads = !topology->face_offsets;
    ring_walk walks[2] = {begin_walk(topology, a, b), begin_walk(topology, b, a)};
    for (unsigned i = 0; !walks[0].ended && !walks[1].ended; i ^= 1) {
        mt_index side = step_walk(topology, &walks[i], quads);
        if (side != MT_NONE) {
            return side;
        }
    }
    return MT_NONE;
}

mt_status mt_subdivide_creases_refine(mt_context *context, mt_subdivide_state *state)
{
    if (!state->crease_count) {
        return MT_OK;
    }
    const mt_subdivide_topology *topology = &state->topologies[0];
    mt_edge_value *refined = mt_allocate_array(context, 2 * (uint64_t)state->crease_count, sizeof *refined);
    if (!refined) {
        return mt_context_error(context)->status;
    }
    mt_index count = 0;
    for (mt_index i = 0; i < state->crease_count; i++) {
        mt_edge_value crease = state->creases[i];
        mt_index side = find_side(topology, crease.a, crease.b);
        if (side == MT_NONE) {
            refined[count++] = crease;
            continue;
        }
        double value = next_sharpness(crease.value);
        mt_index middle =
            topology->vertex_count + topology->face_count + mt_subdivide_edge(topology, side, !topology->face_offsets);
        if (value > 0) {
            refined[count++] = (mt_edge_value){crease.a, middle, value};
            refined[count++] = (mt_edge_value){middle, crease.b, value};
        }
    }
    mt_free(context, state->creases);
    state->creases = refined;
    state->crease_count = count;
    return MT_OK;
}

mt_status mt_subdivide_sharpness_finish(mt_context *context, mt_subdivide_state *state, unsigned level_count,
                                        mt_mesh *result)
{
    const mt_mesh *mesh = state->mesh;
    result->creases = state->creases;
    result->crease_count = state->crease_count;
    state->creases = NULL;
    state->crease_count = 0;
    if (!mesh->sharp_vertex_count) {
        return MT_OK;
    }
    result->sharp_vertices = mt_allocate_array(context, mesh->sharp_vertex_count, sizeof *result->sharp_vertices);
    if (!result->sharp_vertices) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        mt_vertex_value vertex = mesh->sharp_vertices[i];
        for (unsigned level = 0; level < level_count; level++) {
            vertex.value = next_sharpness(vertex.value);
        }
        if (vertex.value > 0) {
            result->sharp_vertices[result->sharp_vertex_count++] = vertex;
        }
    }
    return MT_OK;
}
