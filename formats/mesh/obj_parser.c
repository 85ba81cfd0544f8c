/* The statements that a file is full of: v, vt, vn and f. */
#include "formats/mesh/obj_parser.h"

/* Fills an array that nothing needed up to now: `count` items of `value`. */
static bool fill_doubles(mt_obj_parser *parser, mt_obj_series series, size_t count, size_t components, double value)
{
    if (!mt_obj_parser_reserve(parser, series, count + 1)) {
        return false;
    }
    double *items = parser->block->items[series];
    for (size_t i = 0; i < count * components; i++) {
        items[i] = value;
    }
    parser->block->counts[series] = count;
    return true;
}

/* The numbers of a v after the third: a weight, or a colour. */
static const char *scan_vertex_rest(mt_obj_parser *parser, const char *line, const char *at)
{
    mt_obj_block *block = parser->block;
    size_t vertex = block->counts[MT_OBJ_POSITIONS] - 1;
    double rest[4];
    size_t count = 0;
    while (at && !mt_obj_at_end(at)) {
        if (count == 4) {
            mt_text_fail(parser->text, MT_ERROR_SYNTAX, at,
                         "a vertex with more than 6 numbers, expected 3, 4 (a weight) or 6 (a color)");
            return NULL;
        }
        at = mt_obj_number(parser, at, &rest[count++]);
        at = at ? mt_obj_skip(parser, at) : NULL;
    }
    if (at && (count == 2 || count == 4)) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, line,
                     "a vertex with %zu numbers, expected 3, 4 (a weight) or 6 (a color)", 3 + count);
        return NULL;
    }
    block->weight_count += at && count == 1 && rest[0] != 1.0;
    if (at && count == 3) {
        bool first = block->counts[MT_OBJ_COLORS] == 0;
        if ((first && !fill_doubles(parser, MT_OBJ_COLORS, vertex, 3, 1.0)) ||
            !mt_obj_parser_reserve(parser, MT_OBJ_COLORS, 1)) {
            return NULL;
        }
        block->uncolored_count = first ? vertex : block->uncolored_count;
        memcpy((double *)block->items[MT_OBJ_COLORS] + 3 * block->counts[MT_OBJ_COLORS]++, rest, 3 * sizeof rest[0]);
    }
    return at;
}

static const char *scan_vertex(mt_obj_parser *parser, const char *line, const char *at)
{
    mt_obj_block *block = parser->block;
    if (!mt_obj_parser_reserve(parser, MT_OBJ_POSITIONS, 1)) {
        return NULL;
    }
    double *position = (double *)block->items[MT_OBJ_POSITIONS] + 3 * block->counts[MT_OBJ_POSITIONS];
    for (int i = 0; i < 3; i++) {
        at = mt_obj_skip(parser, at);
        at = at ? mt_obj_number(parser, at, &position[i]) : NULL;
        if (!at) {
            return NULL;
        }
    }
    block->counts[MT_OBJ_POSITIONS]++;
    at = mt_obj_skip(parser, at);
    if (at && !mt_is_line_end(*at)) {
        at = scan_vertex_rest(parser, line, at);
    }
    if (at && block->counts[MT_OBJ_COLORS] > 0 && block->counts[MT_OBJ_COLORS] < block->counts[MT_OBJ_POSITIONS]) {
        /* Others have a colour and this one has none: white. */
        if (!mt_obj_parser_reserve(parser, MT_OBJ_COLORS, 1)) {
            return NULL;
        }
        double *color = (double *)block->items[MT_OBJ_COLORS] + 3 * block->counts[MT_OBJ_COLORS]++;
        color[0] = color[1] = color[2] = 1.0;
        block->uncolored_count++;
    }
    return at;
}

