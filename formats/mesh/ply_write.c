/* Records are formatted in parallel blocks and written in order. */
#include "formats/mesh/ply_write.h"

#include "formats/mesh/ply_header.h"
#include "formats/mesh/ply_schema.h"
#include "formats/stream/lines.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#define BLOCK_RECORDS 16384u
#define NUMBER_ROOM (MT_NUMBER_ROOM + 2) /* with a separator and a line end */

typedef struct ply_writer {
    mt_context *context;
    const mt_mesh *mesh;
    mt_output *output;
    const ply_fields *fields;
    bool ascii, swap;
    unsigned digits;                  /* of positions; 0: shortest */
    atomic_uint_fast64_t partial_uvs; /* corners without texture coordinates in faces that have some */
} ply_writer;

/* One block at work. */
typedef struct ply_block {
    ply_writer *w;
    mt_lines *lines;
    mt_index wire; /* of the edge at hand */
    bool line_begun;
} ply_block;

static inline void put_bytes(const ply_block *b, char *to, const void *value, size_t size)
{
    memcpy(to, value, size);
    for (size_t i = 0; b->w->swap && i < size / 2; i++) {
        char byte = to[i];
        to[i] = to[size - 1 - i];
        to[size - 1 - i] = byte;
    }
}

static inline char *begin_word(ply_block *b, char *at)
{
    if (b->line_begun) {
        *at++ = ' ';
    }
    b->line_begun = true;
    return at;
}

static char *put_signed(char *at, int64_t number)
{
    if (number < 0) {
        *at++ = '-';
    }
    return mt_put_unsigned(at, number < 0 ? 0 - (uint64_t)number : (uint64_t)number);
}

static char *print_value(char *at, const void *value, mt_type type)
{
    uint32_t bits = 0;
    float single;
    double number;
    switch (type) {
    case MT_F32:
        memcpy(&single, value, sizeof single);
        return mt_put_float(at, single);
    case MT_F64:
        memcpy(&number, value, sizeof number);
        return mt_put_number(at, number);
    default:
        memcpy(&bits, value, mt_type_size(type));
    }
    if (type == MT_I8 || type == MT_I16 || type == MT_I32) {
        unsigned shift = 32 - 8 * (unsigned)mt_type_size(type);
        return put_signed(at, (int32_t)(bits << shift) >> shift);
    }
    return mt_put_unsigned(at, bits);
}

/* A number as it is stored; NULL: one that is missing. */
static void put_value(ply_block *b, const void *value, mt_type type)
{
    static const float no_single = NAN;
    static const double no_number = NAN;
    static const uint32_t zero = 0;
    char *at = mt_lines_reserve(b->lines, NUMBER_ROOM);
    if (!at) {
        return;
    }
    if (!value) {
        value = type == MT_F32 ? (const void *)&no_single : type == MT_F64 ? (const void *)&no_number : &zero;
    }
    if (b->w->ascii) {
        char *end = print_value(begin_word(b, at), value, type);
        b->lines->size += (size_t)(end - at);
    } else {
        put_bytes(b, at, value, mt_type_size(type));
        b->lines->size += mt_type_size(type);
    }
}

/* A whole number that fits the type, which is MT_U8 or has 32 bits. */
static void put_whole(ply_block *b, mt_index number, mt_type type)
{
    uint8_t small = (uint8_t)number;
    put_value(b, type == MT_U8 ? (const void *)&small : &number, type);
}

static void put_face(ply_block *b, const ply_field *field, mt_index face)
{
    const mt_mesh *mesh = b->w->mesh;
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    put_whole(b, end - begin, field->count_type);
    for (mt_index corner = begin; corner < end; corner++) {
        put_value(b, &mesh->corner_vertices[corner], field->type);
    }
}

static void put_uv(ply_block *b, const ply_field *field, mt_index value)
{
    const mt_attribute *uvs = field->attribute;
    for (uint32_t i = 0; i < uvs->component_count; i++) {
        double number = value == MT_NONE ? (double)NAN : mt_attribute_get(uvs, value, i);
        float single = (float)number;
        put_value(b, field->type == MT_F32 ? (const void *)&single : &number, field->type);
    }
}

/* A face without any texture coordinates has an empty list. */
static void put_face_uvs(ply_block *b, const ply_field *field, mt_index face)
{
    const mt_attribute *uvs = field->attribute;
    mt_index begin = mt_mesh_face_begin(b->w->mesh, face), end = mt_mesh_face_end(b->w->mesh, face), missing = 0;
    for (mt_index corner = begin; corner < end; corner++) {
        missing += mt_attribute_value_index(uvs, corner) == MT_NONE;
    }
    if (missing == end - begin) {
        put_whole(b, 0, field->count_type);
        return;
    }
    if (missing) {
        atomic_fetch_add_explicit(&b->w->partial_uvs, missing, memory_order_relaxed);
    }
    put_whole(b, (end - begin) * uvs->component_count, field->count_type);
    for (mt_index corner = begin; corner < end; corner++) {
        put_uv(b, field, mt_attribute_value_index(uvs, corner));
    }
}

