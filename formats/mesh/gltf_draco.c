/* KHR_draco_mesh_compression: a primitive's triangles and values in a Draco stream. */
#include "formats/codec/draco_job.h"
#include "formats/mesh/gltf.h"

#include <stdio.h>

/* What the accessor of an attribute or of the indices declares must be what the stream holds. */
static mt_status check_count(mt_gltf_file *file, const mt_json_node *place, const mt_json_node *accessor,
                             uint64_t expected)
{
    uint64_t count = 0;
    mt_status status = mt_json_whole(file->context, accessor, "count", MT_JSON_REQUIRED, 1, MT_INDEX_MAX, &count);
    if (status == MT_OK && count != expected) {
        return mt_json_fail(file->context, place, MT_ERROR_SYNTAX,
                            "the accessor declares %llu elements, the Draco stream holds %llu",
                            (unsigned long long)count, (unsigned long long)expected);
    }
    return status;
}

static mt_status find_attribute(mt_gltf_file *file, const mt_json_node *ids, const char *key, const mt_draco_mesh *mesh,
                                size_t *number, mt_draco_attribute *out)
{
    uint64_t id = 0;
    mt_status status = mt_json_whole(file->context, ids, key, MT_JSON_REQUIRED, 0, UINT32_MAX, &id);
    for (size_t i = 0; i < mt_draco_attribute_count(mesh) && status == MT_OK; i++) {
        if (mt_draco_attribute_at(mesh, i, out) && out->id == id) {
            *number = i;
            return MT_OK;
        }
    }
    mt_json_node place = mt_json_member(ids, key);
    return status != MT_OK ? status
                           : mt_json_fail(file->context, &place, MT_ERROR_SYNTAX,
                                          "the Draco stream has no attribute with the id %llu", (unsigned long long)id);
}

/* One attribute's values, copied out of the stream. */
static mt_status take_values(mt_gltf_file *file, const mt_json_node *ids, const char *key, const mt_draco_mesh *mesh,
                             mt_gltf_values *out)
{
    mt_draco_attribute attribute;
    size_t number = 0;
    mt_status status = find_attribute(file, ids, key, mesh, &number, &attribute);
    if (status != MT_OK) {
        return status;
    }
    mt_json_node place = mt_json_member(ids, key);
    size_t size = attribute.component_count * mt_type_size(attribute.type);
    uint8_t *bytes = mt_gltf_allocate(file, mt_draco_vertex_count(mesh), size);
    if (!bytes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    if (attribute.type == MT_F64 || attribute.type == MT_I32 || !mt_draco_copy_values(mesh, number, bytes)) {
        return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX,
                            "the values in the Draco stream are none of glTF's");
    }
    *out = (mt_gltf_values){
        bytes, size, mt_draco_vertex_count(mesh), attribute.type, attribute.component_count, attribute.normalized};
    return MT_OK;
}

static mt_status read_attribute(mt_gltf_file *file, const mt_json_node *attributes, const mt_json_node *ids,
                                const char *key, const mt_draco_mesh *mesh, mt_gltf_vertices *set)
{
    mt_json_node accessor, place = mt_json_member(attributes, key);
    unsigned slot = mt_gltf_slot_of(key);
    if (slot > MT_GLTF_SLOT_COUNT) {
        mt_gltf_drop(file, key);
        return MT_OK;
    }
    mt_gltf_values *values = mt_gltf_slot_values(set, slot);
    mt_status status = mt_gltf_refer(file, attributes, key, MT_JSON_REQUIRED, MT_GLTF_ACCESSORS, &accessor, NULL);
    if (status == MT_OK) {
        status = check_count(file, &place, &accessor, mt_draco_vertex_count(mesh));
    }
    if (status == MT_OK) {
        bool packed = json_object_get(ids->value, key);
        status = packed ? take_values(file, ids, key, mesh, values) : mt_gltf_accessor(file, &accessor, values);
    }
    if (status == MT_OK) {
        /* Whether integers are shares of their maximum is the accessor's to say. */
        status = mt_json_boolean(file->context, &accessor, "normalized", MT_JSON_OPTIONAL, &values->normalized);
    }
    return status == MT_OK ? mt_gltf_check_attribute(file, &place, slot, values) : status;
}

static mt_status read_triangles(mt_gltf_file *file, const mt_json_node *primitive, const mt_draco_mesh *mesh,
                                const mt_gltf_vertices *set, mt_gltf_elements *out)
{
    mt_json_node accessor, place = mt_json_member(primitive, "indices");
    uint64_t count = 3 * (uint64_t)mt_draco_triangle_count(mesh);
    mt_status status = mt_gltf_refer(file, primitive, "indices", MT_JSON_REQUIRED, MT_GLTF_ACCESSORS, &accessor, NULL);
    if (status == MT_OK) {
        status = check_count(file, &place, &accessor, count);
    }
    if (status != MT_OK) {
        return status;
    }
    out->corner_count = 3;
    out->count = count;
    out->vertices = mt_gltf_allocate(file, count, sizeof *out->vertices);
    if (!out->vertices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    if (!mt_draco_copy_triangles(mesh, out->vertices)) {
        return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX, "a triangle in the Draco stream names no vertex");
    }
    for (uint64_t i = 0; i < count; i++) {
        out->vertices[i] += (mt_index)set->begin;
    }
    return MT_OK;
}

static mt_status read_stream(mt_gltf_file *file, const mt_json_node *primitive, const mt_json_node *extension,
                             const mt_draco_mesh *mesh, mt_gltf_vertices *set, mt_gltf_elements *elements)
{
    mt_json_node attributes = mt_json_member(primitive, "attributes"), ids;
    const char *key;
    json_t *value;
    mt_status status = mt_json_object(file->context, extension, "attributes", MT_JSON_REQUIRED, &ids);
    json_object_foreach(attributes.value, key, value)
    {
        status = status == MT_OK ? read_attribute(file, &attributes, &ids, key, mesh, set) : status;
    }
    if (status == MT_OK && set->begin + set->positions.count > MT_INDEX_MAX) {
        status =
            mt_json_fail(file->context, primitive, MT_ERROR_TOO_LARGE, "the mesh has more vertices than can be held");
    }
    return status == MT_OK ? read_triangles(file, primitive, mesh, set, elements) : status;
}

mt_status mt_gltf_draco(mt_gltf_file *file, const mt_json_node *primitive, const mt_json_node *extension,
                        mt_gltf_vertices *set, mt_gltf_elements *elements)
{
    mt_json_node view;
    mt_gltf_span span = {0};
    uint64_t stride;
    size_t index = 0;
    char path[MT_JSON_PATH], where[MT_JSON_PATH + 4];
    mt_status status = mt_gltf_refer(file, extension, "bufferView", MT_JSON_REQUIRED, MT_GLTF_VIEWS, &view, &index);
    if (status == MT_OK) {
        status = mt_gltf_view(file, index, &span, &stride);
    }
    if (status != MT_OK) {
        return status;
    }
    mt_draco_job job;
    mt_place place = {.file = mt_input_name(file->input)};
    mt_json_path(extension, path);
    snprintf(where, sizeof where, "%s: ", path);
    status = mt_draco_job_decode(file->context, place, where, span.bytes, (size_t)span.size, &job);
    if (status == MT_OK) {
        file->decoded += 3 * (uint64_t)mt_draco_triangle_count(job.mesh) + mt_draco_vertex_count(job.mesh);
        status = read_stream(file, primitive, extension, job.mesh, set, elements);
    }
    mt_draco_job_close(&job);
    return status;
}
