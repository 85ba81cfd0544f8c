/* One level from the one before: planned whole, so that nothing can fail half-way, then run. */
#include "lib/algorithms/subdivide_level.h"

#include "lib/algorithms/subdivide_patch.h"

#include <string.h>

/* Of a topology the array of the result that its last corners go to. */
static mt_index *last_corners_of(const mt_subdivide_state *state, mt_index topology, const mt_mesh *result)
{
    for (mt_index i = 1; topology && i < state->field_count; i++) {
        if (state->fields[i].topology == topology) {
            return result->attributes[state->fields[i].attribute].indices;
        }
    }
    return result->corner_vertices;
}

/* One level in the making. */
typedef struct level_plan {
    mt_subdivide_pass first, second, third; /* face points; all the rest; what is sharp */
    mt_subdivide_topology *children;
    void **targets; /* per field its next values */
    void **owned;   /* those of them that are not the result's */
    mt_subdivide_patches patches;
    mt_subdivide_sharp sharp;        /* at the next level */
    mt_index *vertex_images;         /* of the sharp vertices there */
    mt_vertex_patch **value_patches; /* per topology, of values that stay */
    mt_value_rules *value_rules;     /* at the next level */
} level_plan;

static mt_status create_plan(mt_context *context, const mt_subdivide_state *state, level_plan *plan)
{
    size_t loop_count = 2 * (size_t)state->topology_count;
    for (mt_index i = 0; i < state->field_count; i++) {
        loop_count += mt_subdivide_values_loop_count(state->fields[i].component_count) + 1;
    }
    mt_index face_count = state->topologies[0].face_count;
    plan->children = mt_allocate_array_zeroed(context, state->topology_count, sizeof *plan->children);
    plan->targets = mt_allocate_array_zeroed(context, state->field_count, sizeof *plan->targets);
    plan->owned = mt_allocate_array_zeroed(context, state->field_count, sizeof *plan->owned);
    plan->value_patches = mt_allocate_array_zeroed(context, state->topology_count, sizeof *plan->value_patches);
    plan->value_rules = mt_allocate_array_zeroed(context, state->topology_count, sizeof *plan->value_rules);
    bool complete = plan->children && plan->targets && plan->owned && plan->value_patches && plan->value_rules &&
                    mt_subdivide_pass_init(context, face_count, loop_count, &plan->first) == MT_OK &&
                    mt_subdivide_pass_init(context, face_count, loop_count, &plan->second) == MT_OK &&
                    mt_subdivide_pass_init(context, face_count, 3 * (size_t)state->field_count, &plan->third) == MT_OK;
    return complete ? MT_OK : mt_context_error(context)->status;
}

/* Of a plan that was carried out only the shell is left. */
static void release_plan(mt_context *context, const mt_subdivide_state *state, level_plan *plan)
{
    for (mt_index i = 0; plan->children && i < state->topology_count; i++) {
        mt_subdivide_topology_release(context, &plan->children[i]);
    }
    for (mt_index i = 0; plan->value_patches && plan->value_rules && i < state->topology_count; i++) {
        mt_free(context, plan->value_patches[i]);
        mt_value_rules_release(context, &plan->value_rules[i]);
    }
    mt_free(context, plan->value_patches);
    mt_free(context, plan->value_rules);
    mt_free(context, plan->vertex_images);
    for (mt_index i = 0; plan->owned && i < state->field_count; i++) {
        mt_free(context, plan->owned[i]);
    }
    mt_free(context, plan->children);
    mt_free(context, plan->targets);
    mt_free(context, plan->owned);
    mt_subdivide_pass_release(context, &plan->first);
    mt_subdivide_pass_release(context, &plan->second);
    mt_subdivide_pass_release(context, &plan->third);
    mt_subdivide_patches_release(context, &plan->patches);
    mt_subdivide_sharp_release(context, &plan->sharp);
}

/* Of a smooth field what does not follow the rule for all. */
static void plan_patches(const mt_subdivide_state *state, mt_index number, const mt_subdivide_loop *values,
                         level_plan *plan)
{
    const mt_subdivide_field *field = &state->fields[number];
    const mt_value_rules *rules = &state->value_rules[field->topology];
    bool wide = field->type == MT_F64;
    mt_subdivide_patches_add(values, &state->sharp, &plan->patches, field->face_varying ? rules->apart : NULL, wide,
                             &plan->third);
    if (field->face_varying) {
        mt_subdivide_vertex_patches_add(values, plan->value_patches[field->topology], NULL,
                                        (uint64_t)rules->fixed_count + rules->fading_count, wide, &plan->third);
    }
}

/* The next values of a field: in the result where they can, else in memory of their own. */
static mt_status plan_field(mt_context *context, const mt_subdivide_state *state, mt_index number,
                            const mt_mesh *result, level_plan *plan)
{
    const mt_subdivide_field *field = &state->fields[number];
    const mt_subdivide_topology *topology = &state->topologies[field->topology];
    void *target = result ? mt_subdivide_field_target(state, field, result) : NULL;
    if (!target) {
        size_t size = field->component_count * mt_type_size(field->type);
        target = mt_allocate_array(context, mt_subdivide_child_vertex_count(topology), size);
        plan->owned[number] = target;
    }
    if (!target) {
        return mt_context_error(context)->status;
    }
    plan->targets[number] = target;
    mt_subdivide_values_plan(topology, field->rule, field->type, field->component_count, field->values, target,
                             &plan->first, &plan->second);
    if (field->rule == MT_SUBDIVIDE_SMOOTH || field->rule == MT_SUBDIVIDE_SMOOTH_BUT_BOUNDARY) {
        mt_subdivide_loop values = {.topology = topology, .source = field->values, .target = target};
        values.stride = field->component_count;
        if (topology->level == 0 && topology->scheme == MT_SUBDIVIDE_SCHEME_CATMULL_CLARK && topology->face_size != 4 &&
            state->settings.triangles == MT_SUBDIVIDE_TRIANGLES_SMOOTH) {
            mt_subdivide_triangles_plan(topology, field->type, field->component_count, field->values, target,
                                        &plan->second);
        }
        plan_patches(state, number, &values, plan);
    }
    return MT_OK;
}