static const char *scan_uv(mt_obj_parser *parser, const char *at)
{
    mt_obj_block *block = parser->block;
    double numbers[3] = {0.0, 0.0, 0.0};
    size_t uv = block->counts[MT_OBJ_UVS];
    for (int i = 0; i < 3; i++) {
        at = mt_obj_skip(parser, at);
        if (at && i > 0 && mt_obj_at_end(at)) {
            break;
        }
        at = at ? mt_obj_number(parser, at, &numbers[i]) : NULL;
        if (!at) {
            return NULL;
        }
    }
    bool deep = block->counts[MT_OBJ_DEPTHS] > 0;
    if (!deep && numbers[2] != 0.0) {
        deep = true;
        if (!fill_doubles(parser, MT_OBJ_DEPTHS, uv, 1, 0.0)) {
            return NULL;
        }
    }
    if (!mt_obj_parser_reserve(parser, MT_OBJ_UVS, 1) || (deep && !mt_obj_parser_reserve(parser, MT_OBJ_DEPTHS, 1))) {
        return NULL;
    }
    memcpy((double *)block->items[MT_OBJ_UVS] + 2 * block->counts[MT_OBJ_UVS]++, numbers, 2 * sizeof numbers[0]);
    if (deep) {
        ((double *)block->items[MT_OBJ_DEPTHS])[block->counts[MT_OBJ_DEPTHS]++] = numbers[2];
    }
    return mt_obj_skip(parser, at);
}

static const char *scan_normal(mt_obj_parser *parser, const char *at)
{
    mt_obj_block *block = parser->block;
    if (!mt_obj_parser_reserve(parser, MT_OBJ_NORMALS, 1)) {
        return NULL;
    }
    double *normal = (double *)block->items[MT_OBJ_NORMALS] + 3 * block->counts[MT_OBJ_NORMALS];
    for (int i = 0; i < 3; i++) {
        at = mt_obj_skip(parser, at);
        at = at ? mt_obj_number(parser, at, &normal[i]) : NULL;
        if (!at) {
            return NULL;
        }
    }
    block->counts[MT_OBJ_NORMALS]++;
    return mt_obj_skip(parser, at);
}

static bool list_relative(mt_obj_parser *parser, mt_obj_series series, size_t corner)
{
    if (!mt_obj_parser_reserve(parser, series, 1)) {
        return false;
    }
    mt_index *items = parser->block->items[series];
    items[parser->block->counts[series]++] = (mt_index)corner;
    return true;
}

/* A UV or normal of the corner that is being read, which is number `corner`. */
static bool store_extra(mt_obj_parser *parser, mt_obj_series series, size_t corner, mt_index index)
{
    mt_obj_block *block = parser->block;
    size_t count = block->counts[series];
    if (!mt_obj_parser_reserve(parser, series, corner + 1 - count)) {
        return false;
    }
    mt_index *items = block->items[series];
    /* Corners before this one that have none. */
    for (; count < corner; count++) {
        items[count] = MT_NONE;
    }
    items[count] = index;
    block->counts[series] = count + 1;
    return true;
}

/* The "/2/3" of a corner. */
static const char *scan_corner_rest(mt_obj_parser *parser, const char *at, size_t corner)
{
    static const mt_obj_series stores[] = {0, MT_OBJ_CORNER_UVS, MT_OBJ_CORNER_NORMALS};
    static const mt_obj_series relatives[] = {0, MT_OBJ_RELATIVE_UVS, MT_OBJ_RELATIVE_NORMALS};
    for (int element = MT_OBJ_UV; element <= MT_OBJ_NORMAL && *at == '/'; element++) {
        at++;
        if (*at == '/' || mt_is_space(*at) || mt_obj_is_continuation(at)) {
            continue;
        }
        mt_index index;
        bool relative = false;
        at = mt_obj_reference(parser, at, (mt_obj_element)element, &index, &relative);
        if (!at || (relative && !list_relative(parser, relatives[element], corner)) ||
            !store_extra(parser, stores[element], corner, index)) {
            return NULL;
        }
    }
    return at;
}

static const char *fail_corner(mt_obj_parser *parser, const char *corner)
{
    char word[MT_TEXT_WORD];
    mt_text_word(corner, word);
    mt_text_fail(parser->text, MT_ERROR_SYNTAX, corner, "expected a corner as 1, 1/2, 1/2/3 or 1//3, found \"%s\"",
                 word);
    return NULL;
}

