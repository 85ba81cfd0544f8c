/* Attributes into fields: what the mesh holds in many forms (integers, indices, none) becomes numbers on the vertices
 * of a topology. Cost: O(values); nothing is copied that can be read in place. */
#include "lib/algorithms/subdivide_field.h"

mt_subdivide_carriage mt_subdivide_carriage_of(const mt_attribute *attribute)
{
    bool mixed = mt_semantic_interpolation(attribute->semantic, attribute->type) != MT_INTERPOLATE_NONE;
    switch (attribute->domain) {
    case MT_DOMAIN_VERTEX:
        return MT_SUBDIVIDE_CARRY_FIELD;
    case MT_DOMAIN_CORNER:
        return mixed && attribute->value_count ? MT_SUBDIVIDE_CARRY_FIELD : MT_SUBDIVIDE_CARRY_PARENT;
    case MT_DOMAIN_FACE:
        return MT_SUBDIVIDE_CARRY_PARENT;
    case MT_DOMAIN_MESH:
        break;
    }
    return MT_SUBDIVIDE_CARRY_WHOLE;
}

static mt_index *identity(mt_context *context, mt_index count)
{
    mt_index *numbers = mt_allocate_array(context, count, sizeof *numbers);
    for (mt_index i = 0; numbers && i < count; i++) {
        numbers[i] = i;
    }
    return numbers;
}

/* The values as the file numbers them: linear rules need no more. */
static mt_status add_linear_topology(mt_context *context, mt_subdivide_state *state, const mt_attribute *attribute)
{
    mt_subdivide_topology *topology = &state->topologies[state->topology_count];
    mt_attribute indexed = *attribute;
    mt_index *numbers = NULL;
    if (!attribute->indices) {
        numbers = identity(context, state->mesh->corner_count);
        if (!numbers) {
            return mt_context_error(context)->status;
        }
        indexed.indices = numbers;
    }
    mt_status status = mt_subdivide_topology_of_values(context, &state->topologies[0], &indexed, topology);
    if (status != MT_OK) {
        mt_free(context, numbers);
        return status;
    }
    topology->owned[4] = numbers;
    state->topology_count++;
    return MT_OK;
}

/* Each vertex gets values of its own; *sources tells of each where it comes from. */
static mt_status add_smooth_topology(mt_context *context, mt_subdivide_state *state, const mt_attribute *attribute,
                                     mt_index **sources)
{
    mt_subdivide_topology *base = &state->topologies[0], *topology = &state->topologies[state->topology_count];
    mt_attribute numbered = *attribute;
    mt_status status =
        mt_subdivide_number_values(context, base, attribute, &numbered.indices, sources, &numbered.value_count);
    if (status != MT_OK) {
        return status;
    }
    status = mt_subdivide_topology_of_values(context, base, &numbered, topology);
    if (status != MT_OK) {
        mt_free(context, numbered.indices);
        return status;
    }
    topology->owned[4] = numbered.indices;
    mt_index number = state->topology_count++;
    status = mt_subdivide_find_vertex_corners(context, topology);
    if (status == MT_OK) {
        status = mt_value_rules_create(context, base, topology, &state->sharp, &state->settings,
                                       &state->value_rules[number]);
    }
    return status;
}

/* The value of each element as numbers that the rules take; 0 where an element has none. */
static void *widen_values(mt_context *context, const mt_attribute *attribute, const mt_index *sources, mt_index count,
                          mt_type type, bool *misses)
{
    uint32_t width = attribute->component_count;
    bool by_value = attribute->domain == MT_DOMAIN_CORNER;
    mt_attribute wide = {.type = type, .component_count = width};
    wide.values = mt_allocate_array(context, count, width * mt_type_size(type));
    for (mt_index element = 0; wide.values && element < count; element++) {
        mt_index value = sources ? sources[element] : by_value ? element : mt_attribute_value_index(attribute, element);
        *misses = *misses || value == MT_NONE;
        for (uint32_t k = 0; k < width; k++) {
            mt_attribute_set(&wide, element, k, value == MT_NONE ? 0 : mt_attribute_get(attribute, value, k));
        }
    }
    return wide.values;
}

static bool is_float(mt_type type)
{
    return type == MT_F32 || type == MT_F64;
}

/* sources: per value of the field one of the attribute's; NULL: as they are. */
static mt_status fill_field(mt_context *context, mt_subdivide_field *field, const mt_attribute *attribute,
                            const mt_index *sources, mt_index count)
{
    bool as_they_are = !sources && (attribute->domain == MT_DOMAIN_CORNER || !attribute->indices);
    bool in_place = is_float(attribute->type) && as_they_are;
    field->component_count = attribute->component_count;
    if (in_place) {
        field->type = attribute->type;
        field->values = attribute->values;
        return MT_OK;
    }
    bool four_bytes = mt_type_size(attribute->type) == 4 && attribute->type != MT_F32;
    bool misses = false;
    field->type = attribute->type == MT_F64 || four_bytes ? MT_F64 : MT_F32;
    field->values = field->owned = widen_values(context, attribute, sources, count, field->type, &misses);
    if (misses && attribute->domain == MT_DOMAIN_VERTEX) {
        mt_warn(context, "vertices without a value of the attribute \"%s\" take part with 0", attribute->name);
    }
    return field->owned ? MT_OK : mt_context_error(context)->status;
}

