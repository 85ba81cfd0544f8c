/* The statements of one block of an OBJ file. */
#ifndef MESHTOOL_OBJ_PARSER_H
#define MESHTOOL_OBJ_PARSER_H

#include "formats/mesh/obj_store.h"
#include "formats/stream/cursor.h"
#include "formats/stream/text.h"

/* What is known of the numbers that references may have. While the file is first read, nothing: every limit is
 * MT_INDEX_MAX and every base so high that no relative reference passes the start. When a reference turned out to be
 * wrong the file is read again with the right numbers, so that the message names its line. */
typedef struct mt_obj_limits {
    uint64_t counts[MT_OBJ_ELEMENT_COUNT];
} mt_obj_limits;

/* Elements of each kind in the blocks before. */
typedef struct mt_obj_bases {
    uint64_t counts[MT_OBJ_ELEMENT_COUNT];
} mt_obj_bases;

/* Parses the text into `into`, which was begun in a store. A failure is recorded in the text's block. */
void mt_obj_parse(mt_context *context, mt_text_block *text, const mt_obj_limits *limits, const mt_obj_bases *bases,
                  mt_obj_block *into);

/* What the files of the parser share. Each scanner returns the byte after what it read, NULL after a failure. */
typedef struct mt_obj_parser {
    mt_context *context;
    mt_text_block *text;
    const mt_obj_limits *limits;
    const mt_obj_bases *bases;
    mt_obj_block *block;
} mt_obj_parser;

/* Room for `more` items, or the failure recorded. */
static inline bool mt_obj_parser_reserve(mt_obj_parser *parser, mt_obj_series series, size_t more)
{
    if (mt_obj_reserve(parser->context, parser->block, series, more)) {
        return true;
    }
    mt_text_fail(parser->text, MT_ERROR_OUT_OF_MEMORY, NULL, "out of memory while reading");
    return false;
}

/* The slow half of the scanners below. */
const char *mt_obj_skip_continuations(mt_obj_parser *parser, const char *at);
const char *mt_obj_reference_checked(mt_obj_parser *parser, const char *at, mt_obj_element element, mt_index *index,
                                     bool *relative);

static inline bool mt_obj_is_continuation(const char *at)
{
    return *at == '\\' && mt_is_line_end(at[1]);
}

/* Blanks, and continuations: a backslash at the end of a line. */
static inline const char *mt_obj_skip(mt_obj_parser *parser, const char *at)
{
    at = mt_skip_blanks(at);
    return *at == '\\' ? mt_obj_skip_continuations(parser, at) : at;
}

/* Whether the statement ends here: at the line's end or a comment. */
static inline bool mt_obj_at_end(const char *at)
{
    return mt_is_line_end(*at) || *at == '#';
}

/* A number, with what may follow one checked. */
static inline const char *mt_obj_number(mt_obj_parser *parser, const char *at, double *number)
{
    const char *stop;
    if (mt_scan_number(at, parser->text->end, number, &stop) == MT_NUMBER_OK &&
        (mt_is_space(*stop) || mt_obj_is_continuation(stop))) {
        return stop;
    }
    return mt_text_fail_number(parser->text, at);
}

/* A reference: from 1, or relative. Relative ones are stored less the running count of the blocks before. */
static inline const char *mt_obj_reference(mt_obj_parser *parser, const char *at, mt_obj_element element,
                                           mt_index *index, bool *relative)
{
    const char *stop;
    uint64_t number = mt_scan_unsigned(at, &stop);
    if (number - 1 < parser->limits->counts[element]) {
        *index = (mt_index)(number - 1);
        return stop;
    }
    return mt_obj_reference_checked(parser, at, element, index, relative);
}

/* Statements other than v, vt, vn and f. at is the keyword's first byte. */
const char *mt_obj_rare_statement(mt_obj_parser *parser, const char *at);
/* Records something that happens before the next face; the name is [begin, end). */
bool mt_obj_add_event(mt_obj_parser *parser, int kind, const char *at, const char *begin, const char *end);
/* The same, but once a block for each name: that of the word at `at`. */
bool mt_obj_add_unknown(mt_obj_parser *parser, int kind, const char *at);
/* A tag; line is the statement's first byte, at the one after its keyword. */
const char *mt_obj_scan_tag(mt_obj_parser *parser, const char *line, const char *at);

#endif
