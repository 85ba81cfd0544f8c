/* The JSON of a glTF file. Views, accessors and meshes are numbered chunk by chunk, in the order in which gltf_write.c
 * puts their bytes: positions, columns, indices; or the compressed bytes alone. */
#include "formats/mesh/gltf_write.h"

#include "formats/stream/number.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ARRAY_BUFFER 34962
#define ELEMENT_ARRAY_BUFFER 34963
/* Whole numbers beyond are written with a fraction: readers that take those without one for integers refuse them. */
#define LARGEST_INTEGER 9007199254740992.0
#define INDEX_LIMIT 65535 /* vertices that indices of 16 bits can name, the restart value left out */

uint64_t mt_gltf_view_size(uint64_t count, unsigned stride)
{
    return (count * stride + 3) / 4 * 4;
}

unsigned mt_gltf_index_size(const mt_gltf_chunk *chunk)
{
    return chunk->vertex_count <= INDEX_LIMIT ? 2 : 4;
}

uint64_t mt_gltf_chunk_indices(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, uint64_t *begin)
{
    uint64_t count = 0;
    *begin = chunk->primitive_count ? plan->primitives[chunk->primitive_begin].begin : 0;
    for (size_t i = 0; i < chunk->primitive_count; i++) {
        count += plan->primitives[chunk->primitive_begin + i].count;
    }
    return count;
}

typedef struct describer {
    const mt_gltf_plan *plan;
    mt_context *context;
    mt_output *text;
    mt_status status;
    uint64_t offset; /* in the buffer */
    size_t view, accessor;
} describer;

static void put(describer *d, const char *text)
{
    if (d->status == MT_OK) {
        d->status = mt_output_text(d->context, d->text, text);
    }
}

static void MT_PRINTF(2, 3) put_format(describer *d, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    put(d, text);
}

