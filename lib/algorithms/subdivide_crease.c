/* Semi-sharp creases and corners lose 1 a level, as in DeRose, Kass and Truong, "Subdivision Surfaces in Character
 * Animation", SIGGRAPH 1998; from 10 on they are infinite and stay, as RenderMan has it.
 * Cost: at level 0 for each crease the smaller valence of its two ends, then O(creases): the halves of side c are the
 * sides 4c and 4 next(c) + 3. */
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
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    ring_walk walk = {start, start, target, start == MT_NONE};
    return walk;
}

/* Looks at one face; returns the side when it was found, else MT_NONE. */
static mt_index step_walk(const mt_subdivide_topology *topology, ring_walk *walk, unsigned sides)
{
    mt_index previous = mt_subdivide_previous(topology, walk->corner, sides);
    if (topology->corner_vertices[mt_subdivide_next(topology, walk->corner, sides)] == walk->target) {
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
    unsigned sides = topology->face_size;
    ring_walk walks[2] = {begin_walk(topology, a, b), begin_walk(topology, b, a)};
    for (unsigned i = 0; !walks[0].ended && !walks[1].ended; i ^= 1) {
        mt_index side = step_walk(topology, &walks[i], sides);
        if (side != MT_NONE) {
            return side;
        }
    }
    return MT_NONE;
}

mt_status mt_subdivide_creases_create(mt_context *context, mt_subdivide_state *state)
{
    const mt_mesh *mesh = state->mesh;
    state->creases = mt_allocate_array(context, mesh->crease_count, sizeof *state->creases);
    if (!state->creases) {
        return mt_context_error(context)->status;
    }
    state->crease_count = mesh->crease_count;
    for (mt_index i = 0; i < mesh->crease_count; i++) {
        mt_edge_value edge = mesh->creases[i];
        state->creases[i] = (mt_subdivide_crease){edge, find_side(&state->topologies[0], edge.a, edge.b)};
    }
    return MT_OK;
}

/* The halves of a crease that is on a face; returns how many are left sharp. */
static mt_index split_crease(const mt_subdivide_topology *topology, mt_subdivide_crease crease,
                             mt_subdivide_crease halves[2])
{
    unsigned sides = topology->face_size;
    mt_index side = crease.side;
    mt_index middle = topology->vertex_count + topology->face_count + mt_subdivide_edge(topology, side, sides);
    mt_index begin = 4 * side, end = 4 * mt_subdivide_next(topology, side, sides) + 3;
    bool from_a = topology->corner_vertices[side] == crease.edge.a;
    double value = next_sharpness(crease.edge.value);
    if (!(value > 0)) {
        return 0;
    }
    halves[0] = (mt_subdivide_crease){{crease.edge.a, middle, value}, from_a ? begin : end};
    halves[1] = (mt_subdivide_crease){{middle, crease.edge.b, value}, from_a ? end : begin};
    return 2;
}

mt_status mt_subdivide_creases_refine(mt_context *context, mt_subdivide_state *state)
{
    mt_subdivide_crease *refined =
        mt_allocate_array(context, 2 * (uint64_t)state->crease_count, sizeof(mt_subdivide_crease));
    if (!refined) {
        return mt_context_error(context)->status;
    }
    mt_index count = 0;
    for (mt_index i = 0; i < state->crease_count; i++) {
        if (state->creases[i].side == MT_NONE) {
            refined[count++] = state->creases[i];
        } else {
            count += split_crease(&state->topologies[0], state->creases[i], refined + count);
        }
    }
    mt_free(context, state->creases);
    state->creases = refined;
    state->crease_count = count;
    return MT_OK;
}

static mt_status add_sharp_vertices(mt_context *context, const mt_mesh *mesh, unsigned level_count, mt_mesh *result)
{
    result->sharp_vertices =
        mt_allocate_array_zeroed(context, mesh->sharp_vertex_count, sizeof *result->sharp_vertices);
    if (!result->sharp_vertices) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        double value = mesh->sharp_vertices[i].value;
        for (unsigned level = 0; level < level_count; level++) {
            value = next_sharpness(value);
        }
        if (value > 0) {
            mt_vertex_value *vertex = &result->sharp_vertices[result->sharp_vertex_count++];
            vertex->vertex = mesh->sharp_vertices[i].vertex;
            vertex->value = value;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_sharpness_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                        mt_mesh *result)
{
    result->creases = mt_allocate_array(context, state->crease_count, sizeof *result->creases);
    if (!result->creases) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < state->crease_count; i++) {
        result->creases[i] = state->creases[i].edge;
    }
    result->crease_count = state->crease_count;
    return add_sharp_vertices(context, state->mesh, level_count, result);
}
