/* Parsing. jansson's allocator is a global of the process and so is left alone; what it may take is counted beforehand.
 */
#include "formats/stream/json.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* Bytes that jansson 2.14 takes on a 64-bit glibc for each mark of the text, rounded up; with them the growth of its
 * tables, when the old one and the new one are there at once. */
#define OBJECT_BYTES 240 /* the value, and its first table of 8 buckets */
#define ARRAY_BYTES 160  /* the value, and its first table of 8 elements */
#define MEMBER_BYTES 176 /* of a colon: the pair, its share of the buckets, and a number */
#define ELEMENT_BYTES 64 /* of a comma or an opening bracket: a number, and its share of the table */
#define STRING_BYTES 80  /* of a string or key, besides its characters */
#define TEXT_BYTES 4     /* of a character in a string: the value, the token, and the token's old half while it grows */
#define FIXED_BYTES 4096

/* One look at the text, in step with a parser as long as the text is right. */
typedef struct scan {
    uint64_t bound;
    uint64_t string_bytes; /* of all strings and keys, escapes resolved */
    size_t depth;
    size_t too_deep; /* where the depth was first past MT_JSON_DEPTH; SIZE_MAX: nowhere */
} scan;

/* Bytes in UTF-8 of the unit whose four digits are at `digits`; a half of a pair of surrogates is half of four. */
static uint64_t unit_size(const char *digits)
{
    unsigned unit = 0;
    for (int i = 0; i < 4; i++) {
        unsigned c = (unsigned char)digits[i];
        unit = 16 * unit + (c <= '9' ? c - '0' : c % 32 + 9);
    }
    bool is_surrogate = unit >= 0xD800 && unit < 0xE000;
    return unit < 0x80 ? 1 : unit < 0x800 || is_surrogate ? 2 : 3;
}

/* The byte after the string whose opening quote is at `at`; adds its bytes to *bytes. */
static size_t skip_string(const char *text, size_t size, size_t at, uint64_t *bytes)
{
    for (at++; at < size && text[at] != '"'; at++) {
        if (text[at] == '\\' && ++at < size && text[at] == 'u' && size - at > 4) {
            *bytes += unit_size(text + at + 1);
            at += 4;
        } else {
            ++*bytes;
        }
    }
    return at < size ? at + 1 : size;
}

static scan scan_text(const char *text, size_t size)
{
    scan s = {.bound = FIXED_BYTES, .too_deep = SIZE_MAX};
    for (size_t at = 0; at < size;) {
        size_t begin = at++;
        switch (text[begin]) {
        case '"':
            at = skip_string(text, size, begin, &s.string_bytes);
            s.bound += STRING_BYTES + TEXT_BYTES * (uint64_t)(at - begin);
            break;
        case '{':
        case '[':
            s.bound += text[begin] == '{' ? ELEMENT_BYTES + OBJECT_BYTES : ELEMENT_BYTES + ARRAY_BYTES;
            if (++s.depth > MT_JSON_DEPTH && s.too_deep == SIZE_MAX) {
                s.too_deep = begin;
            }
            break;
        case '}':
        case ']':
            s.depth -= s.depth > 0;
            break;
        case ':':
            s.bound += MEMBER_BYTES;
            break;
        case ',':
            s.bound += ELEMENT_BYTES;
            break;
        default:
            s.bound += TEXT_BYTES; /* a token outside of strings may be long too */
        }
    }
    return s;
}

uint64_t mt_json_bound(const void *bytes, size_t size)
{
    return scan_text(bytes, size).bound;
}

mt_place mt_json_place(const char *name, const char *text, size_t size, size_t at)
{
    mt_place place = {.file = name, .line = 1, .column = 1};
    at = at < size ? at : size;
    for (size_t i = 0; i < at; i++) {
        bool ends = text[i] == '\n';
        place.line += ends;
        place.column = ends ? 1 : place.column + 1;
    }
    return place;
}

/* The sentence for one of jansson's codes; NULL: its own text says more. */
static const char *sentence_of(enum json_error_code code)
{
    switch (code) {
    case json_error_invalid_utf8:
        return "these bytes are not UTF-8, in which JSON is written";
    case json_error_premature_end_of_input:
        return "the JSON ends here, inside a value";
    case json_error_null_character:
    case json_error_null_byte_in_key:
        return "a string holds a NUL character, which is not read";
    case json_error_numeric_overflow:
        return "the number is too large";
    case json_error_stack_overflow:
        return "brackets are nested too deeply";
    default:
        return NULL;
    }
}