/* Bytes of the UTF-8 character that begins at `at`, 0 when none does. */
static size_t character_size(const unsigned char *at)
{
    size_t size = at[0] < 0x80 ? 1 : at[0] >= 0xC2 && at[0] < 0xE0 ? 2 : (at[0] & 0xF0) == 0xE0 ? 3 : 4;
    if (at[0] >= 0xF5 || (at[0] >= 0x80 && at[0] < 0xC2)) {
        return 0;
    }
    for (size_t i = 1; i < size; i++) {
        if ((at[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    bool overlong = (at[0] == 0xE0 && at[1] < 0xA0) || (at[0] == 0xF0 && at[1] < 0x90);
    bool no_character = (at[0] == 0xED && at[1] >= 0xA0) || (at[0] == 0xF4 && at[1] >= 0x90);
    return overlong || no_character ? 0 : size;
}

/* A name as a JSON string; bytes that are no UTF-8 become the replacement character. */
static void put_string(describer *d, const char *text)
{
    put(d, "\"");
    for (const unsigned char *at = (const unsigned char *)text; *at && d->status == MT_OK;) {
        size_t size = character_size(at);
        if (*at == '"' || *at == '\\') {
            put_format(d, "\\%c", *at);
        } else if (*at < ' ') {
            put_format(d, "\\u%04x", *at);
        } else if (size == 0) {
            put(d, "\xEF\xBF\xBD");
        } else {
            d->status = mt_output_write(d->context, d->text, at, size);
        }
        at += size ? size : 1;
    }
    put(d, "\"");
}

static void put_name(describer *d, const char *name, const char *after)
{
    if (name[0]) {
        put(d, "\"name\":");
        put_string(d, name);
        put(d, after);
    }
}

/* A view of the buffer; stride 0: none is said. */
static void put_view(describer *d, uint64_t size, uint64_t padded, unsigned stride, unsigned target)
{
    put_format(d, "%s{\"buffer\":0,\"byteOffset\":%llu,\"byteLength\":%llu", d->view++ ? "," : "",
               (unsigned long long)d->offset, (unsigned long long)size);
    if (stride) {
        put_format(d, ",\"byteStride\":%u", stride);
    }
    if (target) {
        put_format(d, ",\"target\":%u", target);
    }
    put(d, "}");
    d->offset += padded;
}

/* Values of vertices; the stride is said where they are padded. */
static void put_values_view(describer *d, uint64_t count, unsigned component_count, mt_type type, unsigned stride)
{
    bool padded = stride != component_count * mt_type_size(type);
    put_view(d, count * stride, count * stride, padded ? stride : 0, ARRAY_BUFFER);
}

static void put_chunk_views(describer *d, const mt_gltf_chunk *chunk)
{
    const mt_gltf_plan *plan = d->plan;
    uint64_t begin, count = chunk->vertex_count, indices = mt_gltf_chunk_indices(plan, chunk, &begin);
    if (chunk->packed.bytes) {
        put_view(d, chunk->packed.size, mt_gltf_view_size(chunk->packed.size, 1), 0, 0);
        return;
    }
    put_values_view(d, count, 3, mt_gltf_position_type(plan), mt_gltf_position_stride(plan));
    for (size_t i = 0; i < plan->column_count; i++) {
        const mt_gltf_column *column = &plan->columns[i];
        put_values_view(d, count, column->component_count, column->type, column->stride);
    }
    if (indices > 0) {
        unsigned size = mt_gltf_index_size(chunk);
        put_view(d, indices * size, mt_gltf_view_size(indices, size), 0, ELEMENT_ARRAY_BUFFER);
    }
}

/* "[1,2,3]" after a key. JSON has doubles: the digits of a float are those of it as a double. */
static void put_numbers(describer *d, const char *key, const double numbers[3])
{
    put(d, key);
    for (int k = 0; k < 3; k++) {
        char number[MT_NUMBER_ROOM + 1];
        number[mt_number_print(numbers[k], number)] = '\0';
        bool whole = strspn(number, "-0123456789") == strlen(number);
        put_format(d, "%s%s%s", k ? "," : "[", number, whole && fabs(numbers[k]) > LARGEST_INTEGER ? ".0" : "");
    }
    put(d, "]");
}

/* Least and greatest positions, as they are stored. */
static void put_bounds(describer *d, const mt_gltf_chunk *chunk)
{
    double bounds[2][3];
    for (mt_index i = 0; i < chunk->vertex_count; i++) {
        double p[3];
        mt_gltf_get_position(d->plan, chunk, i, p);
        for (int k = 0; k < 3; k++) {
            bounds[0][k] = i == 0 || p[k] < bounds[0][k] ? p[k] : bounds[0][k];
            bounds[1][k] = i == 0 || p[k] > bounds[1][k] ? p[k] : bounds[1][k];
        }
    }
    put_numbers(d, ",\"min\":", bounds[0]);
    put_numbers(d, ",\"max\":", bounds[1]);
}

/* The beginning of an accessor; view SIZE_MAX: it has none. */
static void open_accessor(describer *d, size_t view, uint64_t offset)
{
    put_format(d, "%s{", d->accessor++ ? "," : "");
    if (view != SIZE_MAX) {
        put_format(d, "\"bufferView\":%zu,", view);
    }
    if (offset) {
        put_format(d, "\"byteOffset\":%llu,", (unsigned long long)offset);
    }
}

/* glTF's number for a type. */
static unsigned component_code(mt_type type)
{
    static const unsigned codes[] = {[MT_I8] = 5120, [MT_U8] = 5121, [MT_I16] = 5122, [MT_U16] = 5123, [MT_F32] = 5126};
    return codes[type];
}

static void put_chunk_accessors(describer *d, const mt_gltf_chunk *chunk)
{
    const mt_gltf_plan *plan = d->plan;
    bool packed = chunk->packed.bytes;
    mt_index count = packed ? chunk->packed.vertex_count : chunk->vertex_count;
    open_accessor(d, packed ? SIZE_MAX : d->view++, 0);
    put_format(d, "\"componentType\":%u,\"count\":%u,\"type\":\"VEC3\"", component_code(mt_gltf_position_type(plan)),
               count);
    put_bounds(d, chunk);
    put(d, "}");
    for (size_t i = 0; i < plan->column_count; i++) {
        const mt_gltf_column *column = &plan->columns[i];
        open_accessor(d, packed ? SIZE_MAX : d->view++, 0);
        put_format(d, "\"componentType\":%u,\"count\":%u,\"type\":\"VEC%u\"%s}", component_code(column->type), count,
                   column->component_count, column->type == MT_F32 ? "" : ",\"normalized\":true");
    }
    uint64_t offset = 0;
    for (size_t i = 0; i < chunk->primitive_count; i++) {
        uint64_t indices = plan->primitives[chunk->primitive_begin + i].count;
        indices = packed ? 3 * (uint64_t)chunk->packed.triangle_count : indices;
        if (indices > 0) {
            open_accessor(d, packed ? SIZE_MAX : d->view, offset);
            put_format(d, "\"componentType\":%u,\"count\":%llu,\"type\":\"SCALAR\"}",
                       mt_gltf_index_size(chunk) == 2 ? 5123 : 5125, (unsigned long long)indices);
            offset += indices * mt_gltf_index_size(chunk);
        }
    }
    d->view += packed || offset > 0;
}

static const char *column_name(const mt_gltf_column *column, char *text, size_t room)
{
    static const char *const names[] = {"", "NORMAL", "TEXCOORD", "COLOR"};
    const char *name = names[column->attribute->semantic];
    if (column->attribute->semantic == MT_SEMANTIC_NORMAL) {
        return name;
    }
    snprintf(text, room, "%s_%u", name, column->set);
    return text;
}

/* "POSITION":4,"NORMAL":5: the attributes, numbered from `first` on. */
static void put_attributes(describer *d, size_t first)
{
    put_format(d, "\"attributes\":{\"POSITION\":%zu", first);
    for (size_t i = 0; i < d->plan->column_count; i++) {
        char name[24];
        put_format(d, ",\"%s\":%zu", column_name(&d->plan->columns[i], name, sizeof name), first + 1 + i);
    }
    put(d, "}");
}

static void put_chunk_primitives(describer *d, const mt_gltf_chunk *chunk)
{
    const mt_gltf_plan *plan = d->plan;
    size_t first = d->accessor, next = first + 1 + plan->column_count;
    for (size_t i = 0; i < chunk->primitive_count; i++) {
        const mt_gltf_primitive *primitive = &plan->primitives[chunk->primitive_begin + i];
        put(d, i ? ",{" : "{");
        put_attributes(d, first);
        if (primitive->count > 0) {
            put_format(d, ",\"indices\":%zu", next++);
        }
        if (primitive->mode != MT_GLTF_TRIANGLES) {
            put_format(d, ",\"mode\":%u", (unsigned)primitive->mode);
        }
        if (primitive->material != MT_NONE) {
            put_format(d, ",\"material\":%u", primitive->material);
        }
        if (chunk->packed.bytes) {
            put_format(d, ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":%zu,", d->view);
            put_attributes(d, 0); /* the stream's ids are their places */
            put(d, "}}");
        }
        put(d, "}");
    }
    uint64_t begin;
    bool has_indices = mt_gltf_chunk_indices(plan, chunk, &begin) > 0;
    d->view += chunk->packed.bytes ? 1 : 1 + plan->column_count + has_indices;
    d->accessor = next;
}

/* One mesh for each part: its chunks follow each other. Returns how many. */
static size_t put_meshes(describer *d)
{
    const mt_gltf_plan *plan = d->plan;
    size_t count = 0;
    d->view = d->accessor = 0;
    for (size_t i = 0; i < plan->chunk_count; i++) {
        const mt_gltf_chunk *chunk = &plan->chunks[i];
        bool same = i > 0 && plan->chunks[i - 1].part == chunk->part;
        put(d, same ? "," : i > 0 ? "]},{" : "{");
        if (!same) {
            put_name(d, chunk->part == MT_NONE ? "" : plan->parts->names[chunk->part], ",");
            put(d, "\"primitives\":[");
            count++;
        }
        put_chunk_primitives(d, chunk);
    }
    put(d, "]}");
    return count;
}

static void put_nodes(describer *d, size_t count)
{
    const mt_gltf_plan *plan = d->plan;
    put(d, ",\"scene\":0,\"scenes\":[{\"nodes\":[");
    for (size_t i = 0; i < count; i++) {
        put_format(d, "%s%zu", i ? "," : "", i);
    }
    put(d, "]}],\"nodes\":[");
    size_t mesh = 0;
    for (size_t i = 0; i < plan->chunk_count; i++) {
        mt_index part = plan->chunks[i].part;
        if (i > 0 && plan->chunks[i - 1].part == part) {
            continue;
        }
        put(d, mesh ? ",{" : "{");
        put_name(d, part == MT_NONE ? "" : plan->parts->names[part], ",");
        put_format(d, "\"mesh\":%zu", mesh++);
        if (plan->grid.bits > 0) {
            const double origin[] = {plan->grid.origin.x, plan->grid.origin.y, plan->grid.origin.z};
            put_numbers(d, ",\"translation\":", origin);
            put_numbers(d, ",\"scale\":", (const double[]){plan->grid.step, plan->grid.step, plan->grid.step});
        }
        put(d, "}");
    }
    put(d, "]");
}

static void put_materials(describer *d)
{
    const mt_labels *materials = d->plan->materials;
    if (!materials || materials->name_count == 0) {
        return;
    }
    put(d, ",\"materials\":[");
    for (mt_index i = 0; i < materials->name_count; i++) {
        put(d, i ? ",{" : "{");
        put_name(d, materials->names[i], "");
        put(d, "}");
    }
    put(d, "]");
}

static void put_extensions(describer *d)
{
    bool packed = false;
    for (size_t i = 0; i < d->plan->chunk_count; i++) {
        packed = packed || d->plan->chunks[i].packed.bytes;
    }
    bool quantised = d->plan->grid.bits > 0 && d->plan->chunk_count > 0;
    if (packed || quantised) {
        const char *name = packed ? "KHR_draco_mesh_compression" : "KHR_mesh_quantization";
        put_format(d, ",\"extensionsUsed\":[\"%s\"],\"extensionsRequired\":[\"%s\"]", name, name);
    }
}

static void put_everything(describer *d, size_t chunk_count)
{
    const mt_gltf_plan *plan = d->plan;
    put(d, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"meshtool\"}");
    put_extensions(d);
    if (chunk_count == 0) {
        put(d, ",\"scene\":0,\"scenes\":[{}]");
        put_materials(d);
        return;
    }
    put(d, ",\"meshes\":[");
    size_t mesh_count = put_meshes(d);
    put(d, "]");
    put_nodes(d, mesh_count);
    put_materials(d);
    d->view = d->accessor = 0;
    put(d, ",\"accessors\":[");
    for (size_t i = 0; i < chunk_count; i++) {
        put_chunk_accessors(d, &plan->chunks[i]);
    }
    d->view = 0;
    put(d, "],\"bufferViews\":[");
    for (size_t i = 0; i < chunk_count; i++) {
        put_chunk_views(d, &plan->chunks[i]);
    }
    put_format(d, "],\"buffers\":[{\"byteLength\":%llu", (unsigned long long)d->offset);
}

mt_status mt_gltf_describe(const mt_gltf_plan *plan, bool embeds, mt_gltf_text *out)
{
    describer d = {.plan = plan, .context = plan->context};
    *out = (mt_gltf_text){0};
    d.status = mt_output_open_memory(d.context, &d.text);
    if (d.status != MT_OK) {
        return d.status;
    }
    put_everything(&d, plan->chunk_count);
    bool has_data = plan->chunk_count > 0;
    bool cut = has_data && embeds;
    put(&d, cut ? ",\"uri\":\"data:application/octet-stream;base64," : has_data ? "}]}" : "}");
    if (d.status != MT_OK) {
        mt_output_abandon(d.context, d.text);
        return d.status;
    }
    out->data_size = d.offset;
    out->tail = cut ? "\"}]}" : "";
    return mt_output_take(d.context, d.text, &out->head, &out->head_size);
}
