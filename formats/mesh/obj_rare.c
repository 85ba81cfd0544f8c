/* The statements that come seldom: wires, points, names, and what is not known. */
#include "formats/mesh/obj_parser.h"

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
bool mt_obj_add_unknown(mt_obj_parser *parser, int kind, const char *at)
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

/* A line that is not known is left out whole, with the lines that continue it. */
static const char *skip_unknown(mt_obj_parser *parser, const char *at)
{
    if (!mt_obj_add_unknown(parser, MT_OBJ_UNKNOWN_KEYWORD, at)) {
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
        return mt_obj_scan_tag(parser, at, end);
    }
    parser->block->statement_count--;
    return skip_unknown(parser, at);
}
