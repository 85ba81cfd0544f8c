/* Catmull-Clark, level by level: pair the edges once, refuse what the rules cannot take, then let closed forms make
 * each level from the one before.
 *
 * Sources: Catmull and Clark (1978) for the rules (subdivide_values.c); Dupuy and Vanhoey (2021) for the layout
 * (subdivide_topology.c). Cost: linear in the result; beside it there live at most the level before, with 24 bytes a
 * face for its connectivity, and the edge pairs while level 1 is made. Known failure: values past a sixteenth of the
 * largest double overflow. */
#include <meshtool/subdivide.h>

#include "lib/algorithms/subdivide_count.h"
#include "lib/algorithms/subdivide_crease.h"
#include "lib/algorithms/subdivide_level.h"
#include "lib/algorithms/subdivide_limit.h"
#include "lib/algorithms/subdivide_rings.h"
#include "lib/algorithms/subdivide_settings.h"
#include "lib/algorithms/subdivide_trim.h"

#include <meshtool/refusal.h>

#include <string.h>

#define TASK "subdividing"

static const char *who_needs(mt_subdivide_scheme scheme)
{
    return scheme == MT_SUBDIVIDE_SCHEME_LOOP ? "Loop subdivision needs" : "Catmull-Clark needs";
}

static void release_state(mt_context *context, mt_subdivide_state *state)
{
    for (mt_index i = 0; i < state->topology_count; i++) {
        mt_subdivide_topology_release(context, &state->topologies[i]);
    }
    for (mt_index i = 0; i < state->field_count; i++) {
        mt_free(context, state->fields[i].owned);
    }
    for (mt_index i = 0; state->value_rules && i < state->topology_count; i++) {
        mt_value_rules_release(context, &state->value_rules[i]);
    }
    mt_free(context, state->value_rules);
    mt_free(context, state->topologies);
    mt_free(context, state->fields);
    mt_subdivide_sharp_release(context, &state->sharp);
    mt_free(context, state->sharp_vertices);
    mt_free(context, state->holes);
    memset(state, 0, sizeof *state);
}

static mt_status check_sizes(mt_context *context, const mt_subdivide_state *state, unsigned level_count)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < state->topology_count; i++) {
        const mt_subdivide_topology *topology = &state->topologies[i];
        mt_subdivide_size size = {topology->vertex_count, topology->face_count, topology->corner_count,
                                  topology->edge_count};
        size = mt_subdivide_size_at(state->settings.scheme, size, level_count);
        status = mt_subdivide_check_size(context, &size, level_count);
    }
    return status;
}

static mt_status check_rings(mt_context *context, const mt_mesh *mesh, const mt_subdivide_topology *topology)
{
    mt_index count = 0;
    mt_status status = mt_subdivide_count_ring_corners(context, topology, &count);
    if (status != MT_OK || count == topology->corner_count) {
        return status;
    }
    return mt_refuse_vertex(context, mesh, who_needs(topology->scheme));
}

/* Everything of level 0. */
static mt_status begin_state(mt_context *context, const mt_edge_pairs *pairs, unsigned level_count,
                             mt_subdivide_state *state)
{
    const mt_mesh *mesh = state->mesh;
    state->topologies =
        mt_allocate_array_zeroed(context, (uint64_t)mesh->attribute_count + 1, sizeof *state->topologies);
    if (!state->topologies) {
        return mt_context_error(context)->status;
    }
    mt_status status = mt_subdivide_topology_of_mesh(context, mesh, pairs, &state->topologies[0]);
    if (status == MT_OK) {
        state->topology_count = 1;
        state->topologies[0].scheme = state->settings.scheme;
        status = check_rings(context, mesh, &state->topologies[0]);
    }
    if (status == MT_OK && !state->cut) {
        status = mt_subdivide_holes(context, mesh, pairs, &state->settings, &state->holes);
    }
    if (status == MT_OK) {
        status = mt_subdivide_creases_create(context, state);
    }
    if (status == MT_OK) {
        status = mt_subdivide_fields_create(context, state);
    }
    return status == MT_OK ? check_sizes(context, state, level_count) : status;
}

