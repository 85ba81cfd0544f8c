#include "formats/mesh/ply_header.h"

#include <string.h>

#define LINE_ROOM 1024    /* bytes of a header line; comments may be longer */
#define MAX_ELEMENTS 256u /* far beyond any real file; keeps the search for duplicates cheap */
#define MAX_WORDS 6       /* of a line; "property list uchar int name" has five */

typedef struct header_reader {
    mt_context *context;
    mt_input *input;
    ply_header *header;
    uint64_t line;
    char line_end;
    bool has_format;
    char text[LINE_ROOM + 1];
    size_t length; /* of the line, which may be more than was kept */
    char *words[MAX_WORDS];
    int word_count;
} header_reader;

static const struct {
    const char *name, *other_name;
    mt_type type;
} type_names[] = {{"uchar", "uint8", MT_U8},    {"char", "int8", MT_I8},      {"ushort", "uint16", MT_U16},
                  {"short", "int16", MT_I16},   {"uint", "uint32", MT_U32},   {"int", "int32", MT_I32},
                  {"float", "float32", MT_F32}, {"double", "float64", MT_F64}};

#define TYPE_COUNT (sizeof type_names / sizeof *type_names)

const char *mt_ply_type_name(mt_type type)
{
    return type_names[type].name; /* listed in the order of mt_type */
}

static mt_place here(const header_reader *r)
{
    return mt_input_place_line(r->input, r->line);
}

static mt_status fail(const header_reader *r, const char *sentence)
{
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r), "%s", sentence);
}

/* The first line tells how lines end, because a CR before a binary body may or may not belong to the header. */
static mt_status find_line_end(header_reader *r)
{
    const uint8_t *bytes;
    size_t size;
    mt_status status = mt_input_peek(r->context, r->input, &bytes, &size);
    if (status != MT_OK) {
        return status;
    }
    size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    if (size < mark + 3 || memcmp(bytes + mark, "ply", 3) != 0) {
        return fail(r, size == 0 ? "the file is empty; a PLY file begins with a line \"ply\""
                                 : "this is no PLY file: the first line is not \"ply\"");
    }
    size_t at = mark + 3;
    while (at < size && bytes[at] != '\n' && bytes[at] != '\r') {
        at++;
    }
    bool only_cr = at < size && bytes[at] == '\r' && (at + 1 == size || bytes[at + 1] != '\n');
    r->line_end = only_cr ? '\r' : '\n';
    uint8_t skipped[3];
    return mt_input_read_exactly(r->context, r->input, skipped, mark, "the header");
}

/* Reads one line into r->text, without its end; what is longer than the room is counted and not kept. */
static mt_status read_line(header_reader *r)
{
    r->line++;
    r->length = 0;
    for (;;) {
        char byte;
        size_t got;
        mt_status status = mt_input_read(r->context, r->input, &byte, 1, &got);
        if (status != MT_OK) {
            return status;
        }
        if (got == 0) {
            return fail(r, "the file ends inside the header; expected \"end_header\"");
        }
        if (byte == r->line_end) {
            break;
        }
        if (byte == 0) {
            return fail(r, "the header contains a zero byte; expected text up to \"end_header\"");
        }
        if (r->length < LINE_ROOM) {
            r->text[r->length] = byte;
        }
        r->length++;
    }
    size_t kept = r->length < LINE_ROOM ? r->length : LINE_ROOM;
    r->text[kept] = 0;
    return MT_OK;
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* Cuts the line into words; word_count is MAX_WORDS when there are that many or more. */
static void split_line(header_reader *r)
{
    r->word_count = 0;
    for (char *at = r->text; *at && r->word_count < MAX_WORDS;) {
        while (is_space(*at)) {
            *at++ = 0;
        }
        if (*at) {
            r->words[r->word_count++] = at;
        }
        while (*at && !is_space(*at)) {
            at++;
        }
    }
}

static bool parse_type(const char *word, mt_type *type)
{
    for (size_t i = 0; i < TYPE_COUNT; i++) {
        if (strcmp(word, type_names[i].name) == 0 || strcmp(word, type_names[i].other_name) == 0) {
            *type = type_names[i].type;
            return true;
        }
    }
    return false;
}

static mt_status require_type(header_reader *r, const char *word, mt_type *type)
{
    if (parse_type(word, type)) {
        return MT_OK;
    }
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r),
                      "unknown type \"%.40s\"; expected char, uchar, short, ushort, int, uint, float or double", word);
}

