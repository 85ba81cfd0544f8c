/* The statements that come seldom: wires, points, names, tags, and what is not known. */
#include "formats/mesh/obj_parser.h"

#define TAG_ROOM 4096 /* numbers of one tag */

bool mt_obj_add_event(mt_obj_parser *parser, int kind, const char *at, const char *begin, const char *end)
{
    mt_obj_block *block = parser->block;
    size_t size = (size_t)(end - begin);
    if (!mt_obj_parser_reserve(parser, MT_OBJ_EVENTS, 1) || !mt_obj_parser_reserve(parser, MT_OBJ_NAMES, size + 1)) {
        return false;
    }
    char *names = (char *)block->items[MT_OBJ_NAMES] + block->counts[MT_OBJ_NAMES];
    memcpy(names, begin, size);
    names[size] = '\0';
    mt_obj_event *event = (mt_obj_event *)block->items[MT_OBJ_EVENTS] + block->counts[MT_OBJ_EVENTS]++;
    *event = (mt_obj_event){.kind = kind,
                            .face = block->face_count,
                            .name = block->counts[MT_OBJ_NAMES],
                            .offset = parser->text->offset + (uint64_t)(at - parser->text->begin)};
    block->counts[MT_OBJ_NAMES] += size + 1;
    return true;
}

/* As mt_obj_add_event, but once a block for each name. */
static bool add_unknown(mt_obj_parser *parser, int kind, const char *at)
{
    mt_obj_block *block = parser->block;
    char word[MT_TEXT_WORD];
    mt_text_word(at, word);
    for (size_t i = 0; i < block->unknown_count; i++) {
        const mt_obj_event *event = (const mt_obj_event *)block->items[MT_OBJ_EVENTS] + block->unknown_events[i];
        if (event->kind == kind && strcmp((const char *)block->items[MT_OBJ_NAMES] + event->name, word) == 0) {
            return true;
        }
    }
    if (block->unknown_count == MT_OBJ_UNKNOWN_ROOM) {
        return true;
    }
    block->unknown_events[block->unknown_count++] = block->counts[MT_OBJ_EVENTS];
    return mt_obj_add_event(parser, kind, at, word, word + strlen(word));
}

/* The vertices of a wire or of points. */
static const char *scan_vertices(mt_obj_parser *parser, const char *at, mt_obj_series series,
                                 mt_obj_series relative_series, mt_index *count)
{
    mt_obj_block *block = parser->block;
    *count = 0;
    at = mt_obj_skip(parser, at);
    while (at && !mt_obj_at_end(at)) {
        const char *begin = at;
        mt_index index;
        bool relative = false;
        at = mt_obj_reference(parser, at, MT_OBJ_VERTEX, &index, &relative);
        /* A wire's texture vertices are checked and let go. */
        if (at && series == MT_OBJ_WIRE_VERTICES && *at == '/' && !mt_is_space(at[1])) {
            mt_index uv;
            bool uv_relative;
            at = mt_obj_reference(parser, at + 1, MT_OBJ_UV, &uv, &uv_relative);
            block->wire_uv_count++;
        } else if (at && *at == '/') {
            at++;
        }
        if (!at || !mt_obj_parser_reserve(parser, series, 1) ||
            (relative && !mt_obj_parser_reserve(parser, relative_series, 1))) {
            return NULL;
        }
        if (!mt_is_space(*at) && !mt_obj_is_continuation(at)) {
            char word[MT_TEXT_WORD];
            mt_text_word(begin, word);
            mt_text_fail(parser->text, MT_ERROR_SYNTAX, begin, "expected the number of a vertex, found \"%s\"", word);
            return NULL;
        }
        if (relative) {
            ((mt_index *)block->items[relative_series])[block->counts[relative_series]++] =
                (mt_index)block->counts[series];
        }
        ((mt_index *)block->items[series])[block->counts[series]++] = index;
        ++*count;
        at = mt_obj_skip(parser, at);
    }
    return at;
}

