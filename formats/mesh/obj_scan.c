/* The slow half of scanning: continuations, relative references, and what is wrong with a reference. */
#include "formats/mesh/obj_parser.h"

/* A relative reference reaches back at most so far, which 32 bits hold with their sign. */
#define RELATIVE_MAX ((uint64_t)INT32_MAX)

const char *mt_obj_skip_continuations(mt_obj_parser *parser, const char *at)
{
    at = mt_skip_blanks(at);
    while (mt_obj_is_continuation(at)) {
        const char *next = mt_skip_line_end(at + 1, parser->text->end);
        if (next >= parser->text->end) {
            mt_text_fail(parser->text, MT_ERROR_SYNTAX, at,
                         "the file ends after a backslash, expected the line to go on");
            return NULL;
        }
        at = mt_skip_blanks(next);
    }
    return at;
}

static const char *fail_reference(mt_obj_parser *parser, const char *at, mt_obj_element element)
{
    static const char *const names[] = {"vertex", "texture vertex", "normal"};
    static const char *const plurals[] = {"vertices", "texture vertices", "normals"};
    const char *name = names[element];
    char word[MT_TEXT_WORD];
    const char *stop;
    mt_text_word(at, word);
    bool negative = *at == '-';
    uint64_t number = mt_scan_unsigned(at + negative, &stop);
    uint64_t count = parser->limits->counts[element];
    if (stop == at + negative) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "expected the number of a %s, found \"%s\"", name, word);
    } else if (number == 0) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "%s 0 does not exist: OBJ counts from 1", name);
    } else if (number > MT_INDEX_MAX || (negative && number > RELATIVE_MAX)) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "the number of a %s is too large: \"%s\"", name, word);
    } else if (negative) {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "%s -%llu lies before the first one of the file", name,
                     (unsigned long long)number);
    } else {
        mt_text_fail(parser->text, MT_ERROR_SYNTAX, at, "%s %llu does not exist: the file has %llu %s", name,
                     (unsigned long long)number, (unsigned long long)count, plurals[element]);
    }
    return NULL;
}

static size_t count_so_far(const mt_obj_block *block, mt_obj_element element)
{
    static const mt_obj_series series[] = {MT_OBJ_POSITIONS, MT_OBJ_UVS, MT_OBJ_NORMALS};
    return block->counts[series[element]];
}

const char *mt_obj_reference_checked(mt_obj_parser *parser, const char *at, mt_obj_element element, mt_index *index,
                                     bool *relative)
{
    const char *stop;
    bool negative = *at == '-';
    uint64_t number = mt_scan_unsigned(at + negative, &stop);
    *relative = negative;
    if (!negative) {
        /* 0 wraps around and is past every limit. */
        *index = (mt_index)(number - 1);
        return number - 1 < parser->limits->counts[element] ? stop : fail_reference(parser, at, element);
    }
    uint64_t before = count_so_far(parser->block, element);
    *index = (mt_index)(before - number);
    bool right = number - 1 < RELATIVE_MAX && number <= parser->bases->counts[element] + before;
    return right ? stop : fail_reference(parser, at, element);
}
