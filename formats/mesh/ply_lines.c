#include "formats/mesh/ply_lines.h"

#include "formats/mesh/ply_rows.h"
#include "formats/stream/cursor.h"

#include <float.h>
#include <math.h>

static const ply_element *element_of(const ply_line *l)
{
    return &l->plan->header.elements[l->element];
}

/* What stands where a number was expected, for messages. */
static int word_length(const char *at)
{
    ptrdiff_t length = mt_skip_word(at) - at;
    return length > 40 ? 40 : (int)length;
}

static bool fail_word(ply_line *l, const ply_property *property, const char *expected)
{
    if (mt_is_line_end(*l->at)) {
        mt_text_fail(l->block, MT_ERROR_SYNTAX, l->at, "%s %llu ends before its property \"%.80s\", expected %s",
                     element_of(l)->name, (unsigned long long)l->record, property->name, expected);
    } else {
        mt_text_fail(l->block, MT_ERROR_SYNTAX, l->at, "property \"%.80s\" of %s %llu is \"%.*s\", expected %s",
                     property->name, element_of(l)->name, (unsigned long long)l->record, word_length(l->at), l->at,
                     expected);
    }
    return false;
}

static bool fail_memory(ply_line *l)
{
    mt_text_fail(l->block, MT_ERROR_OUT_OF_MEMORY, NULL, "memory for the faces is missing");
    return false;
}

/* Whole numbers must lie in the range of the declared type. */
static const struct {
    double least, most;
    const char *expected;
} ranges[] = {{0, UINT8_MAX, "a whole number from 0 to 255"},
              {INT8_MIN, INT8_MAX, "a whole number from -128 to 127"},
              {0, UINT16_MAX, "a whole number from 0 to 65535"},
              {INT16_MIN, INT16_MAX, "a whole number from -32768 to 32767"},
              {0, UINT32_MAX, "a whole number from 0 to 4294967295"},
              {INT32_MIN, INT32_MAX, "a whole number from -2147483648 to 2147483647"}};

/* Rounding the double again is right, unless it lies exactly between two floats or below the normal ones: then the
 * digits are asked again. */
static double round_to_float(const char *begin, const char *end, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    bool midway = (bits & 0x1fffffff) == 0x10000000;
    float single;
    if ((midway || fabs(number) < (double)FLT_MIN) && mt_number_parse_float(begin, end, &single)) {
        return (double)single;
    }
    return (double)(float)number;
}

static bool read_number(ply_line *l, const ply_property *property, double *number)
{
    const char *stop;
    l->at = mt_skip_blanks(l->at);
    mt_number_result result = mt_scan_number(l->at, l->block->end, number, &stop);
    if (result == MT_NUMBER_TOO_LARGE) {
        return fail_word(l, property, "a number that double precision can hold");
    }
    if (result != MT_NUMBER_OK || !mt_is_space(*stop)) {
        return fail_word(l, property, "a number");
    }
    if (property->type == MT_F32) {
        bool finite = isfinite(*number);
        *number = round_to_float(l->at, stop, *number);
        *l->overflows += finite && isinf(*number);
    } else if (property->type != MT_F64) {
        double value = *number;
        if (!(value >= ranges[property->type].least && value <= ranges[property->type].most) ||
            value != (double)(int64_t)value) {
            return fail_word(l, property, ranges[property->type].expected);
        }
    }
    l->at = stop;
    return true;
}

static bool fail_index(ply_line *l, const ply_property *property)
{
    const char *stop;
    mt_scan_unsigned(l->at, &stop);
    if (stop == l->at || !mt_is_space(*stop)) {
        return fail_word(l, property, "the number of a vertex, from 0");
    }
    mt_text_fail(l->block, MT_ERROR_SYNTAX, l->at,
                 "%s %llu names vertex %.*s, but the %lu vertices are numbered from 0", element_of(l)->name,
                 (unsigned long long)l->record, word_length(l->at), l->at, (unsigned long)l->plan->mesh->vertex_count);
    return false;
}

/* `count` numbers of vertices, below the count of vertices. The place stays in a register from one to the next. */
static bool read_indices(ply_line *l, const ply_property *property, mt_index *indices, uint64_t count)
{
    const char *at = l->at;
    mt_index vertices = l->plan->mesh->vertex_count;
    for (uint64_t i = 0; i < count; i++) {
        const char *stop;
        at = mt_skip_blanks(at);
        uint64_t number = mt_scan_unsigned(at, &stop);
        if (stop == at || !mt_is_space(*stop) || number >= vertices) {
            l->at = at;
            return fail_index(l, property);
        }
        indices[i] = (mt_index)number;
        at = stop;
    }
    l->at = at;
    return true;
}

