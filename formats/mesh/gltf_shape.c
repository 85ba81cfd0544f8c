/* A mesh of the file becomes a shape: its primitives' vertices and elements. Primitives that name the same accessors
 * for their vertices share them; nothing else is joined. */
#include "formats/mesh/gltf.h"

#include <stdlib.h>
#include <string.h>

/* The set number in "TEXCOORD_3", or MT_GLTF_SETS when it is none that is kept. */
static unsigned set_number(const char *digits)
{
    return digits[0] >= '0' && digits[0] < '0' + MT_GLTF_SETS && !digits[1] ? (unsigned)(digits[0] - '0')
                                                                            : MT_GLTF_SETS;
}

unsigned mt_gltf_slot_of(const char *name)
{
    unsigned set = MT_GLTF_SETS, first = MT_GLTF_UV;
    if (strcmp(name, "POSITION") == 0) {
        return MT_GLTF_SLOT_COUNT;
    }
    if (strcmp(name, "NORMAL") == 0) {
        return MT_GLTF_NORMAL;
    }
    if (strncmp(name, "TEXCOORD_", 9) == 0) {
        set = set_number(name + 9);
    } else if (strncmp(name, "COLOR_", 6) == 0) {
        set = set_number(name + 6);
        first = MT_GLTF_COLOR;
    }
    return set < MT_GLTF_SETS ? first + set : MT_GLTF_SLOT_COUNT + 1;
}

/* What the specification and KHR_mesh_quantization allow, and what makes sense of the numbers. */
mt_status mt_gltf_check_attribute(mt_gltf_file *file, const mt_json_node *place, unsigned slot,
                                  const mt_gltf_values *values)
{
    bool color = slot >= MT_GLTF_COLOR && slot < MT_GLTF_SLOT_COUNT;
    bool uv = slot >= MT_GLTF_UV && slot < MT_GLTF_COLOR;
    unsigned count = values->component_count;
    if (color ? count != 3 && count != 4 : count != (uv ? 2u : 3u)) {
        return mt_json_fail(file->context, place, MT_ERROR_SYNTAX, "the accessor has %u components, expected %s", count,
                            color ? "3 or 4"
                            : uv  ? "2"
                                  : "3");
    }
    bool small = values->type != MT_U32;
    if (!small || (color && (values->type == MT_I8 || values->type == MT_I16))) {
        return mt_json_fail(file->context, place, MT_ERROR_SYNTAX,
                            "the accessor's componentType is none that this attribute may have");
    }
    return MT_OK;
}

mt_gltf_values *mt_gltf_slot_values(mt_gltf_vertices *set, unsigned slot)
{
    return slot == MT_GLTF_SLOT_COUNT ? &set->positions : &set->slots[slot];
}

void mt_gltf_drop(mt_gltf_file *file, const char *name)
{
    bool known = file->dropped_count == MT_GLTF_DROPPED;
    for (size_t i = 0; i < file->dropped_count; i++) {
        known = known || strcmp(file->dropped[i], name) == 0;
    }
    if (!known) {
        file->dropped[file->dropped_count++] = name;
    }
}

static mt_status read_attribute(mt_gltf_file *file, const mt_json_node *attributes, const char *key,
                                mt_gltf_vertices *set)
{
    unsigned slot = mt_gltf_slot_of(key);
    mt_json_node accessor, place = mt_json_member(attributes, key);
    if (slot > MT_GLTF_SLOT_COUNT) {
        mt_gltf_drop(file, key);
        return MT_OK;
    }
    mt_gltf_values *values = mt_gltf_slot_values(set, slot);
    mt_status status = mt_gltf_refer(file, attributes, key, MT_JSON_REQUIRED, MT_GLTF_ACCESSORS, &accessor, NULL);
    if (status == MT_OK) {
        status = mt_gltf_accessor(file, &accessor, values);
    }
    return status == MT_OK ? mt_gltf_check_attribute(file, &place, slot, values) : status;
}

static mt_status check_counts(mt_gltf_file *file, const mt_json_node *attributes, const mt_gltf_vertices *set)
{
    for (unsigned slot = 0; slot < MT_GLTF_SLOT_COUNT; slot++) {
        if (set->slots[slot].count != 0 && set->slots[slot].count != set->positions.count) {
            return mt_json_fail(file->context, attributes, MT_ERROR_SYNTAX,
                                "the accessors have different counts, %llu and %llu",
                                (unsigned long long)set->positions.count, (unsigned long long)set->slots[slot].count);
        }
    }
    return MT_OK;
}

/* The accessors behind the attributes. A primitive without positions has none, and draws nothing (section 3.7.2.1). */
static mt_status read_vertices(mt_gltf_file *file, const mt_json_node *attributes, mt_gltf_vertices *set)
{
    const char *key;
    json_t *value;
    mt_status status = MT_OK;
    json_object_foreach(attributes->value, key, value)
    {
        status = status == MT_OK ? read_attribute(file, attributes, key, set) : status;
    }
    return status == MT_OK ? check_counts(file, attributes, set) : status;
}