/* The face has ended with `sides` corners. */
static bool finish_face(mt_obj_parser *parser, const char *line, mt_index sides)
{
    mt_obj_block *block = parser->block;
    if (sides < 3) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, line, "a face of %lu corners, expected 3 or more",
                     (unsigned long)sides);
        return false;
    }
    if (sides != block->face_size || block->counts[MT_OBJ_SIDES] > 0) {
        if (block->face_count > 0 && block->counts[MT_OBJ_SIDES] == 0) {
            if (!mt_obj_parser_reserve(parser, MT_OBJ_SIDES, block->face_count)) {
                return false;
            }
            mt_index *items = block->items[MT_OBJ_SIDES];
            for (mt_index face = 0; face < block->face_count; face++) {
                items[face] = block->face_size;
            }
            block->counts[MT_OBJ_SIDES] = block->face_count;
        }
        if (block->face_count > 0) {
            if (!mt_obj_parser_reserve(parser, MT_OBJ_SIDES, 1)) {
                return false;
            }
            ((mt_index *)block->items[MT_OBJ_SIDES])[block->counts[MT_OBJ_SIDES]++] = sides;
        }
        block->face_size = block->face_count == 0 ? sides : block->face_size;
    }
    block->face_count++;
    return true;
}

static const char *scan_face(mt_obj_parser *parser, const char *line, const char *at)
{
    mt_obj_block *block = parser->block;
    mt_index sides = 0;
    at = mt_obj_skip(parser, at);
    while (at && !mt_obj_at_end(at)) {
        size_t corner = block->counts[MT_OBJ_CORNERS];
        const char *begin = at;
        mt_index index;
        bool relative = false;
        at = mt_obj_reference(parser, at, MT_OBJ_VERTEX, &index, &relative);
        if (!at || !mt_obj_parser_reserve(parser, MT_OBJ_CORNERS, 1) ||
            (relative && !list_relative(parser, MT_OBJ_RELATIVE_CORNERS, corner))) {
            return NULL;
        }
        if (*at == '/') {
            at = scan_corner_rest(parser, at, corner);
        }
        if (!at) {
            return NULL;
        }
        if (!mt_is_space(*at) && !mt_obj_is_continuation(at)) {
            return fail_corner(parser, begin);
        }
        ((mt_index *)block->items[MT_OBJ_CORNERS])[block->counts[MT_OBJ_CORNERS]++] = index;
        sides++;
        at = mt_obj_skip(parser, at);
    }
    return at && finish_face(parser, line, sides) ? at : NULL;
}

static const char *scan_statement(mt_obj_parser *parser, const char *at)
{
    if (at[0] == 'f' && mt_is_space(at[1])) {
        parser->block->statement_count++;
        return scan_face(parser, at, at + 1);
    }
    if (at[0] == 'v' && mt_is_space(at[1])) {
        parser->block->statement_count++;
        return scan_vertex(parser, at, at + 1);
    }
    if (at[0] == 'v' && at[1] == 'n' && mt_is_space(at[2])) {
        parser->block->statement_count++;
        return scan_normal(parser, at + 2);
    }
    if (at[0] == 'v' && at[1] == 't' && mt_is_space(at[2])) {
        parser->block->statement_count++;
        return scan_uv(parser, at + 2);
    }
    return mt_obj_rare_statement(parser, at);
}

void mt_obj_parse(mt_context *context, mt_text_block *text, const mt_obj_limits *limits, const mt_obj_bases *bases,
                  mt_obj_block *into)
{
    mt_obj_parser parser = {.context = context, .text = text, .limits = limits, .bases = bases, .block = into};
    for (const char *at = text->begin; at < text->end;) {
        at = mt_skip_blanks(at);
        if (!mt_is_line_end(*at) && *at != '#') {
            at = scan_statement(&parser, at);
            if (!at) {
                return;
            }
        }
        if (*at == '#') {
            at = mt_find_line_end(at);
        } else if (!mt_is_line_end(*at)) {
            char word[MT_TEXT_WORD];
            mt_text_word(at, word);
            mt_text_fail(text, MT_ERROR_SYNTAX, at, "expected the end of the line, found \"%s\"", word);
            return;
        }
        at = mt_skip_line_end(at, text->end);
    }
}