static const char *scan_wire(mt_obj_parser *parser, const char *line, const char *at)
{
    mt_index count;
    at = scan_vertices(parser, at, MT_OBJ_WIRE_VERTICES, MT_OBJ_RELATIVE_WIRES, &count);
    if (!at || !mt_obj_parser_reserve(parser, MT_OBJ_WIRE_SIDES, 1)) {
        return NULL;
    }
    if (count < 2) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, line, "a wire of %lu vertices, expected 2 or more",
                     (unsigned long)count);
        return NULL;
    }
    mt_obj_block *block = parser->block;
    ((mt_index *)block->items[MT_OBJ_WIRE_SIDES])[block->counts[MT_OBJ_WIRE_SIDES]++] = count;
    return at;
}

static const char *scan_points(mt_obj_parser *parser, const char *line, const char *at)
{
    mt_index count;
    at = scan_vertices(parser, at, MT_OBJ_POINTS, MT_OBJ_RELATIVE_POINTS, &count);
    if (at && count == 0) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, line, "a point statement without a vertex, expected 1 or more");
        return NULL;
    }
    return at;
}

/* A name is the rest of the line, blanks at its end left out; no continuation and no comment is looked for in it. */
static const char *scan_name(mt_obj_parser *parser, const char *line, const char *at, int kind)
{
    at = mt_skip_blanks(at);
    const char *end = mt_find_line_end(at), *stop = end;
    while (stop > at && mt_is_blank(stop[-1])) {
        stop--;
    }
    bool off = kind == MT_OBJ_LABEL + MT_LABEL_SMOOTHING &&
               ((stop - at == 3 && memcmp(at, "off", 3) == 0) || (stop - at == 1 && *at == '0'));
    return mt_obj_add_event(parser, kind, line, at, off ? at : stop) ? end : NULL;
}

static const char *fail_tag(mt_obj_parser *parser, const char *at, const char *expected)
{
    char word[MT_TEXT_WORD];
    mt_text_word(at, word);
    mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "in a tag, expected %s, found \"%s\"", expected, word);
    return NULL;
}

/* The "2/1/0" of a tag: how many whole numbers, numbers and words follow. */
static const char *scan_tag_counts(mt_obj_parser *parser, const char *at, uint64_t counts[3])
{
    const char *begin = at;
    for (int i = 0; i < 3; i++) {
        const char *stop;
        counts[i] = mt_scan_unsigned(at, &stop);
        bool ends = i == 2 ? mt_is_space(*stop) : *stop == '/';
        if (stop == at || !ends) {
            return fail_tag(parser, begin, "three counts as 2/1/0");
        }
        at = i == 2 ? stop : stop + 1;
    }
    if (counts[0] > TAG_ROOM || counts[1] > TAG_ROOM) {
        return fail_tag(parser, begin, "at most 4096 numbers");
    }
    return at;
}

/* A vertex in a tag counts from 0. */
static const char *scan_tag_vertex(mt_obj_parser *parser, const char *at, mt_index *vertex)
{
    const char *stop;
    uint64_t number = mt_scan_unsigned(at, &stop);
    if (stop == at || !mt_is_space(*stop)) {
        return fail_tag(parser, at, "the number of a vertex");
    }
    uint64_t count = parser->limits->counts[MT_OBJ_VERTEX];
    if (number >= count) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at,
                     "vertex %llu of a tag does not exist: tags count from 0 and the file has %llu vertices",
                     (unsigned long long)number, (unsigned long long)count);
        return NULL;
    }
    *vertex = (mt_index)number;
    return stop;
}

/* Stores vertex number i of a tag: the next in the chain of a crease, or one of a corner tag's list. */
static void store_tag_vertex(mt_obj_block *block, bool crease, uint64_t i, mt_index vertex)
{
    if (!crease) {
        mt_vertex_value *items = block->items[MT_OBJ_SHARP_VERTICES];
        items[block->counts[MT_OBJ_SHARP_VERTICES] + i].vertex = vertex;
        return;
    }
    mt_edge_value *items = (mt_edge_value *)block->items[MT_OBJ_CREASES] + block->counts[MT_OBJ_CREASES];
    if (i > 0) {
        items[i - 1].b = vertex;
    }
    items[i].a = vertex;
}

static void store_tag_value(mt_obj_block *block, bool crease, uint64_t i, double value)
{
    if (crease) {
        mt_edge_value *items = block->items[MT_OBJ_CREASES];
        items[block->counts[MT_OBJ_CREASES] + i].value = value;
    } else {
        mt_vertex_value *items = block->items[MT_OBJ_SHARP_VERTICES];
        items[block->counts[MT_OBJ_SHARP_VERTICES] + i].value = value;
    }
}