static mt_status read_indices(mt_gltf_file *file, const mt_json_node *primitive, mt_gltf_values *out)
{
    mt_json_node accessor;
    *out = (mt_gltf_values){0};
    mt_status status = mt_gltf_refer(file, primitive, "indices", MT_JSON_OPTIONAL, MT_GLTF_ACCESSORS, &accessor, NULL);
    if (status != MT_OK || !accessor.value) {
        return status;
    }
    status = mt_gltf_accessor(file, &accessor, out);
    bool right = out->component_count == 1 && (out->type == MT_U8 || out->type == MT_U16 || out->type == MT_U32);
    return status != MT_OK || right
               ? status
               : mt_json_fail(file->context, &accessor, MT_ERROR_SYNTAX, "indices must be unsigned SCALARs");
}

static mt_status read_material(mt_gltf_file *file, const mt_json_node *primitive, mt_index *out)
{
    mt_json_node material;
    size_t index = 0;
    mt_status status =
        mt_gltf_refer(file, primitive, "material", MT_JSON_OPTIONAL, MT_GLTF_MATERIALS, &material, &index);
    *out = material.value ? (mt_index)index : MT_NONE;
    return status;
}

/* Where the vertices of a primitive begin in its shape: those of an earlier one, when both name the same accessors. */
static mt_gltf_vertices *share_or_add(mt_gltf_shape *shape, json_t *attributes, size_t *latest, bool *shared)
{
    json_t *positions = json_object_get(attributes, "POSITION");
    mt_gltf_vertices *set = *latest < shape->set_count ? &shape->sets[*latest] : NULL;
    *shared = positions && set && json_equal(set->attributes, attributes);
    if (!*shared) {
        *latest = shape->set_count;
        set = &shape->sets[shape->set_count++];
        *set = (mt_gltf_vertices){.attributes = attributes, .begin = shape->vertex_count};
    }
    return set;
}

static void count_elements(mt_gltf_shape *shape, const mt_gltf_elements *elements)
{
    switch (elements->corner_count) {
    case 3:
        shape->triangle_count += elements->count / 3;
        break;
    case 2:
        shape->wire_count += elements->count / 2;
        shape->wire_vertex_count += elements->count;
        break;
    case 1:
        shape->point_count += elements->count;
        break;
    default:
        shape->wire_count += elements->count > 0;
        shape->wire_vertex_count += elements->count;
    }
}

/* One primitive; latest[a] is the set that was last made with accessor a for its positions. */
static mt_status read_primitive(mt_gltf_file *file, const mt_json_node *primitive, size_t *latest, mt_gltf_shape *shape)
{
    mt_gltf_elements *elements = &shape->elements[shape->element_count++];
    mt_json_node attributes, positions = {0}, extensions, draco;
    mt_gltf_values indices;
    uint64_t mode = 4;
    size_t accessor = 0, none = SIZE_MAX;
    bool shared = false;
    mt_status status = mt_json_object(file->context, primitive, "attributes", MT_JSON_REQUIRED, &attributes);
    if (status == MT_OK) {
        status = mt_json_whole(file->context, primitive, "mode", MT_JSON_OPTIONAL, 0, 6, &mode);
    }
    if (status == MT_OK) {
        status = read_material(file, primitive, &elements->material);
    }
    if (status == MT_OK) {
        status =
            mt_gltf_refer(file, &attributes, "POSITION", MT_JSON_OPTIONAL, MT_GLTF_ACCESSORS, &positions, &accessor);
    }
    if (status != MT_OK || !positions.value) {
        file->unplaced += status == MT_OK;
        return status;
    }
    file->has_targets = file->has_targets || json_object_get(primitive->value, "targets");
    bool packed = mt_gltf_extension(primitive, "KHR_draco_mesh_compression", &extensions, &draco);
    mt_gltf_vertices *set = share_or_add(shape, attributes.value, packed ? &none : &latest[accessor], &shared);
    if (packed) {
        status = mt_gltf_draco(file, primitive, &draco, set, elements);
    } else {
        status = shared ? MT_OK : read_vertices(file, &attributes, set);
        status = status == MT_OK ? read_indices(file, primitive, &indices) : status;
        status =
            status == MT_OK ? mt_gltf_take_apart(file, primitive, (unsigned)mode, &indices, set, elements) : status;
    }
    if (status == MT_OK) {
        shape->vertex_count += shared ? 0 : set->positions.count;
        count_elements(shape, elements);
    }
    return status;
}

mt_status mt_gltf_shape_read(mt_gltf_file *file, size_t mesh, mt_gltf_shape *out)
{
    mt_json_node node = mt_json_element(&file->lists[MT_GLTF_MESHES], mesh), primitives;
    size_t count = 0, accessors = file->counts[MT_GLTF_ACCESSORS];
    *out = (mt_gltf_shape){0};
    mt_status status = mt_json_array(file->context, &node, "primitives", MT_JSON_REQUIRED, &primitives, &count);
    if (status != MT_OK) {
        return status;
    }
    out->sets = mt_gltf_allocate(file, count, sizeof *out->sets);
    out->elements = mt_gltf_allocate(file, count, sizeof *out->elements);
    size_t *latest = mt_allocate_array(file->context, accessors, sizeof *latest);
    status = out->sets && out->elements && latest ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (size_t i = 0; i < accessors && status == MT_OK; i++) {
        latest[i] = SIZE_MAX;
    }
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        mt_json_node primitive = mt_json_element(&primitives, i);
        out->elements[i] = (mt_gltf_elements){.corner_count = 3};
        status = read_primitive(file, &primitive, latest, out);
    }
    mt_free(file->context, latest);
    return status;
}
