#include "formats/mesh/stl_solids.h"

#include "formats/mesh/stl_facets.h"
#include "formats/stream/cursor.h"

#define BYTES_A_FACET 200u /* of usual text, to guess how many facets a block holds */

typedef struct part_parser {
    mt_context *context;
    mt_text_block *block;
    stl_part *part;
    float *normals;
    const char *at;
} part_parser;

static void skip_space(part_parser *p)
{
    while (p->at < p->block->end && mt_is_space(*p->at)) {
        p->at++;
    }
}

/* Whether the word at `at` is this one, in capitals or not. */
static bool is_word(const char *at, const char *word)
{
    while (*word && (*at | 0x20) == *word) {
        at++;
        word++;
    }
    return !*word && mt_is_space(*at);
}

bool mt_stl_may_begin(const char *line, const char *end)
{
    (void)end;
    line = mt_skip_blanks(line);
    return is_word(line, "facet") || is_word(line, "solid");
}

static bool fail_expected(part_parser *p, const char *expected)
{
    char word[MT_TEXT_WORD];
    if (p->at >= p->block->end) {
        mt_text_fail(p->block, MT_ERROR_SYNTAX, p->at, "the facet ends too early, expected \"%s\"", expected);
    } else {
        mt_text_word(p->at, word);
        mt_text_fail(p->block, MT_ERROR_SYNTAX, p->at, "expected \"%s\", found \"%s\"", expected, word);
    }
    return false;
}

static bool fail_memory(part_parser *p)
{
    mt_text_fail(p->block, MT_ERROR_OUT_OF_MEMORY, NULL, "memory for the facets is missing");
    return false;
}

static bool expect(part_parser *p, const char *word)
{
    skip_space(p);
    if (p->at >= p->block->end || !is_word(p->at, word)) {
        return fail_expected(p, word);
    }
    p->at += strlen(word);
    return true;
}

static bool read_numbers(part_parser *p, double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        const char *stop;
        skip_space(p);
        mt_number_result result = mt_scan_number(p->at, p->block->end, &numbers[i], &stop);
        if (result == MT_NUMBER_TOO_LARGE) {
            mt_text_fail(p->block, MT_ERROR_SYNTAX, p->at, "the number is too large for double precision");
            return false;
        }
        if (p->at >= p->block->end || result != MT_NUMBER_OK || !mt_is_space(*stop)) {
            mt_text_fail_number(p->block, p->at);
            return false;
        }
        p->at = stop;
    }
    return true;
}

/* Room for one more record in an array that is kept in a part. */
static bool make_room(mt_context *context, void **records, uint64_t count, uint64_t *room, size_t size, uint64_t least)
{
    if (count < *room) {
        return true;
    }
    uint64_t larger = count + count / 2 + least;
    void *grown = mt_try_allocate(context, larger * size);
    if (!grown) {
        return false;
    }
    if (count) {
        memcpy(grown, *records, count * size);
    }
    mt_free(context, *records);
    *records = grown;
    *room = larger;
    return true;
}

static bool read_facet(part_parser *p)
{
    stl_part *part = p->part;
    double normal[3], corners[9];
    bool read = expect(p, "facet") && expect(p, "normal") && read_numbers(p, normal, 3) && expect(p, "outer") &&
                expect(p, "loop");
    for (size_t i = 0; read && i < 3; i++) {
        read = expect(p, "vertex") && read_numbers(p, corners + 3 * i, 3);
    }
    if (!read || !expect(p, "endloop") || !expect(p, "endfacet")) {
        return false;
    }
    for (size_t i = 0; p->normals && i < 3; i++) {
        p->normals[3 * part->facet_count + i] = (float)normal[i];
    }
    if (!p->normals) {
        uint64_t expected = (uint64_t)(p->block->end - p->block->begin) / BYTES_A_FACET + 8;
        if (!make_room(p->context, (void **)&part->positions, part->facet_count, &part->facet_room, sizeof corners,
                       expected)) {
            return fail_memory(p);
        }
        memcpy(part->positions + 9 * part->facet_count, corners, sizeof corners);
        part->contradicting += mt_stl_normal_contradicts(normal, corners);
    }
    part->facet_count++;
    return true;
}

/* The rest of the line, without the blanks around it, is the solid's name. */
static bool begin_solid(part_parser *p)
{
    stl_part *part = p->part;
    p->at = mt_skip_blanks(p->at + strlen("solid"));
    const char *end = mt_find_line_end(p->at), *next = end;
    while (end > p->at && mt_is_blank(end[-1])) {
        end--;
    }
    size_t length = (size_t)(end - p->at);
    if (!make_room(p->context, (void **)&part->solids, part->solid_count, &part->solid_room, sizeof *part->solids, 1)) {
        return fail_memory(p);
    }
    char *name = mt_try_allocate(p->context, length + 1);
    if (!name) {
        return fail_memory(p);
    }
    memcpy(name, p->at, length);
    name[length] = 0;
    part->solids[part->solid_count++] = (stl_solid){name, part->facet_count};
    part->ends_inside = true;
    p->at = next;
    return true;
}

static bool read_inside(part_parser *p)
{
    if (is_word(p->at, "facet")) {
        return read_facet(p);
    }
    if (!is_word(p->at, "endsolid")) {
        return fail_expected(p, "facet\" or \"endsolid");
    }
    p->at = mt_find_line_end(p->at);
    p->part->ends_inside = false;
    return true;
}

static bool read_outside(part_parser *p)
{
    if (is_word(p->at, "solid")) {
        return begin_solid(p);
    }
    if (is_word(p->at, "facet") || (p->block->number == 0 && p->part->solid_count == 0)) {
        return fail_expected(p, "solid");
    }
    p->at = mt_find_line_end(p->at);
    p->part->junk_lines++;
    return true;
}

void mt_stl_parse_part(mt_context *context, mt_text_block *block, stl_part *part, float *normals)
{
    part_parser p = {context, block, part, normals, block->begin};
    part->offset = block->offset;
    skip_space(&p);
    part->is_read = p.at < block->end;
    part->begins_inside = block->number > 0 && part->is_read && is_word(p.at, "facet");
    part->ends_inside = part->begins_inside;
    bool read = true;
    while (read && p.at < block->end) {
        read = part->ends_inside ? read_inside(&p) : read_outside(&p);
        skip_space(&p);
    }
}

void mt_stl_release_part(mt_context *context, stl_part *part)
{
    for (uint64_t i = 0; i < part->solid_count; i++) {
        mt_free(context, part->solids[i].name);
    }
    mt_free(context, part->solids);
    mt_free(context, part->positions);
    *part = (stl_part){0};
}