static mt_status parse_count(header_reader *r, const char *word, uint64_t *count)
{
    *count = 0;
    const char *at = word;
    for (; *at >= '0' && *at <= '9'; at++) {
        uint64_t digit = (uint64_t)(*at - '0');
        if (*count > (INT64_MAX - digit) / 10) {
            return mt_fail_at(r->context, MT_ERROR_TOO_LARGE, here(r), "the count %.40s is too large", word);
        }
        *count = *count * 10 + digit;
    }
    if (*at || at == word) {
        return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r), "the count \"%.40s\" is not a whole number from 0 up",
                          word);
    }
    return MT_OK;
}

static mt_status read_format(header_reader *r)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    if (r->word_count != 3 || r->has_format) {
        return fail(r, "expected one line \"format ascii|binary_little_endian|binary_big_endian 1.0\"");
    }
    if (strcmp(r->words[2], "1.0") != 0) {
        return mt_fail_at(r->context, MT_ERROR_UNSUPPORTED, here(r), "PLY version \"%.40s\" is not read; expected 1.0",
                          r->words[2]);
    }
    for (int i = 0; i < 3; i++) {
        if (strcmp(r->words[1], names[i]) == 0) {
            r->header->encoding = (ply_encoding)i;
            r->has_format = true;
            return MT_OK;
        }
    }
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r),
                      "unknown encoding \"%.40s\"; expected ascii, binary_little_endian or binary_big_endian",
                      r->words[1]);
}

/* Makes room for one more record, zeroed; room doubles at each power of two. */
static void *append_record(header_reader *r, void *records, uint32_t count, size_t size)
{
    bool full = (count & (count - 1)) == 0;
    char *grown = records;
    if (full) {
        grown = mt_reallocate(r->context, records, (count ? 2 * (uint64_t)count : 1) * size);
    }
    if (grown) {
        memset(grown + count * size, 0, size);
    }
    return grown;
}

static mt_status read_element(header_reader *r)
{
    ply_header *header = r->header;
    uint64_t count;
    if (r->word_count != 3) {
        return fail(r, "expected \"element NAME COUNT\"");
    }
    mt_status status = parse_count(r, r->words[2], &count);
    if (status != MT_OK) {
        return status;
    }
    for (uint32_t i = 0; i < header->element_count; i++) {
        if (strcmp(header->elements[i].name, r->words[1]) == 0) {
            return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r), "element \"%.80s\" is declared twice", r->words[1]);
        }
    }
    if (header->element_count == MAX_ELEMENTS) {
        return mt_fail_at(r->context, MT_ERROR_UNSUPPORTED, here(r), "more than %u elements are not read",
                          MAX_ELEMENTS);
    }
    ply_element *elements = append_record(r, header->elements, header->element_count, sizeof *elements);
    if (!elements) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    header->elements = elements;
    ply_element *element = &elements[header->element_count++];
    element->count = count;
    element->line = r->line;
    element->name = mt_duplicate_string(r->context, r->words[1]);
    return element->name ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status parse_property(header_reader *r, ply_property *property)
{
    if (r->word_count >= 2 && strcmp(r->words[1], "list") == 0) {
        if (r->word_count != 5) {
            return fail(r, "expected \"property list COUNT_TYPE TYPE NAME\"");
        }
        property->is_list = true;
        mt_status status = require_type(r, r->words[2], &property->count_type);
        if (status == MT_OK && property->count_type >= MT_F32) {
            status = fail(r, "the length of a list is declared as float or double; expected a whole-number type");
        }
        return status == MT_OK ? require_type(r, r->words[3], &property->type) : status;
    }
    if (r->word_count != 3) {
        return fail(r, "expected \"property TYPE NAME\"");
    }
    return require_type(r, r->words[1], &property->type);
}

