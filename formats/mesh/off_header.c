/* The header of an OFF file: a word that says what vertices have, which may be absent or glued to what follows, and
 * the counts of vertices, faces and edges, of which the last may be missing. Comments and blank lines come anywhere. */
#include "formats/mesh/off_parts.h"

#include <meshtool/checked.h>

size_t mt_off_header_word(const char *begin, const char *end, mt_off_header *header, char *dimension)
{
    const char *at = begin;
    *dimension = 0;
    while (end - at >= 3 && memcmp(at, "OFF", 3) != 0) {
        if (memcmp(at, "ST", 2) == 0 && !header->uvs) {
            header->uvs = true;
            at += 2;
        } else if (*at == 'C' && !header->colors) {
            header->colors = true;
            at++;
        } else if (*at == 'N' && !header->normals) {
            header->normals = true;
            at++;
        } else if (*at == '4' || *at == 'n') {
            *dimension = *at++;
        } else {
            return 0;
        }
    }
    bool found = end - at >= 3 && (end - at == 3 || mt_is_space(at[3]) || mt_is_digit(at[3]) || at[3] == '#');
    return found ? (size_t)(at + 3 - begin) : 0;
}

typedef struct header_reader {
    mt_off_header *header;
    bool has_word, complete;
} header_reader;

static const char *fail_counts(mt_text_block *block, const char *at)
{
    char word[MT_TEXT_WORD];
    mt_text_word(at, word);
    if (mt_is_line_end(*at) || at >= block->end) {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "the line ends where the counts of vertices and faces were expected");
    } else if (*at == '-') {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "a count of %s, expected 0 or more", word);
    } else {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected the counts of vertices and faces, found \"%s\"", word);
    }
    return NULL;
}

/* Two counts or three; the third, of edges, is not used by anyone. */
static const char *scan_counts(mt_text_block *block, const char *at, mt_off_header *header)
{
    uint64_t counts[3] = {0};
    for (int i = 0; i < 3; i++) {
        const char *stop;
        at = mt_skip_blanks(at);
        if (i == 2 && (mt_is_line_end(*at) || *at == '#')) {
            break;
        }
        counts[i] = mt_scan_unsigned(at, &stop);
        if (stop == at || !mt_is_space(*stop)) {
            return fail_counts(block, at);
        }
        if (i < 2 && !mt_count_fits(counts[i])) {
            mt_text_fail(block, MT_ERROR_SYNTAX, at, "a count of %llu, more than an index can name",
                         (unsigned long long)counts[i]);
            return NULL;
        }
        at = stop;
    }
    header->vertex_count = counts[0];
    header->face_count = counts[1];
    at = mt_skip_blanks(at);
    return mt_is_line_end(*at) || *at == '#' ? at : fail_counts(block, at);
}

static const char *scan_word(mt_text_block *block, const char *at, header_reader *reader)
{
    char dimension;
    size_t size = mt_off_header_word(at, mt_skip_word(at), reader->header, &dimension);
    if (dimension && size > 0) {
        mt_text_fail(block, MT_ERROR_UNSUPPORTED, at,
                     "%cOFF (vertices of %s numbers) is not read, only three dimensions", dimension,
                     dimension == '4' ? "4" : "any");
        return NULL;
    }
    if (size == 0 && !mt_is_digit(*at) && *at != '-') {
        char word[MT_TEXT_WORD];
        mt_text_word(at, word);
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected OFF or the counts of vertices and faces, found \"%s\"",
                     word);
        return NULL;
    }
    return at + size;
}

static void scan_header(void *user, mt_text_block *block)
{
    header_reader *reader = user;
    for (const char *at = block->begin; !reader->complete;) {
        at = mt_off_next_line(at, block->end);
        if (at == block->end) {
            return;
        }
        if (!reader->has_word) {
            reader->has_word = true;
            at = scan_word(block, at, reader);
            at = at ? mt_skip_blanks(at) : NULL;
            if (!at) {
                return;
            }
            if (mt_is_line_end(*at) || *at == '#') {
                continue;
            }
        }
        at = scan_counts(block, at, reader->header);
        if (!at) {
            return;
        }
        at = mt_skip_line_end(mt_find_line_end(at), block->end);
        reader->header->end = block->offset + (uint64_t)(at - block->begin);
        reader->complete = true;
    }
}

mt_status mt_off_read_header(mt_context *context, mt_text *text, mt_off_header *out)
{
    header_reader reader = {.header = out};
    mt_status status = MT_OK;
    *out = (mt_off_header){0};
    for (uint64_t i = 0; status == MT_OK && !reader.complete && i < mt_text_block_count(text); i++) {
        status = mt_text_parse_some(context, text, "reading", i, i + 1, scan_header, &reader);
    }
    if (status == MT_OK && !reader.complete) {
        mt_place place = {.file = mt_text_name(text)};
        status = mt_fail_at(context, MT_ERROR_SYNTAX, place,
                            "the file ends before the counts of vertices and faces were read");
    }
    return status;
}
