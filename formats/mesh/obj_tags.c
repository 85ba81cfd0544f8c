/* Tags: what OBJ files say of subdivision, `t NAME WHOLE/REAL/WORDS ...`, where the three counts tell what follows. */
#include "formats/mesh/obj_merge.h"

#define TAG_ROOM 4096 /* numbers of one tag */

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

/* Numbers of faces from 0; whether they exist is known when all are counted. */
static const char *scan_holes(mt_obj_parser *parser, const char *line, const char *at, const uint64_t counts[3])
{
    if (counts[0] == 0 || counts[1] != 0 || counts[2] != 0) {
        return fail_tag(parser, line, "hole N/0/0 and the numbers of the faces");
    }
    if (!mt_obj_parser_reserve(parser, MT_OBJ_HOLES, counts[0])) {
        return NULL;
    }
    for (uint64_t i = 0; i < counts[0]; i++) {
        const char *stop = NULL;
        at = mt_obj_skip(parser, at);
        uint64_t face = at ? mt_scan_unsigned(at, &stop) : 0;
        if (!at || stop == at || !mt_is_space(*stop)) {
            return at ? fail_tag(parser, at, "the number of a face") : NULL;
        }
        uint64_t offset = parser->text->offset + (uint64_t)(at - parser->text->begin);
        ((mt_obj_hole *)parser->block->items[MT_OBJ_HOLES])[parser->block->counts[MT_OBJ_HOLES]++] =
            (mt_obj_hole){face, offset};
        at = stop;
    }
    return mt_obj_skip(parser, at);
}

/* A setting has one number, or one word. */
static const char *scan_setting(mt_obj_parser *parser, const char *line, const char *at, const uint64_t counts[3],
                                mt_subdivision_tag tag)
{
    bool words = mt_subdivision_tag_word(tag, 0) != NULL;
    uint64_t value = mt_subdivision_tag_limit(tag);
    if (counts[0] != !words || counts[1] != 0 || counts[2] != words) {
        return fail_tag(parser, line, words ? "0/0/1 and a word" : "1/0/0 and a number");
    }
    at = mt_obj_skip(parser, at);
    if (!at) {
        return NULL;
    }
    const char *stop = mt_skip_word(at);
    for (unsigned i = 0; words && i < mt_subdivision_tag_limit(tag); i++) {
        const char *word = mt_subdivision_tag_word(tag, i);
        value = strlen(word) == (size_t)(stop - at) && memcmp(word, at, strlen(word)) == 0 ? i : value;
    }
    if (!words) {
        value = mt_scan_unsigned(at, &stop);
    }
    if (value >= mt_subdivision_tag_limit(tag) || stop == at || !mt_is_space(*stop)) {
        static const char *const expected[] = {"0, 1 or 2", "a number from 0 to 5", "normal or chaikin",
                                               "catmark or smooth"};
        return fail_tag(parser, at, expected[tag]);
    }
    if (!mt_obj_parser_reserve(parser, MT_OBJ_SETTINGS, 1)) {
        return NULL;
    }
    ((mt_obj_setting *)parser->block->items[MT_OBJ_SETTINGS])[parser->block->counts[MT_OBJ_SETTINGS]++] =
        (mt_obj_setting){tag, (uint8_t)value};
    return mt_obj_skip(parser, stop);
}

static bool is_word(const char *begin, const char *end, const char *word)
{
    return (size_t)(end - begin) == strlen(word) && memcmp(begin, word, strlen(word)) == 0;
}

/* The setting of that name, MT_TAG_COUNT: none. */
static mt_subdivision_tag find_setting(const char *begin, const char *end)
{
    mt_subdivision_tag tag = 0;
    while (tag < MT_TAG_COUNT && !is_word(begin, end, mt_subdivision_tag_name(tag))) {
        tag++;
    }
    return tag;
}

const char *mt_obj_scan_tag(mt_obj_parser *parser, const char *line, const char *at)
{
    uint64_t counts[3];
    at = mt_obj_skip(parser, at);
    if (!at) {
        return NULL;
    }
    const char *name = at, *end = mt_skip_word(at);
    bool crease = is_word(name, end, "crease"), corner = is_word(name, end, "corner");
    bool hole = is_word(name, end, MT_HOLE_NAME);
    mt_subdivision_tag setting = find_setting(name, end);
    if (!crease && !corner && !hole && setting == MT_TAG_COUNT) {
        return mt_obj_add_unknown(parser, MT_OBJ_UNKNOWN_TAG, name) ? mt_find_line_end(end) : NULL;
    }
    at = mt_obj_skip(parser, end);
    at = at ? scan_tag_counts(parser, at, counts) : NULL;
    if (!at) {
        return NULL;
    }
    if (setting != MT_TAG_COUNT) {
        return scan_setting(parser, line, at, counts, setting);
    }
    return hole ? scan_holes(parser, line, at, counts) : scan_sharpness(parser, line, at, counts, crease);
}

/* A hole past the last face is told with its line. */
static mt_status merge_holes(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_hole *holes = reader->blocks[i].items[MT_OBJ_HOLES];
        for (size_t k = 0; k < reader->blocks[i].counts[MT_OBJ_HOLES]; k++) {
            mt_attribute *attribute = NULL;
            if (holes[k].face >= mesh->face_count) {
                return mt_fail_at(context, MT_ERROR_SYNTAX, mt_text_place(context, reader->text, holes[k].offset),
                                  "face %llu of a tag does not exist: tags count from 0 and the file has %u faces",
                                  (unsigned long long)holes[k].face, mesh->face_count);
            }
            mt_status status = mt_mesh_add_holes(context, mesh, &attribute);
            if (status != MT_OK) {
                return status;
            }
            ((uint8_t *)attribute->values)[holes[k].face] = 1;
        }
    }
    return MT_OK;
}

mt_status mt_obj_merge_tags(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_status status = merge_holes(context, reader, mesh);
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_setting *settings = reader->blocks[i].items[MT_OBJ_SETTINGS];
        for (size_t k = 0; status == MT_OK && k < reader->blocks[i].counts[MT_OBJ_SETTINGS]; k++) {
            status = mt_subdivision_tag_set(context, mesh, settings[k].tag, settings[k].value);
        }
    }
    return status;
}