/* The rules at sharp vertices and edges, and what is sharp at the next level. */
static mt_status plan_sharp(mt_context *context, mt_subdivide_state *state, level_plan *plan)
{
    if (state->sharp.vertex_count == 0 && state->sharp.edge_count == 0) {
        return MT_OK;
    }
    const mt_subdivide_topology *topology = &state->topologies[0];
    mt_status status = mt_subdivide_sharp_plan(context, topology, &state->sharp, &plan->patches);
    if (status == MT_OK) {
        status = mt_subdivide_sharp_refine(context, topology, &state->sharp, &plan->patches, &plan->sharp,
                                           &plan->vertex_images);
    }
    return status;
}

static mt_status plan_value_rules(mt_context *context, const mt_subdivide_state *state, mt_index number,
                                  level_plan *plan)
{
    const mt_value_rules *rules = &state->value_rules[number];
    const mt_subdivide_topology *topology = &state->topologies[number];
    if (!rules->smooth) {
        return MT_OK;
    }
    mt_status status = mt_value_rules_plan(context, topology, &state->sharp, plan->patches.halves, rules,
                                           &plan->value_patches[number]);
    if (status == MT_OK) {
        status = mt_value_rules_refine(context, topology, &state->sharp, plan->patches.halves, rules, &plan->sharp,
                                       plan->vertex_images, &plan->value_rules[number]);
    }
    return status;
}

static mt_status plan_topology(mt_context *context, const mt_subdivide_state *state, mt_index number,
                               const mt_mesh *result, level_plan *plan)
{
    mt_subdivide_topology *topology = &state->topologies[number], *child = &plan->children[number];
    bool walked = number == 0 || state->value_rules[number].smooth;
    if (walked && topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP && topology->level > 0 &&
        mt_subdivide_find_vertex_corners(context, topology) != MT_OK) {
        return mt_context_error(context)->status;
    }
    mt_index *corners = result ? last_corners_of(state, number, result)
                               : mt_allocate_array(context, 4 * (uint64_t)topology->corner_count, sizeof *corners);
    if (!corners) {
        return mt_context_error(context)->status;
    }
    bool last = result && !(state->settings.limit && number == 0);
    mt_status status = mt_subdivide_topology_plan(context, topology, corners, last, child, &plan->second);
    if (!result) {
        child->owned[3] = corners;
    }
    return status;
}

/* Puts the next level in the place of this one. */
static void advance_state(mt_context *context, mt_subdivide_state *state, level_plan *plan)
{
    for (mt_index i = 0; i < state->field_count; i++) {
        mt_free(context, state->fields[i].owned);
        state->fields[i].owned = plan->owned[i];
        state->fields[i].values = plan->targets[i];
        plan->owned[i] = NULL;
    }
    for (mt_index i = 0; i < state->topology_count; i++) {
        mt_subdivide_topology_release(context, &state->topologies[i]);
    }
    for (mt_index i = 0; i < state->topology_count; i++) {
        mt_value_rules_release(context, &state->value_rules[i]);
        state->value_rules[i] = plan->value_rules[i];
        memset(&plan->value_rules[i], 0, sizeof plan->value_rules[i]);
    }
    mt_free(context, state->topologies);
    state->topologies = plan->children;
    plan->children = NULL;
    plan->sharp.missing_count = state->sharp.missing_count;
    plan->sharp.missing = state->sharp.missing;
    state->sharp.missing = NULL;
    mt_subdivide_sharp_release(context, &state->sharp);
    state->sharp = plan->sharp;
    memset(&plan->sharp, 0, sizeof plan->sharp);
}

mt_status mt_subdivide_level(mt_context *context, mt_subdivide_state *state, const mt_mesh *result)
{
    level_plan plan = {0};
    mt_status status = create_plan(context, state, &plan);
    for (mt_index i = 0; status == MT_OK && i < state->topology_count; i++) {
        status = plan_topology(context, state, i, result, &plan);
    }
    if (status == MT_OK) {
        status = plan_sharp(context, state, &plan);
    }
    if (status == MT_OK && state->cut) {
        status = mt_subdivide_cut_refine(context, &state->topologies[0], state->cut);
    }
    for (mt_index i = 0; status == MT_OK && i < state->topology_count; i++) {
        status = plan_value_rules(context, state, i, &plan);
    }
    for (mt_index i = 0; status == MT_OK && i < state->field_count; i++) {
        status = plan_field(context, state, i, result, &plan);
    }
    if (status == MT_OK) {
        mt_subdivide_pass_run(context, &plan.first);
        mt_subdivide_pass_run(context, &plan.second);
        mt_subdivide_pass_run(context, &plan.third);
        advance_state(context, state, &plan);
    }
    release_plan(context, state, &plan);
    return status;
}