static bool read_scalar(ply_line *l, const ply_property *property, const ply_target *target)
{
    if (target->use == PLY_SKIP) {
        l->at = mt_skip_blanks(l->at);
        if (mt_is_line_end(*l->at)) {
            return fail_word(l, property, "a number");
        }
        l->at = mt_skip_word(l->at);
        return true;
    }
    void *value = target->values + l->record * target->stride;
    if (l->element == l->plan->edges) {
        return read_indices(l, property, value, 1);
    }
    double number;
    if (!read_number(l, property, &number)) {
        return false;
    }
    mt_ply_store(number, target->type, value);
    return true;
}

/* A list's length; each item takes a byte of the block at least, which bounds it. */
static bool read_length(ply_line *l, const ply_property *property, uint64_t *length)
{
    const char *stop;
    l->at = mt_skip_blanks(l->at);
    *length = mt_scan_unsigned(l->at, &stop);
    if (stop == l->at || !mt_is_space(*stop)) {
        return fail_word(l, property, "the length of a list, a whole number from 0");
    }
    if (*length > (uint64_t)(l->block->end - stop)) {
        return fail_word(l, property, "a length that the line can hold");
    }
    l->at = stop;
    return true;
}

static bool read_vertices(ply_line *l, const ply_property *property, uint64_t count)
{
    ply_faces *faces = l->faces;
    if (faces->sides && count != faces->sides) {
        faces->differs = true;
        mt_text_fail(l->block, MT_ERROR_SYNTAX, l->at, "a face of other sides than the first");
        return false;
    }
    /* Room for all, if the others have as many corners, each of which takes two bytes. */
    uint64_t all = l->face_count * count, most = (uint64_t)(l->block->end - l->block->begin) / 2;
    if (!mt_ply_faces_reserve(l->context, faces, count, all < most ? all : most)) {
        return fail_memory(l);
    }
    if (!read_indices(l, property, faces->vertices + faces->corner_count, count)) {
        return false;
    }
    faces->corner_count += count;
    return true;
}

static bool read_uvs(ply_line *l, const ply_property *property, uint64_t count)
{
    ply_faces *faces = l->faces;
    size_t size = mt_type_size(property->type);
    if (!mt_ply_faces_reserve_uvs(l->context, faces, count)) {
        return fail_memory(l);
    }
    for (uint64_t i = 0; i < count; i++) {
        double number;
        if (!read_number(l, property, &number)) {
            return false;
        }
        mt_ply_store(number, property->type, faces->uv_values + (faces->uv_count + i) * size);
    }
    faces->uv_count += count;
    return true;
}

static bool read_list(ply_line *l, const ply_property *property, const ply_target *target)
{
    uint64_t count;
    if (!read_length(l, property, &count)) {
        return false;
    }
    if (target->use == PLY_FACE_VERTICES) {
        return read_vertices(l, property, count);
    }
    if (target->use == PLY_FACE_UVS) {
        return read_uvs(l, property, count);
    }
    for (uint64_t i = 0; i < count; i++) {
        if (!read_scalar(l, property, target)) {
            return false;
        }
    }
    return true;
}

static bool end_face(ply_line *l, const char *begin)
{
    const char *wrong = mt_ply_faces_end_record(l->faces);
    if (wrong) {
        mt_text_fail(l->block, MT_ERROR_SYNTAX, begin, "face %llu %s", (unsigned long long)l->record, wrong);
        return false;
    }
    if (!l->faces->sides) {
        l->plan->mesh->face_offsets[l->record + 1] = (mt_index)l->faces->corner_count; /* within the block for now */
    }
    return true;
}

bool mt_ply_read_line(ply_line *l)
{
    const ply_element *e = element_of(l);
    const char *begin = l->at;
    if (!mt_ply_plan_uses(l->plan, l->element)) {
        return true;
    }
    for (uint32_t i = 0; i < e->property_count; i++) {
        const ply_property *property = &e->properties[i];
        const ply_target *target = &l->plan->targets[l->element][i];
        if (property->is_list ? !read_list(l, property, target) : !read_scalar(l, property, target)) {
            return false;
        }
    }
    l->at = mt_skip_blanks(l->at);
    if (!mt_is_line_end(*l->at)) {
        mt_text_fail(l->block, MT_ERROR_SYNTAX, l->at, "%s %llu goes on with \"%.*s\", expected the end of the line",
                     e->name, (unsigned long long)l->record, word_length(l->at), l->at);
        return false;
    }
    return l->element != l->plan->faces || end_face(l, begin);
}