/* A mesh of the last level's size, with what it inherits as a whole: wires, points, names, libraries. */
static mt_status create_result(mt_context *context, const mt_subdivide_state *state, mt_mesh **out)
{
    mt_mesh shell = *state->mesh;
    shell.vertex_count = shell.face_count = shell.corner_count = shell.attribute_count = 0;
    shell.crease_count = shell.sharp_vertex_count = 0;
    shell.positions = NULL;
    shell.corner_vertices = shell.face_offsets = NULL;
    shell.creases = NULL;
    shell.sharp_vertices = NULL;
    shell.face_size = state->settings.scheme == MT_SUBDIVIDE_SCHEME_LOOP ? 3 : 4;
    shell.welded = false;
    mt_mesh *result;
    mt_status status = mt_mesh_copy(context, &shell, &result);
    if (status != MT_OK) {
        return status;
    }
    const mt_subdivide_topology *last = &state->topologies[0];
    result->vertex_count = (mt_index)mt_subdivide_child_vertex_count(last);
    result->corner_count = 4 * last->corner_count;
    result->face_count = result->corner_count / result->face_size;
    result->positions = mt_allocate_array(context, result->vertex_count, 3 * mt_type_size(result->position_type));
    result->corner_vertices = mt_allocate_array(context, result->corner_count, sizeof(mt_index));
    status = result->positions && result->corner_vertices ? mt_subdivide_attributes_add(context, state, result)
                                                          : mt_context_error(context)->status;
    if (status != MT_OK) {
        mt_mesh_destroy(context, result);
        return status;
    }
    *out = result;
    return MT_OK;
}

static const char *level_name(unsigned level)
{
    static const char names[MT_SUBDIVIDE_LEVEL_LIMIT + 1][9] = {
        "level 0",  "level 1",  "level 2",  "level 3",  "level 4",  "level 5",  "level 6",  "level 7",
        "level 8",  "level 9",  "level 10", "level 11", "level 12", "level 13", "level 14", "level 15",
        "level 16", "level 17", "level 18", "level 19", "level 20", "level 21", "level 22", "level 23",
        "level 24", "level 25", "level 26", "level 27", "level 28", "level 29", "level 30", "level 31"};
    return names[level];
}

static mt_status refine_levels(mt_context *context, mt_subdivide_state *state, unsigned level_count, mt_mesh **result)
{
    mt_status status = MT_OK;
    double share = 1;
    for (unsigned level = 1; level < level_count; level++) {
        share *= 0.25; /* each level is four times the work of the one before */
    }
    for (unsigned level = 1; status == MT_OK && level <= level_count; level++, share *= 4) {
        int part = mt_part_begin(context, level_name(level), "asked for");
        status = mt_progress(context, TASK, share * 0.25);
        if (status == MT_OK && level == level_count) {
            status = create_result(context, state, result);
        }
        if (status == MT_OK) {
            status = mt_subdivide_level(context, state, *result);
        }
        mt_part_end(context, part);
    }
    return status;
}

/* Labels, attributes and sharpness of the finished mesh. */
static mt_status finish_result(mt_context *context, mt_subdivide_state *state, unsigned level_count, mt_mesh *result)
{
    const mt_mesh *mesh = state->mesh;
    for (mt_index i = 0; i < result->label_set_count; i++) {
        mt_labels *labels = &result->label_sets[i];
        mt_free(context, labels->face_labels);
        labels->face_labels = mt_allocate_array(context, result->face_count, sizeof(mt_index));
        if (!labels->face_labels) {
            return mt_context_error(context)->status;
        }
        mt_subdivide_spread(context, state, true, level_count, sizeof(mt_index), mesh->label_sets[i].face_labels,
                            labels->face_labels);
    }
    mt_subdivide_attributes_finish(context, state, level_count, result);
    return mt_subdivide_creases_finish(context, state, level_count, result);
}

static void warn_of_normals(mt_context *context, const mt_mesh *mesh, bool limit)
{
    if (limit) {
        return;
    }
    if (mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX) ||
        mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER)) {
        mt_warn(context, "normals were interpolated from the coarse mesh's, and are not quite those of the "
                         "refined surface");
    }
}

static mt_status move_to_limit(mt_context *context, mt_subdivide_state *state, mt_mesh *result)
{
    int part = mt_part_begin(context, "limit", "asked for");
    mt_status status = mt_subdivide_to_limit(context, state, result);
    mt_part_end(context, part);
    return status;
}

/* A copy of the mesh, whose faces must all be of the scheme: then the limit's masks hold. */
static mt_status copy_regular(mt_context *context, const mt_subdivide_state *state, mt_mesh **result)
{
    const mt_mesh *mesh = state->mesh;
    if (state->topologies[0].face_size == (state->settings.scheme == MT_SUBDIVIDE_SCHEME_LOOP ? 3 : 4) ||
        mesh->face_count == 0) {
        return mt_mesh_copy(context, mesh, result);
    }
    mt_index face = 0;
    while (face + 1 < mesh->face_count && mt_mesh_face_end(mesh, face) - mt_mesh_face_begin(mesh, face) == 4) {
        face++;
    }
    return mt_fail(context, MT_ERROR_INVALID_MESH,
                   "face %u has %u sides, and the limit of level 0 is known for quads alone: ask for a level or more",
                   face, mt_mesh_face_end(mesh, face) - mt_mesh_face_begin(mesh, face));
}

