#include "formats/mesh/ply_write.h"

#include "formats/mesh/ply_header.h"
#include "formats/mesh/ply_schema.h"
#include "formats/stream/number.h"

#include <math.h>
#include <string.h>

#define BUFFER_SIZE ((size_t)64 << 10)
#define PROGRESS_STEP 65536u /* records */

typedef struct ply_writer {
    mt_context *context;
    const mt_mesh *mesh;
    mt_output *output;
    bool ascii, swap;
    bool line_begun;
    uint64_t partial_uvs; /* corners without texture coordinates in faces that have some */
    size_t used;
    char buffer[BUFFER_SIZE];
} ply_writer;

static mt_status flush(ply_writer *w)
{
    size_t used = w->used;
    w->used = 0;
    return mt_output_write(w->context, w->output, w->buffer, used);
}

/* Room for one number, which takes up to MT_NUMBER_ROOM bytes and a separator. */
static inline mt_status make_room(ply_writer *w)
{
    return BUFFER_SIZE - w->used < MT_NUMBER_ROOM + 2 ? flush(w) : MT_OK;
}

static size_t print_whole(int64_t number, char *text)
{
    char digits[24];
    size_t count = 0, length = 0;
    uint64_t rest = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
    do {
        digits[count++] = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest);
    if (number < 0) {
        text[length++] = '-';
    }
    while (count) {
        text[length++] = digits[--count];
    }
    return length;
}

static inline void begin_word(ply_writer *w)
{
    if (w->line_begun) {
        w->buffer[w->used++] = ' ';
    }
    w->line_begun = true;
}

static inline void put_bytes(ply_writer *w, const void *value, size_t size)
{
    char *to = w->buffer + w->used;
    memcpy(to, value, size);
    for (size_t i = 0; w->swap && i < size / 2; i++) {
        char byte = to[i];
        to[i] = to[size - 1 - i];
        to[size - 1 - i] = byte;
    }
    w->used += size;
}

/* A whole number of up to 32 bits. */
static inline mt_status put_whole(ply_writer *w, uint32_t number, mt_type type)
{
    mt_status status = make_room(w);
    if (w->ascii) {
        begin_word(w);
        w->used += print_whole(number, w->buffer + w->used);
    } else if (type == MT_U8) {
        w->buffer[w->used++] = (char)number;
    } else {
        put_bytes(w, &number, sizeof number);
    }
    return status;
}

/* A number as it is stored; reading it as a double is exact for all types. */
static void print_value(ply_writer *w, const char *value, mt_type type)
{
    uint32_t bits = 0;
    float single;
    double number;
    begin_word(w);
    char *to = w->buffer + w->used;
    switch (type) {
    case MT_F32:
        memcpy(&single, value, sizeof single);
        w->used += mt_number_print_float(single, to);
        return;
    case MT_F64:
        memcpy(&number, value, sizeof number);
        w->used += mt_number_print(number, to);
        return;
    default:
        memcpy(&bits, value, mt_type_size(type));
    }
    int64_t whole = bits;
    if (type == MT_I8 || type == MT_I16 || type == MT_I32) {
        unsigned shift = 32 - 8 * (unsigned)mt_type_size(type);
        whole = (int32_t)(bits << shift) >> shift;
    }
    w->used += print_whole(whole, to);
}

static mt_status put_value(ply_writer *w, const char *value, mt_type type)
{
    static const float no_single = NAN;
    static const double no_number = NAN;
    mt_status status = make_room(w);
    if (!value) {
        static const uint32_t zero = 0;
        value = type == MT_F32   ? (const char *)&no_single
                : type == MT_F64 ? (const char *)&no_number
                                 : (const char *)&zero;
    }
    if (w->ascii) {
        print_value(w, value, type);
    } else {
        put_bytes(w, value, mt_type_size(type));
    }
    return status;
}

static mt_status put_face(ply_writer *w, const ply_field *field, mt_index face)
{
    const mt_mesh *mesh = w->mesh;
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    mt_status status = put_whole(w, end - begin, field->count_type);
    for (mt_index corner = begin; status == MT_OK && corner < end; corner++) {
        status = put_whole(w, mesh->corner_vertices[corner], field->type);
    }
    return status;
}

static mt_status put_uv(ply_writer *w, const ply_field *field, mt_index value)
{
    const mt_attribute *uvs = field->attribute;
    mt_status status = MT_OK;
    for (uint32_t i = 0; status == MT_OK && i < uvs->component_count; i++) {
        double number = value == MT_NONE ? (double)NAN : mt_attribute_get(uvs, value, i);
        float single = (float)number;
        status = put_value(w, field->type == MT_F32 ? (const char *)&single : (const char *)&number, field->type);
    }
    return status;
}