static mt_status read_property(header_reader *r)
{
    ply_property property = {0};
    if (r->header->element_count == 0) {
        return fail(r, "a property stands before the first element");
    }
    ply_element *element = &r->header->elements[r->header->element_count - 1];
    mt_status status = parse_property(r, &property);
    if (status != MT_OK) {
        return status;
    }
    const char *name = r->words[r->word_count - 1];
    if (mt_ply_find_property(element, name) != UINT32_MAX) {
        return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r),
                          "property \"%.80s\" of element \"%.80s\" is declared twice", name, element->name);
    }
    if (element->property_count == PLY_MAX_PROPERTIES) {
        return mt_fail_at(r->context, MT_ERROR_UNSUPPORTED, here(r), "more than %u properties are not read",
                          PLY_MAX_PROPERTIES);
    }
    ply_property *properties = append_record(r, element->properties, element->property_count, sizeof *properties);
    if (!properties) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    element->properties = properties;
    property.name = mt_duplicate_string(r->context, name);
    if (!property.name) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    properties[element->property_count++] = property;
    return MT_OK;
}

static mt_status read_statement(header_reader *r, bool *at_end)
{
    static const struct {
        const char *word;
        mt_status (*read)(header_reader *r);
    } statements[] = {{"format", read_format}, {"element", read_element}, {"property", read_property}};
    split_line(r);
    if (r->word_count == 0 || strcmp(r->words[0], "comment") == 0 || strcmp(r->words[0], "obj_info") == 0) {
        return MT_OK;
    }
    if (r->length > LINE_ROOM) {
        return mt_fail_at(r->context, MT_ERROR_UNSUPPORTED, here(r), "a header line of %zu bytes is not read",
                          r->length);
    }
    *at_end = strcmp(r->words[0], "end_header") == 0;
    if (*at_end) {
        return r->has_format ? MT_OK : fail(r, "the header has no format line");
    }
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++) {
        if (strcmp(r->words[0], statements[i].word) == 0) {
            return statements[i].read(r);
        }
    }
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, here(r),
                      "unknown header line \"%.40s\"; expected element, property, comment or end_header", r->words[0]);
}

mt_status mt_ply_header_read(mt_context *context, mt_input *input, ply_header *out)
{
    *out = (ply_header){0};
    header_reader r = {.context = context, .input = input, .header = out, .line = 1};
    mt_status status = find_line_end(&r);
    r.line = 0;
    if (status == MT_OK) {
        status = read_line(&r);
    }
    if (status == MT_OK) {
        split_line(&r);
        if (r.word_count != 1 || strcmp(r.words[0], "ply") != 0) {
            status = fail(&r, "this is no PLY file: the first line is not \"ply\"");
        }
    }
    for (bool at_end = false; status == MT_OK && !at_end;) {
        status = read_line(&r);
        if (status == MT_OK) {
            status = read_statement(&r, &at_end);
        }
    }
    if (status != MT_OK) {
        mt_ply_header_release(context, out);
        return status;
    }
    out->body_offset = mt_input_offset(input);
    out->body_line = r.line + 1;
    return MT_OK;
}

void mt_ply_header_release(mt_context *context, ply_header *header)
{
    for (uint32_t i = 0; i < header->element_count; i++) {
        ply_element *element = &header->elements[i];
        for (uint32_t j = 0; j < element->property_count; j++) {
            mt_free(context, element->properties[j].name);
        }
        mt_free(context, element->properties);
        mt_free(context, element->name);
    }
    mt_free(context, header->elements);
    *header = (ply_header){0};
}

uint32_t mt_ply_find_property(const ply_element *element, const char *name)
{
    for (uint32_t i = 0; i < element->property_count; i++) {
        if (strcmp(element->properties[i].name, name) == 0) {
            return i;
        }
    }
    return UINT32_MAX;
}

uint64_t mt_ply_smallest_record(const ply_element *element, ply_encoding encoding)
{
    uint64_t size = 0;
    for (uint32_t i = 0; i < element->property_count; i++) {
        const ply_property *property = &element->properties[i];
        size += mt_type_size(property->is_list ? property->count_type : property->type);
    }
    return encoding == PLY_ASCII ? 2 * (uint64_t)element->property_count : size; /* a digit and a separator */
}