/* The vertices of a crease make a chain, each edge with its own sharpness or all with the only one; a corner tag is a
 * list of vertices, likewise. */
static const char *scan_sharpness(mt_obj_parser *parser, const char *line, const char *at, const uint64_t counts[3],
                                  bool crease)
{
    mt_obj_series series = crease ? MT_OBJ_CREASES : MT_OBJ_SHARP_VERTICES;
    uint64_t item_count = crease && counts[0] > 0 ? counts[0] - 1 : counts[0];
    if (item_count == 0 || counts[2] != 0 || (counts[1] != 1 && counts[1] != item_count)) {
        return fail_tag(parser, line,
                        crease ? "crease N/1/0 or N/(N-1)/0, the vertices and the sharpness"
                               : "corner N/1/0 or N/N/0, the vertices and the sharpness");
    }
    if (!mt_obj_parser_reserve(parser, series, counts[0])) {
        return NULL;
    }
    for (uint64_t i = 0; i < counts[0]; i++) {
        mt_index vertex = 0;
        at = mt_obj_skip(parser, at);
        at = at ? scan_tag_vertex(parser, at, &vertex) : NULL;
        if (!at) {
            return NULL;
        }
        store_tag_vertex(parser->block, crease, i, vertex);
    }
    double value = 0.0;
    for (uint64_t i = 0; i < item_count; i++) {
        if (i < counts[1]) {
            at = mt_obj_skip(parser, at);
            at = at ? mt_obj_number(parser, at, &value) : NULL;
        }
        if (!at) {
            return NULL;
        }
        store_tag_value(parser->block, crease, i, value);
    }
    parser->block->counts[series] += item_count;
    return mt_obj_skip(parser, at);
}

static const char *scan_tag(mt_obj_parser *parser, const char *line, const char *at)
{
    uint64_t counts[3];
    at = mt_obj_skip(parser, at);
    if (!at) {
        return NULL;
    }
    const char *name = at, *end = mt_skip_word(at);
    bool crease = end - name == 6 && memcmp(name, "crease", 6) == 0;
    bool corner = end - name == 6 && memcmp(name, "corner", 6) == 0;
    if (!crease && !corner) {
        return add_unknown(parser, MT_OBJ_UNKNOWN_TAG, name) ? mt_find_line_end(end) : NULL;
    }
    at = mt_obj_skip(parser, end);
    at = at ? scan_tag_counts(parser, at, counts) : NULL;
    return at ? scan_sharpness(parser, line, at, counts, crease) : NULL;
}

/* A line that is not known is left out whole, with the lines that continue it. */
static const char *skip_unknown(mt_obj_parser *parser, const char *at)
{
    if (!add_unknown(parser, MT_OBJ_UNKNOWN_KEYWORD, at)) {
        return NULL;
    }
    at = mt_find_line_end(at);
    while (at[-1] == '\\') {
        const char *next = mt_skip_line_end(at, parser->text->end);
        if (next >= parser->text->end) {
            break;
        }
        at = mt_find_line_end(next);
    }
    return at;
}

const char *mt_obj_rare_statement(mt_obj_parser *parser, const char *at)
{
    static const struct {
        char word[8];
        int kind;
    } names[] = {{"g", MT_OBJ_LABEL + MT_LABEL_GROUP},
                 {"o", MT_OBJ_LABEL + MT_LABEL_OBJECT},
                 {"usemtl", MT_OBJ_LABEL + MT_LABEL_MATERIAL},
                 {"s", MT_OBJ_LABEL + MT_LABEL_SMOOTHING},
                 {"mtllib", MT_OBJ_LIBRARY}};
    const char *end = mt_skip_word(at);
    size_t size = (size_t)(end - at);
    parser->block->statement_count++;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strlen(names[i].word) == size && memcmp(at, names[i].word, size) == 0) {
            return scan_name(parser, at, end, names[i].kind);
        }
    }
    if (size == 1 && *at == 'l') {
        return scan_wire(parser, at, end);
    }
    if (size == 1 && *at == 'p') {
        return scan_points(parser, at, end);
    }
    if (size == 1 && *at == 't') {
        return scan_tag(parser, at, end);
    }
    parser->block->statement_count--;
    return skip_unknown(parser, at);
}