/* A face without any texture coordinates has an empty list. */
static mt_status put_face_uvs(ply_writer *w, const ply_field *field, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(w->mesh, face), end = mt_mesh_face_end(w->mesh, face), missing = 0;
    for (mt_index corner = begin; corner < end; corner++) {
        missing += mt_attribute_value_index(field->attribute, corner) == MT_NONE;
    }
    if (missing == end - begin) {
        return put_whole(w, 0, field->count_type);
    }
    w->partial_uvs += missing;
    mt_status status = put_whole(w, (end - begin) * field->attribute->component_count, field->count_type);
    for (mt_index corner = begin; status == MT_OK && corner < end; corner++) {
        status = put_uv(w, field, mt_attribute_value_index(field->attribute, corner));
    }
    return status;
}

static mt_status put_field(ply_writer *w, const ply_field *field, mt_index record)
{
    mt_index value = field->indices ? field->indices[record] : record;
    switch (field->source) {
    case PLY_FROM_FACE:
        return put_face(w, field, record);
    case PLY_FROM_FACE_UVS:
        return put_face_uvs(w, field, record);
    default:
        return put_value(w, value == MT_NONE ? NULL : field->values + value * field->stride, field->type);
    }
}

static mt_status put_record(ply_writer *w, const ply_fields *fields, mt_index record)
{
    mt_status status = MT_OK;
    for (uint32_t i = 0; status == MT_OK && i < fields->field_count; i++) {
        status = put_field(w, &fields->fields[i], record);
    }
    if (w->ascii) {
        w->buffer[w->used++] = '\n';
        w->line_begun = false;
    }
    return status;
}

static mt_status put_element(ply_writer *w, const ply_fields *fields)
{
    mt_status status = MT_OK;
    for (uint64_t record = 0; status == MT_OK && record < fields->record_count; record++) {
        if (record % PROGRESS_STEP == 0) {
            status = mt_progress(w->context, "writing PLY", (double)record / (double)fields->record_count);
        }
        if (status == MT_OK) {
            status = put_record(w, fields, (mt_index)record);
        }
    }
    return status;
}

/* Each side of a wire is one record. */
static mt_status put_edges(ply_writer *w, const ply_fields *fields)
{
    const mt_mesh *mesh = w->mesh;
    mt_status status = MT_OK;
    for (mt_index wire = 0; fields->record_count && wire < mesh->wire_count; wire++) {
        for (mt_index i = mesh->wire_offsets[wire]; status == MT_OK && i + 1 < mesh->wire_offsets[wire + 1]; i++) {
            status = put_record(w, fields, i);
        }
    }
    return status;
}

static mt_status put_declaration(ply_writer *w, const ply_fields *fields)
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

static mt_status put_header(ply_writer *w, const ply_schema *schema, mt_encoding encoding)
{
    const char *name = encoding == MT_ENCODING_ASCII        ? "ascii"
                       : encoding == MT_ENCODING_BINARY_BIG ? "binary_big_endian"
                                                            : "binary_little_endian";
    mt_status status = mt_output_format(w->context, w->output, "ply\nformat %s 1.0\n", name);
    const ply_fields *all[] = {&schema->vertices, &schema->faces, schema->edges.record_count ? &schema->edges : NULL};
    for (size_t i = 0; status == MT_OK && i < 3 && all[i]; i++) {
        status = put_declaration(w, all[i]);
    }
    return status == MT_OK ? mt_output_text(w->context, w->output, "end_header\n") : status;
}

static mt_status put_all(ply_writer *w, const ply_schema *schema, mt_encoding encoding)
{
    mt_status status = put_header(w, schema, encoding);
    if (status == MT_OK) {
        status = put_element(w, &schema->vertices);
    }
    if (status == MT_OK) {
        status = put_element(w, &schema->faces);
    }
    if (status == MT_OK) {
        status = put_edges(w, &schema->edges);
    }
    if (status == MT_OK) {
        status = flush(w);
    }
    if (w->partial_uvs) {
        mt_warn(w->context, "%llu corners without texture coordinates, in faces that have some, are written as nan",
                (unsigned long long)w->partial_uvs);
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
    ply_writer *w = mt_allocate(context, sizeof *w);
    status = w ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (w) {
        w->context = context;
        w->mesh = mesh;
        w->output = output;
        w->ascii = options->encoding == MT_ENCODING_ASCII;
        w->swap = is_swapped(options->encoding);
        w->line_begun = false;
        w->partial_uvs = 0;
        w->used = 0;
        status = put_all(w, &schema, options->encoding);
    }
    mt_free(context, w);
    mt_ply_schema_release(context, &schema);
    return status;
}