/* Edge k of all wires begins at wire vertex k + (wires before its own), as each wire has one vertex more than edges. */
static mt_index find_wire_vertex(ply_block *b, mt_index edge)
{
    const mt_mesh *mesh = b->w->mesh;
    while (mesh->wire_offsets[b->wire + 1] - (b->wire + 1) <= edge) {
        b->wire++;
    }
    return edge + b->wire;
}

/* A coordinate in text, with fewer digits than it has. */
static void put_rounded(ply_block *b, const ply_field *field, mt_index record)
{
    char *at = mt_lines_reserve(b->lines, NUMBER_ROOM);
    if (!at) {
        return;
    }
    float single;
    double number;
    const char *value = (const char *)field->values + record * field->stride;
    if (field->type == MT_F32) {
        memcpy(&single, value, sizeof single);
        number = (double)single;
    } else {
        memcpy(&number, value, sizeof number);
    }
    char *begin = begin_word(b, at);
    b->lines->size += (size_t)(begin - at) + mt_number_print_digits(number, b->w->digits, begin);
}

static void put_field(ply_block *b, const ply_field *field, mt_index record)
{
    mt_index value = field->indices ? field->indices[record] : record;
    if (b->w->digits > 0 && b->w->ascii && field->is_position) {
        put_rounded(b, field, record);
        return;
    }
    switch (field->source) {
    case PLY_FROM_FACE:
        put_face(b, field, record);
        break;
    case PLY_FROM_FACE_UVS:
        put_face_uvs(b, field, record);
        break;
    case PLY_FROM_WIRE:
        put_value(b, field->values + find_wire_vertex(b, record) * field->stride, field->type);
        break;
    case PLY_FROM_VALUES:
        put_value(b, value == MT_NONE ? NULL : field->values + value * field->stride, field->type);
        break;
    }
}

static void put_records(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    ply_writer *w = user;
    ply_block b = {.w = w, .lines = lines};
    for (uint64_t record = begin; record < end; record++) {
        for (uint32_t i = 0; i < w->fields->field_count; i++) {
            put_field(&b, &w->fields->fields[i], (mt_index)record);
        }
        if (w->ascii && mt_lines_reserve(lines, 1)) {
            lines->bytes[lines->size++] = '\n';
            b.line_begun = false;
        }
    }
}

static mt_status put_declaration(const ply_writer *w, const ply_fields *fields)
{
    mt_status status = mt_output_format(w->context, w->output, "element %s %llu\n", fields->element,
                                        (unsigned long long)fields->record_count);
    for (uint32_t i = 0; status == MT_OK && i < fields->field_count; i++) {
        const ply_field *field = &fields->fields[i];
        bool is_list = field->source == PLY_FROM_FACE || field->source == PLY_FROM_FACE_UVS;
        status = mt_output_format(w->context, w->output, "property %s%s%s%s %s\n", is_list ? "list " : "",
                                  is_list ? mt_ply_type_name(field->count_type) : "", is_list ? " " : "",
                                  mt_ply_type_name(field->type), field->name);
    }
    return status;
}

static mt_status put_all(ply_writer *w, const ply_schema *schema, mt_encoding encoding)
{
    const char *name = encoding == MT_ENCODING_ASCII        ? "ascii"
                       : encoding == MT_ENCODING_BINARY_BIG ? "binary_big_endian"
                                                            : "binary_little_endian";
    const ply_fields *all[] = {&schema->vertices, &schema->faces, &schema->edges};
    size_t count = schema->edges.record_count ? 3 : 2;
    mt_status status = mt_output_format(w->context, w->output, "ply\nformat %s 1.0\n", name);
    for (size_t i = 0; status == MT_OK && i < count; i++) {
        status = put_declaration(w, all[i]);
    }
    if (status == MT_OK) {
        status = mt_output_text(w->context, w->output, "end_header\n");
    }
    for (size_t i = 0; status == MT_OK && i < count; i++) {
        w->fields = all[i];
        status = mt_lines_write(w->context, w->output, all[i]->record_count, BLOCK_RECORDS, put_records, w);
    }
    return status;
}

static bool is_swapped(mt_encoding encoding)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return encoding != MT_ENCODING_BINARY_BIG;
#else
    return encoding == MT_ENCODING_BINARY_BIG;
#endif
}

mt_status mt_ply_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output)
{
    ply_schema schema;
    mt_status status = mt_ply_schema_make(context, mesh, &schema);
    if (status != MT_OK) {
        return status;
    }
    ply_writer w = {.context = context,
                    .mesh = mesh,
                    .output = output,
                    .ascii = options->encoding == MT_ENCODING_ASCII,
                    .swap = is_swapped(options->encoding),
                    .digits = options->digits};
    status = put_all(&w, &schema, options->encoding);
    uint64_t partial = atomic_load(&w.partial_uvs);
    if (status == MT_OK && partial) {
        mt_warn(context, "%llu corners without texture coordinates, in faces that have some, are written as nan",
                (unsigned long long)partial);
    }
    mt_ply_schema_release(context, &schema);
    return status;
}