static mt_status fail_parsing(mt_context *context, const char *name, const char *text, size_t size,
                              const json_error_t *error)
{
    enum json_error_code code = json_error_code(error);
    if (code == json_error_out_of_memory || errno == ENOMEM) {
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "%s: out of memory while its JSON was parsed", name);
    }
    /* The position is that of the byte after what jansson read, and of the bad byte itself when it is no UTF-8. */
    size_t at = (size_t)error->position;
    at -= at > 0 && code != json_error_invalid_utf8;
    mt_place place = mt_json_place(name, text, size, at);
    const char *sentence = sentence_of(code);
    if (sentence) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, place, "%s", sentence);
    }
    char said[JSON_ERROR_TEXT_LENGTH];
    snprintf(said, sizeof said, "%s", error->text);
    for (char *c = said; *c; c++) {
        *c = *c >= ' ' && *c < 0x7F ? *c : '?';
    }
    return mt_fail_at(context, MT_ERROR_SYNTAX, place, "this is no JSON: %s", said);
}

/* jansson takes a NUL outside of a string for the end. */
static mt_status refuse_nul(mt_context *context, const char *name, const char *text, size_t size)
{
    const char *nul = memchr(text, 0, size);
    if (!nul) {
        return MT_OK;
    }
    mt_place place = mt_json_place(name, text, size, (size_t)(nul - text));
    return mt_fail_at(context, MT_ERROR_SYNTAX, place, "a NUL byte stands here, which JSON does not hold");
}

static bool is_utf16(const char *text, size_t size)
{
    return size >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0);
}

/* jansson holds whole numbers in 64 bits; where one needs more, all are read as reals. */
static json_t *load(const char *text, size_t size, json_error_t *error)
{
    errno = 0; /* jansson does not tell want of memory from text that is wrong */
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, error);
    if (!root && json_error_code(error) == json_error_numeric_overflow) {
        root = json_loadb(text, size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, error);
    }
    return root;
}

/* Bytes of all strings and keys. */
static uint64_t string_bytes(json_t *value)
{
    uint64_t sum = 0;
    if (json_is_string(value)) {
        sum = json_string_length(value);
    } else if (json_is_array(value)) {
        for (size_t i = 0; i < json_array_size(value); i++) {
            sum += string_bytes(json_array_get(value, i));
        }
    } else if (json_is_object(value)) {
        for (void *at = json_object_iter(value); at; at = json_object_iter_next(value, at)) {
            sum += strlen(json_object_iter_key(at)) + string_bytes(json_object_iter_value(at));
        }
    }
    return sum;
}

mt_status mt_json_parse(mt_context *context, const char *name, const void *bytes, size_t size, mt_json *out)
{
    const char *text = bytes;
    memset(out, 0, sizeof *out);
    if (size > INT32_MAX) { /* jansson counts positions in an int */
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%s: %zu bytes of JSON are more than the 2 GB that are read", name,
                       size);
    }
    if (is_utf16(text, size)) {
        mt_place place = {.file = name};
        return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place,
                          "is text in UTF-16; convert it to UTF-8 first (iconv -f utf-16 -t utf-8)");
    }
    size_t mark = size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    scan seen = scan_text(text + mark, size - mark);
    if (seen.too_deep != SIZE_MAX) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, mt_json_place(name, text, size, mark + seen.too_deep),
                          "brackets are nested more than %d deep", MT_JSON_DEPTH);
    }
    mt_status status = refuse_nul(context, name, text, size);
    if (status == MT_OK) {
        status = mt_hold_bytes(context, seen.bound);
    }
    if (status != MT_OK) {
        return status;
    }
    json_error_t error;
    json_t *root = load(text + mark, size - mark, &error);
    if (!root) {
        mt_release_bytes(context, seen.bound);
        error.position += (int)mark;
        return fail_parsing(context, name, text, size, &error);
    }
    /* Where jansson has no memory for the next byte of a string it goes on without that byte. */
    if (string_bytes(root) != seen.string_bytes) {
        json_decref(root);
        mt_release_bytes(context, seen.bound);
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "%s: out of memory while a string of its JSON was read", name);
    }
    out->root = root;
    out->held = seen.bound;
    return MT_OK;
}

void mt_json_release(mt_context *context, mt_json *json)
{
    json_decref(json->root);
    mt_release_bytes(context, json->held);
    memset(json, 0, sizeof *json);
}