static mt_subdivide_rule smooth_rule(mt_subdivide_face_varying option)
{
    bool still = option == MT_SUBDIVIDE_FACE_VARYING_BOUNDARIES;
    return still ? MT_SUBDIVIDE_SMOOTH_BUT_BOUNDARY : MT_SUBDIVIDE_SMOOTH;
}

/* UVs that a file gave by vertex have no seam, and are face-varying like others. */
static mt_status add_vertex_uvs(mt_context *context, mt_subdivide_state *state, const mt_attribute *attribute,
                                mt_subdivide_field *field)
{
    mt_subdivide_face_varying option = state->settings.face_varying;
    mt_value_rules *rules = &state->value_rules[0];
    mt_status status = MT_OK;
    field->rule = MT_SUBDIVIDE_LINEAR;
    if (option != MT_SUBDIVIDE_FACE_VARYING_ALL) {
        const mt_subdivide_topology *topology = &state->topologies[0];
        field->rule = smooth_rule(option);
        field->face_varying = true;
        if (!rules->smooth) {
            status = mt_value_rules_create(context, topology, topology, &state->sharp, &state->settings, rules);
        }
    }
    return status == MT_OK ? fill_field(context, field, attribute, NULL, state->mesh->vertex_count) : status;
}

static mt_status add_corner_field(mt_context *context, mt_subdivide_state *state, const mt_attribute *attribute,
                                  mt_subdivide_field *field)
{
    mt_subdivide_face_varying option = state->settings.face_varying;
    mt_index *sources = NULL;
    field->topology = state->topology_count;
    if (option == MT_SUBDIVIDE_FACE_VARYING_ALL) {
        field->rule = MT_SUBDIVIDE_LINEAR;
        mt_status status = add_linear_topology(context, state, attribute);
        return status == MT_OK ? fill_field(context, field, attribute, NULL, attribute->value_count) : status;
    }
    field->rule = smooth_rule(option);
    field->face_varying = true;
    mt_status status = add_smooth_topology(context, state, attribute, &sources);
    if (status == MT_OK) {
        mt_index count = state->topologies[field->topology].vertex_count;
        status = fill_field(context, field, attribute, sources, count);
    }
    mt_free(context, sources);
    return status;
}

static mt_status add_field(mt_context *context, mt_subdivide_state *state, mt_index number)
{
    const mt_attribute *attribute = &state->mesh->attributes[number];
    mt_subdivide_field *field = &state->fields[state->field_count++];
    *field = (mt_subdivide_field){.attribute = number};
    if (attribute->domain == MT_DOMAIN_CORNER) {
        return add_corner_field(context, state, attribute, field);
    }
    if (attribute->semantic == MT_SEMANTIC_UV) {
        return add_vertex_uvs(context, state, attribute, field);
    }
    if (mt_semantic_interpolation(attribute->semantic, attribute->type) != MT_INTERPOLATE_NONE) {
        return fill_field(context, field, attribute, NULL, state->mesh->vertex_count);
    }
    field->rule = MT_SUBDIVIDE_ORIGIN;
    field->type = MT_U32;
    field->component_count = 1;
    field->values = field->owned = identity(context, state->mesh->vertex_count);
    return field->owned ? MT_OK : mt_context_error(context)->status;
}

mt_status mt_subdivide_fields_create(mt_context *context, mt_subdivide_state *state)
{
    const mt_mesh *mesh = state->mesh;
    state->fields = mt_allocate_array_zeroed(context, (uint64_t)mesh->attribute_count + 1, sizeof *state->fields);
    if (!state->fields) {
        return mt_context_error(context)->status;
    }
    state->fields[0] = (mt_subdivide_field){
        .attribute = MT_NONE, .type = mesh->position_type, .component_count = 3, .values = mesh->positions};
    state->field_count = 1;
    state->value_rules =
        mt_allocate_array_zeroed(context, (uint64_t)mesh->attribute_count + 1, sizeof *state->value_rules);
    if (!state->value_rules) {
        return mt_context_error(context)->status;
    }
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < mesh->attribute_count; i++) {
        if (mt_subdivide_carriage_of(&mesh->attributes[i]) == MT_SUBDIVIDE_CARRY_FIELD) {
            status = add_field(context, state, i);
        }
    }
    return status;
}

void *mt_subdivide_field_target(const mt_subdivide_state *state, const mt_subdivide_field *field, const mt_mesh *result)
{
    if (field->attribute == MT_NONE) {
        return result->positions;
    }
    bool same_type = state->mesh->attributes[field->attribute].type == field->type;
    return same_type && field->rule != MT_SUBDIVIDE_ORIGIN ? result->attributes[field->attribute].values : NULL;
}
