/* Writing a plan: the two containers, and the bytes of the buffer. The same bytes for any machine. */
#include "formats/mesh/gltf_write.h"
#include "formats/mesh/gltf.h"

#include <math.h>
#include <string.h>

#define BLOCK_VERTICES 4096
#define VALUE_ROOM 16 /* bytes of the largest value */

/* Bytes of the buffer on their way: as they are, or as base64 in threes. */
typedef struct sink {
    mt_context *context;
    mt_output *output;
    bool encodes;
    uint8_t rest[3]; /* not yet a whole three */
    size_t rest_size;
    mt_status status;
} sink;

static void put_encoded(sink *s, const uint8_t *bytes, size_t size)
{
    char text[4096];
    while (size > 0 && s->status == MT_OK) {
        size_t part = size < 3072 ? size : 3072;
        s->status = mt_output_write(s->context, s->output, text, mt_base64_encode(bytes, part, text));
        bytes += part;
        size -= part;
    }
}

static void put_bytes(sink *s, const void *from, size_t size)
{
    const uint8_t *bytes = from;
    if (!s->encodes) {
        s->status = s->status == MT_OK ? mt_output_write(s->context, s->output, bytes, size) : s->status;
        return;
    }
    while (size > 0 && s->rest_size > 0) {
        s->rest[s->rest_size++] = *bytes++;
        size--;
        if (s->rest_size == 3) {
            put_encoded(s, s->rest, 3);
            s->rest_size = 0;
        }
    }
    put_encoded(s, bytes, size / 3 * 3);
    for (size_t i = size / 3 * 3; i < size; i++) {
        s->rest[s->rest_size++] = bytes[i];
    }
}

static void put_zeros(sink *s, uint64_t size)
{
    static const uint8_t zeros[4];
    put_bytes(s, zeros, (size_t)size);
}

/* Numbers of `size` bytes, little endian. */
static void put_numbers(sink *s, void *numbers, size_t count, size_t size)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    uint8_t *bytes = numbers;
    for (size_t i = 0; i < count && size > 1; i++) {
        for (size_t k = 0; k < size / 2; k++) {
            uint8_t byte = bytes[i * size + k];
            bytes[i * size + k] = bytes[i * size + size - 1 - k];
            bytes[i * size + size - 1 - k] = byte;
        }
    }
#endif
    put_bytes(s, numbers, count * size);
}

static void put_positions(sink *s, const mt_gltf_plan *plan, const mt_gltf_chunk *chunk)
{
    uint32_t block[3 * BLOCK_VERTICES];
    size_t words = mt_gltf_position_stride(plan) / 4, size = mt_type_size(mt_gltf_position_type(plan));
    for (mt_index i = 0; i < chunk->vertex_count; i += BLOCK_VERTICES) {
        mt_index count = chunk->vertex_count - i < BLOCK_VERTICES ? chunk->vertex_count - i : BLOCK_VERTICES;
        for (mt_index k = 0; k < count; k++) {
            mt_gltf_put_position(plan, chunk, i + k, block + words * k);
        }
        put_numbers(s, block, 4 * words * count / size, size);
    }
}

static void put_column(sink *s, const mt_gltf_plan *plan, const mt_gltf_column *column, const mt_gltf_chunk *chunk)
{
    uint32_t block[BLOCK_VERTICES * VALUE_ROOM / 4];
    size_t words = column->stride / 4, size = mt_type_size(column->type);
    for (mt_index i = 0; i < chunk->vertex_count; i += BLOCK_VERTICES) {
        mt_index count = chunk->vertex_count - i < BLOCK_VERTICES ? chunk->vertex_count - i : BLOCK_VERTICES;
        for (mt_index k = 0; k < count; k++) {
            mt_gltf_put_value(plan, column, chunk, i + k, block + words * k);
        }
        put_numbers(s, block, count * column->stride / size, size);
    }
}

static void put_indices(sink *s, const mt_gltf_plan *plan, const mt_gltf_chunk *chunk)
{
    uint32_t block[3 * BLOCK_VERTICES];
    uint64_t begin, count = mt_gltf_chunk_indices(plan, chunk, &begin);
    unsigned size = mt_gltf_index_size(chunk);
    for (uint64_t i = 0; i < count; i += 3 * BLOCK_VERTICES) {
        size_t part = count - i < 3 * BLOCK_VERTICES ? (size_t)(count - i) : 3 * BLOCK_VERTICES;
        for (size_t k = 0; k < part; k++) {
            mt_index index = plan->indices[begin + i + k];
            if (size == 2) {
                ((uint16_t *)block)[k] = (uint16_t)index;
            } else {
                block[k] = index;
            }
        }
        put_numbers(s, block, part, size);
    }
    put_zeros(s, mt_gltf_view_size(count, size) - count * size);
}

