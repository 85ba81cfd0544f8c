/* One line of the body of an OFF file: a vertex, or a face and perhaps its colour. */
#include "formats/mesh/off_lines.h"

mt_index mt_off_scan_sides(const char *at, const char **stop)
{
    uint64_t sides = mt_scan_unsigned(at, stop);
    if (*stop == at || !mt_is_space(**stop) || sides > MT_INDEX_MAX) {
        return 0;
    }
    if (sides <= 8) {
        return (mt_index)sides;
    }
    const char *end = mt_find_line_end(*stop);
    return 2 * sides <= (uint64_t)(end - *stop) ? (mt_index)sides : 0;
}

static bool is_whole(const char *begin, const char *end)
{
    for (; begin < end; begin++) {
        if (!mt_is_digit(*begin)) {
            return false;
        }
    }
    return true;
}

/* The numbers up to the end of the line, at most `most`; whole[i]: number i has digits alone. */
static const char *scan_rest(mt_text_block *block, const char *at, double *numbers, bool *whole, unsigned most,
                             unsigned *count)
{
    *count = 0;
    at = mt_skip_blanks(at);
    while (!mt_is_line_end(*at) && *at != '#') {
        if (*count == most) {
            char word[MT_TEXT_WORD];
            mt_text_word(at, word);
            mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected the end of the line, found \"%s\"", word);
            return NULL;
        }
        const char *begin = at;
        at = mt_text_number(block, at, &numbers[*count]);
        if (!at) {
            return NULL;
        }
        whole[*count] = is_whole(begin, at);
        ++*count;
        at = mt_skip_blanks(at);
    }
    return at;
}

/* Keeps a colour of 0 to 4 components. */
static bool keep_color(mt_off_reader *reader, mt_text_block *block, mt_off_colors *colors, const char *line,
                       uint64_t element, const double *components, const bool *whole, unsigned count)
{
    bool all_whole = true;
    for (unsigned i = 0; i < count; i++) {
        all_whole = all_whole && whole[i];
    }
    for (unsigned i = 0; i < count && all_whole; i++) {
        if (components[i] > 255.0) {
            mt_text_fail(block, MT_ERROR_SYNTAX, line, "a color of %.17g, expected 0 to 255", components[i]);
            return false;
        }
    }
    if (!mt_off_add_color(reader->context, colors, element, components, count, all_whole)) {
        mt_text_fail(block, MT_ERROR_OUT_OF_MEMORY, NULL, "out of memory while reading");
        return false;
    }
    return true;
}

/* The numbers of a vertex after its position. */
static const char *scan_vertex_rest(mt_off_reader *reader, mt_text_block *block, const char *line, const char *at,
                                    uint64_t vertex)
{
    const mt_off_header *header = &reader->header;
    unsigned normals = 3u * header->normals, uvs = 2u * header->uvs, least = normals + uvs, count;
    double numbers[9];
    bool whole[9];
    at = scan_rest(block, at, numbers, whole, least + 4u * header->colors, &count);
    if (!at) {
        return NULL;
    }
    if (count < least + header->colors) {
        mt_text_fail(block, MT_ERROR_SYNTAX, line, "a vertex with %u numbers, expected %u%s", 3 + count,
                     3 + least + header->colors, header->colors ? " or more" : "");
        return NULL;
    }
    unsigned colors = count - least;
    if (normals) {
        memcpy(reader->normals + 3 * vertex, numbers, 3 * sizeof *numbers);
    }
    if (uvs) {
        memcpy(reader->uvs + 2 * vertex, numbers + normals + colors, 2 * sizeof *numbers);
    }
    bool kept = !header->colors || keep_color(reader, block, &reader->blocks[block->number].vertex_colors, line, vertex,
                                              numbers + normals, whole + normals, colors);
    return kept ? at : NULL;
}

const char *mt_off_scan_vertex(mt_off_reader *reader, mt_text_block *block, const char *line, uint64_t vertex)
{
    double *position = (double *)reader->mesh->positions + 3 * vertex;
    const char *at = line;
    for (int i = 0; i < 3; i++) {
        at = mt_text_number(block, mt_skip_blanks(at), &position[i]);
        if (!at) {
            return NULL;
        }
    }
    at = mt_skip_blanks(at);
    bool plain = mt_is_line_end(*at) && !(reader->header.normals || reader->header.colors || reader->header.uvs);
    return plain ? at : scan_vertex_rest(reader, block, line, at, vertex);
}

static const char *fail_sides(mt_text_block *block, const char *at, mt_index sides)
{
    char word[MT_TEXT_WORD];
    mt_text_word(at, word);
    if (sides > 0) {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "a face of %lu corners, expected 3 or more", (unsigned long)sides);
    } else {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected the sides of a face, found \"%s\"", word);
    }
    return NULL;
}

static const char *fail_vertex(const mt_off_reader *reader, mt_text_block *block, const char *at)
{
    char word[MT_TEXT_WORD];
    mt_text_word(at, word);
    if (mt_is_line_end(*at) || *at == '#') {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "the line ends where a vertex of the face was expected");
    } else if (is_whole(at, mt_skip_word(at)) || *at == '-') {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "vertex %s does not exist: the file has %llu vertices, counted from 0",
                     word, (unsigned long long)reader->header.vertex_count);
    } else {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected the number of a vertex, found \"%s\"", word);
    }
    return NULL;
}

const char *mt_off_scan_face(mt_off_reader *reader, mt_text_block *block, const char *line, uint64_t face,
                             mt_index *corner)
{
    const char *at;
    mt_index sides = mt_off_scan_sides(line, &at), *corners = reader->mesh->corner_vertices + *corner;
    if (sides < 3) {
        return fail_sides(block, line, sides);
    }
    if (reader->sides && sides != reader->sides) {
        reader->blocks[block->number].differs = true;
        return fail_sides(block, line, sides);
    }
    for (mt_index side = 0; side < sides; side++) {
        const char *stop;
        at = mt_skip_blanks(at);
        uint64_t vertex = mt_scan_unsigned(at, &stop);
        if (stop == at || vertex >= reader->header.vertex_count || !mt_is_space(*stop)) {
            return fail_vertex(reader, block, at);
        }
        corners[side] = (mt_index)vertex;
        at = stop;
    }
    *corner += sides;
    if (reader->mesh->face_offsets) {
        reader->mesh->face_offsets[face + 1] = *corner;
    }
    mt_off_block *own = &reader->blocks[block->number];
    double color[4];
    bool whole[4];
    unsigned count = 0;
    at = mt_skip_blanks(at);
    if (!mt_is_line_end(*at)) {
        at = scan_rest(block, at, color, whole, 4, &count);
    }
    /* Most files have no colours: nothing is kept until a face has one. */
    bool kept = at && ((count == 0 && own->face_colors.count == 0) ||
                       keep_color(reader, block, &own->face_colors, line, face, color, whole, count));
    return kept ? at : NULL;
}
