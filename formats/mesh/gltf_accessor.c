/* Accessors (section 3.6.2): typed values in a view, with sparse ones put in their place. */
#include "formats/mesh/gltf.h"

#include <string.h>

static mt_status read_component_type(mt_gltf_file *file, const mt_json_node *node, mt_type *type)
{
    static const struct {
        unsigned code;
        mt_type type;
    } types[] = {{5120, MT_I8}, {5121, MT_U8}, {5122, MT_I16}, {5123, MT_U16}, {5125, MT_U32}, {5126, MT_F32}};
    uint64_t code = 0;
    mt_status status = mt_json_whole(file->context, node, "componentType", MT_JSON_REQUIRED, 0, 65535, &code);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (types[i].code == code) {
            *type = types[i].type;
            return MT_OK;
        }
    }
    mt_json_node place = mt_json_member(node, "componentType");
    return status != MT_OK ? status
                           : mt_json_fail_expected(file->context, &place, "5120, 5121, 5122, 5123, 5125 or 5126");
}

static mt_status read_type(mt_gltf_file *file, const mt_json_node *node, unsigned *component_count)
{
    static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const char *name = "";
    mt_status status = mt_json_string(file->context, node, "type", MT_JSON_REQUIRED, &name);
    for (unsigned i = 0; i < 4; i++) {
        if (strcmp(name, names[i]) == 0) {
            *component_count = i + 1;
            return MT_OK;
        }
    }
    mt_json_node place = mt_json_member(node, "type");
    return status != MT_OK ? status : mt_json_fail_expected(file->context, &place, "SCALAR, VEC2, VEC3 or VEC4");
}

/* Finds `count` elements of `size` bytes in the view that `node` names. */
static mt_status find_values(mt_gltf_file *file, const mt_json_node *node, uint64_t count, uint64_t size,
                             const uint8_t **bytes, uint64_t *stride)
{
    mt_json_node view;
    size_t index = 0;
    uint64_t offset = 0;
    mt_gltf_span span = {0};
    mt_status status = mt_gltf_refer(file, node, "bufferView", MT_JSON_REQUIRED, MT_GLTF_VIEWS, &view, &index);
    if (status == MT_OK) {
        status = mt_json_whole(file->context, node, "byteOffset", MT_JSON_OPTIONAL, 0, UINT64_MAX, &offset);
    }
    if (status == MT_OK) {
        status = mt_gltf_view(file, index, &span, stride);
    }
    if (status != MT_OK) {
        return status;
    }
    *stride = *stride ? *stride : size;
    if (*stride < size) {
        return mt_json_fail(file->context, &view, MT_ERROR_SYNTAX,
                            "byteStride is %llu, less than the %llu bytes of an element", (unsigned long long)*stride,
                            (unsigned long long)size);
    }
    bool fits = offset <= span.size && size <= span.size - offset && count - 1 <= (span.size - offset - size) / *stride;
    if (!fits) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX,
                            "%llu elements from byte %llu on are not within the %llu bytes of bufferViews[%zu]",
                            (unsigned long long)count, (unsigned long long)offset, (unsigned long long)span.size,
                            index);
    }
    *bytes = span.bytes + offset;
    return MT_OK;
}

/* The values without the sparse ones, copied so that those can be put in; zeros where there is no view. */
static mt_status copy_base(mt_gltf_file *file, const mt_json_node *accessor, mt_gltf_values *out)
{
    uint64_t size = out->component_count * mt_type_size(out->type);
    /* Zeros without a byte behind them: no more than could have been written out in this file. */
    if (!out->bytes && out->count > file->bytes_read) {
        return mt_json_fail(file->context, accessor, MT_ERROR_TOO_LARGE,
                            "%llu zeros are more than a file of %llu bytes justifies", (unsigned long long)out->count,
                            (unsigned long long)file->bytes_read);
    }
    uint8_t *copy = mt_gltf_allocate(file, out->count, (size_t)size);
    if (!copy) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (uint64_t i = 0; i < out->count && out->bytes; i++) {
        memcpy(copy + i * size, out->bytes + i * out->stride, (size_t)size);
    }
    if (!out->bytes) {
        memset(copy, 0, (size_t)(out->count * size));
    }
    out->bytes = copy;
    out->stride = size;
    return MT_OK;
}

static mt_status put_sparse(mt_gltf_file *file, const mt_json_node *place, const mt_gltf_values *indices,
                            const mt_gltf_values *values, mt_gltf_values *out)
{
    uint8_t *bytes = (uint8_t *)(uintptr_t)out->bytes; /* our own copy */
    uint64_t next = 0;
    for (uint64_t i = 0; i < indices->count; i++) {
        uint32_t index = mt_gltf_get_index(indices, i);
        if (index < next || index >= out->count) {
            return mt_json_fail(file->context, place, MT_ERROR_SYNTAX,
                                "index number %llu is %u, expected one from %llu to %llu, in ascending order",
                                (unsigned long long)i, index, (unsigned long long)next,
                                (unsigned long long)out->count - 1);
        }
        next = (uint64_t)index + 1;
        memcpy(bytes + index * out->stride, values->bytes + i * values->stride, (size_t)out->stride);
    }
    return MT_OK;
}