static void put_data(sink *s, const mt_gltf_plan *plan)
{
    for (size_t i = 0; i < plan->chunk_count && s->status == MT_OK; i++) {
        const mt_gltf_chunk *chunk = &plan->chunks[i];
        if (chunk->packed.bytes) {
            put_bytes(s, chunk->packed.bytes, chunk->packed.size);
            put_zeros(s, mt_gltf_view_size(chunk->packed.size, 1) - chunk->packed.size);
            continue;
        }
        put_positions(s, plan, chunk);
        for (size_t c = 0; c < plan->column_count; c++) {
            put_column(s, plan, &plan->columns[c], chunk);
        }
        put_indices(s, plan, chunk);
    }
    if (s->encodes && s->status == MT_OK) {
        put_encoded(s, s->rest, s->rest_size);
    }
}

static mt_status write_text(const mt_gltf_plan *plan, const mt_gltf_text *text, mt_output *output)
{
    sink s = {.context = plan->context, .output = output, .encodes = true};
    s.status = mt_output_write(plan->context, output, text->head, text->head_size);
    put_data(&s, plan);
    return s.status == MT_OK ? mt_output_text(plan->context, output, text->tail) : s.status;
}

static void store_words(uint8_t *to, const uint32_t *words, size_t count)
{
    for (size_t i = 0; i < 4 * count; i++) {
        to[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
    }
}

static mt_status write_binary(const mt_gltf_plan *plan, const mt_gltf_text *text, mt_output *output)
{
    uint64_t json_size = mt_gltf_view_size(text->head_size, 1);
    uint64_t total = 12 + 8 + json_size + (text->data_size > 0 ? 8 + text->data_size : 0);
    sink s = {.context = plan->context, .output = output};
    if (total > UINT32_MAX) {
        return mt_fail(plan->context, MT_ERROR_TOO_LARGE,
                       "a GLB file of %llu bytes is past the 4 GB that its header can tell; write .gltf instead",
                       (unsigned long long)total);
    }
    const uint32_t header[] = {0x46546C67, 2, (uint32_t)total, (uint32_t)json_size, 0x4E4F534A};
    const uint32_t data_header[] = {(uint32_t)text->data_size, 0x004E4942};
    uint8_t bytes[sizeof header];
    store_words(bytes, header, 5);
    put_bytes(&s, bytes, sizeof header);
    put_bytes(&s, text->head, text->head_size);
    put_bytes(&s, "   ", (size_t)(json_size - text->head_size));
    if (text->data_size > 0) {
        store_words(bytes, data_header, 2);
        put_bytes(&s, bytes, sizeof data_header);
        put_data(&s, plan);
    }
    return s.status;
}

static mt_status refuse_infinite(mt_context *context, const char *what, mt_index number)
{
    return mt_fail(context, MT_ERROR_UNSUPPORTED,
                   "glTF holds finite single-precision numbers only, and %s %u has one that is not", what, number);
}

mt_status mt_gltf_check_finite(mt_context *context, const mt_mesh *mesh)
{
    for (uint64_t i = 0; i < 3 * (uint64_t)mesh->vertex_count; i++) {
        float number = mesh->position_type == MT_F64 ? (float)((const double *)mesh->positions)[i]
                                                     : ((const float *)mesh->positions)[i];
        if (!isfinite(number)) {
            return refuse_infinite(context, "vertex", (mt_index)(i / 3));
        }
    }
    for (mt_index a = 0; a < mesh->attribute_count; a++) {
        const mt_attribute *attribute = &mesh->attributes[a];
        bool floats = attribute->type == MT_F32 || attribute->type == MT_F64;
        if (!floats || !mt_gltf_holds_attribute(mesh, attribute, MT_ENCODING_BINARY)) {
            continue;
        }
        for (uint64_t i = 0; i < (uint64_t)attribute->value_count * attribute->component_count; i++) {
            mt_index value = (mt_index)(i / attribute->component_count);
            if (!isfinite((float)mt_attribute_get(attribute, value, (uint32_t)(i % attribute->component_count)))) {
                return refuse_infinite(context, "attribute value", value);
            }
        }
    }
    return MT_OK;
}

mt_status mt_gltf_write_plan(const mt_gltf_plan *plan, mt_output *output, bool binary)
{
    mt_gltf_text text;
    mt_status status = mt_gltf_describe(plan, !binary, &text);
    if (status == MT_OK) {
        status = binary ? write_binary(plan, &text, output) : write_text(plan, &text, output);
        mt_free(plan->context, text.head);
    }
    return status;
}

static mt_status write_mesh(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                            mt_output *output, bool binary)
{
    mt_gltf_plan plan;
    mt_status status = mt_gltf_check_finite(context, mesh);
    if (status != MT_OK) {
        return status;
    }
    status = mt_gltf_plan_make(context, mesh, options, &plan);
    if (status != MT_OK) {
        return status;
    }
    if (options->draco.compress) {
        status = mt_gltf_pack(&plan, &options->draco, options->strict_loss);
    }
    if (status == MT_OK) {
        status = mt_gltf_write_plan(&plan, output, binary);
    }
    mt_gltf_plan_release(&plan);
    return status;
}

mt_status mt_glb_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output)
{
    return write_mesh(context, mesh, options, output, true);
}

mt_status mt_gltf_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                        mt_output *output)
{
    return write_mesh(context, mesh, options, output, false);
}