/* All levels, and the limit where it is asked for. */
static mt_status make_result(mt_context *context, mt_subdivide_state *state, unsigned level_count, mt_mesh **result)
{
    if (level_count == 0) {
        mt_status status = copy_regular(context, state, result);
        return status == MT_OK ? move_to_limit(context, state, *result) : status;
    }
    mt_status status = refine_levels(context, state, level_count, result);
    if (!state->settings.limit) {
        mt_part_skip(context, "limit", "not asked for");
    }
    if (status == MT_OK) {
        status = finish_result(context, state, level_count, *result);
    }
    if (status == MT_OK && state->settings.limit) {
        status = move_to_limit(context, state, *result);
    }
    if (status == MT_OK && state->cut) {
        status = mt_subdivide_cut_join(context, state->cut, result);
    }
    if (status == MT_OK && state->holes) {
        status = mt_subdivide_trim(context, state->mesh, state->holes, level_count, result);
    }
    return status;
}

/* The state has its mesh and settings, whatever becomes of it. */
static mt_status subdivide_state(mt_context *context, const mt_edge_pairs *pairs, mt_subdivide_state *state,
                                 mt_mesh **out)
{
    unsigned level_count = state->settings.no_levels ? 0 : state->settings.level_count;
    mt_mesh *result = NULL;
    mt_status status = mt_refuse_sides(context, state->mesh, pairs, who_needs(state->settings.scheme));
    if (status == MT_OK) {
        status = begin_state(context, pairs, level_count, state);
    }
    if (status == MT_OK) {
        status = make_result(context, state, level_count, &result);
    }
    if (status == MT_OK) {
        status = mt_progress(context, TASK, 1);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, result);
        return status;
    }
    warn_of_normals(context, state->mesh, state->settings.limit);
    *out = result;
    return MT_OK;
}

static mt_status subdivide_paired(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                  const mt_subdivide_options *settings, mt_mesh **out)
{
    mt_subdivide_state state = {.mesh = mesh, .settings = *settings};
    mt_status status = subdivide_state(context, pairs, &state, out);
    release_state(context, &state);
    return status;
}

/* Cut apart, refined, joined again. What was asked to be sharp is in the mesh of the cut. */
static mt_status subdivide_cut(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                               const mt_subdivide_options *settings, mt_mesh **out)
{
    mt_subdivide_cut cut = {0};
    mt_edge_pairs *cut_pairs = NULL;
    mt_subdivide_state state = {.settings = *settings, .cut = &cut};
    state.settings.crease_angle = 0;
    state.settings.crease_count = state.settings.sharp_vertex_count = 0;
    mt_status status = mt_subdivide_holes(context, mesh, pairs, settings, &state.holes);
    if (status == MT_OK) {
        status = mt_subdivide_cut_create(context, mesh, pairs, settings, &cut);
    }
    if (status == MT_OK) {
        state.mesh = cut.mesh;
        status = mt_edge_pairs_create(context, cut.mesh, &cut_pairs);
    }
    if (status == MT_OK) {
        status = subdivide_state(context, cut_pairs, &state, out);
    }
    release_state(context, &state);
    mt_subdivide_cut_release(context, &cut);
    mt_edge_pairs_destroy(context, cut_pairs);
    return status;
}

static mt_status check_triangles(mt_context *context, const mt_mesh *mesh)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_end(mesh, face) - mt_mesh_face_begin(mesh, face);
        if (sides != 3) {
            return mt_fail(context, MT_ERROR_INVALID_MESH,
                           "face %u has %u sides; Loop subdivision needs triangles: `meshtool convert --triangulate` "
                           "makes them",
                           face, sides);
        }
    }
    return MT_OK;
}

/* What is too large whatever the edges are is refused before any memory is taken. */
static mt_status check_corners(mt_context *context, const mt_mesh *mesh, mt_subdivide_scheme scheme,
                               unsigned level_count)
{
    mt_subdivide_size size = {mesh->vertex_count, mesh->face_count, mesh->corner_count, mesh->corner_count / 2};
    size = mt_subdivide_size_at(scheme, size, level_count);
    return mt_subdivide_check_size(context, &size, level_count);
}

mt_status mt_subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options, mt_mesh **out)
{
    mt_subdivide_options settings;
    *out = NULL;
    if (options && options->no_levels && !options->limit) {
        return mt_mesh_copy(context, mesh, out);
    }
    mt_status status = mt_subdivide_settle(context, mesh, options, &settings);
    if (status == MT_OK && settings.scheme == MT_SUBDIVIDE_SCHEME_LOOP) {
        status = check_triangles(context, mesh);
    }
    if (status == MT_OK) {
        status = check_corners(context, mesh, settings.scheme, settings.no_levels ? 0 : settings.level_count);
    }
    if (status != MT_OK) {
        return status;
    }
    mt_edge_pairs *pairs;
    status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        bool cuts = settings.non_manifold == MT_SUBDIVIDE_NON_MANIFOLD_SHARP;
        status = (cuts ? subdivide_cut : subdivide_paired)(context, mesh, pairs, &settings, out);
        mt_edge_pairs_destroy(context, pairs);
    }
    return status;
}