static mt_status read_sparse(mt_gltf_file *file, const mt_json_node *accessor, const mt_json_node *sparse,
                             mt_gltf_values *out)
{
    mt_json_node indices_node, values_node;
    mt_gltf_values indices = {0}, values = {0};
    mt_status status = mt_json_whole(file->context, sparse, "count", MT_JSON_REQUIRED, 1, out->count, &indices.count);
    if (status == MT_OK) {
        status = mt_json_object(file->context, sparse, "indices", MT_JSON_REQUIRED, &indices_node);
    }
    if (status == MT_OK) {
        status = mt_json_object(file->context, sparse, "values", MT_JSON_REQUIRED, &values_node);
    }
    if (status == MT_OK) {
        status = read_component_type(file, &indices_node, &indices.type);
    }
    if (status == MT_OK && indices.type != MT_U8 && indices.type != MT_U16 && indices.type != MT_U32) {
        status = mt_json_fail(file->context, &indices_node, MT_ERROR_SYNTAX, "componentType must be an unsigned one");
    }
    if (status == MT_OK) {
        status = find_values(file, &indices_node, indices.count, mt_type_size(indices.type), &indices.bytes,
                             &indices.stride);
    }
    if (status == MT_OK) {
        status = find_values(file, &values_node, indices.count, out->component_count * mt_type_size(out->type),
                             &values.bytes, &values.stride);
    }
    if (status == MT_OK) {
        status = copy_base(file, accessor, out);
    }
    return status == MT_OK ? put_sparse(file, &indices_node, &indices, &values, out) : status;
}

mt_status mt_gltf_accessor(mt_gltf_file *file, const mt_json_node *accessor, mt_gltf_values *out)
{
    mt_json_node sparse, view = mt_json_member(accessor, "bufferView");
    *out = (mt_gltf_values){0};
    mt_status status = read_component_type(file, accessor, &out->type);
    if (status == MT_OK) {
        status = read_type(file, accessor, &out->component_count);
    }
    if (status == MT_OK) {
        status = mt_json_whole(file->context, accessor, "count", MT_JSON_REQUIRED, 1, MT_INDEX_MAX, &out->count);
    }
    if (status == MT_OK) {
        status = mt_json_boolean(file->context, accessor, "normalized", MT_JSON_OPTIONAL, &out->normalized);
    }
    if (status == MT_OK) {
        status = mt_json_object(file->context, accessor, "sparse", MT_JSON_OPTIONAL, &sparse);
    }
    if (status == MT_OK && view.value) {
        status = find_values(file, accessor, out->count, out->component_count * mt_type_size(out->type), &out->bytes,
                             &out->stride);
    }
    if (status == MT_OK && sparse.value) {
        return read_sparse(file, accessor, &sparse, out);
    }
    return status == MT_OK && !view.value ? copy_base(file, accessor, out) : status;
}

uint32_t mt_gltf_get_index(const mt_gltf_values *values, uint64_t element)
{
    const uint8_t *at = values->bytes + element * values->stride;
    switch (values->type) {
    case MT_U8:
        return at[0];
    case MT_U16:
        return (uint32_t)at[0] | (uint32_t)at[1] << 8;
    default:
        return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
    }
}

/* A stored number, little endian on any machine. */
static double stored_number(const uint8_t *at, mt_type type)
{
    uint32_t low = (uint32_t)at[0];
    uint32_t bits;
    float number;
    switch (type) {
    case MT_U8:
        return low;
    case MT_I8:
        return (int8_t)at[0];
    case MT_U16:
        return low | (uint32_t)at[1] << 8;
    case MT_I16:
        return (int16_t)(uint16_t)(low | (uint32_t)at[1] << 8);
    default:
        bits = low | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        if (type == MT_U32) {
            return bits;
        }
        memcpy(&number, &bits, sizeof number);
        return (double)number;
    }
}

double mt_gltf_get(const mt_gltf_values *values, uint64_t element, unsigned component)
{
    static const double maxima[] = {[MT_U8] = 255.0,         [MT_I8] = 127.0, [MT_U16] = 65535.0, [MT_I16] = 32767.0,
                                    [MT_U32] = 4294967295.0, [MT_I32] = 1.0,  [MT_F32] = 1.0};
    double number =
        stored_number(values->bytes + element * values->stride + component * mt_type_size(values->type), values->type);
    if (!values->normalized || values->type == MT_F32) {
        return number;
    }
    number /= maxima[values->type];
    return number < -1.0 ? -1.0 : number;
}
