/* What stands at a place of a text, in the words of a message. */
#include "formats/stream/cursor.h"
#include "formats/stream/text.h"

void mt_text_word(const char *at, char *word)
{
    size_t size = 0;
    for (; !mt_is_space(*at) && *at != '\0' && size < MT_TEXT_WORD - 4; at++) {
        word[size++] = *at > ' ' && *at < 127 ? *at : '?';
    }
    if (!mt_is_space(*at) && *at != '\0') {
        memcpy(word + size, "...", 3);
        size += 3;
    }
    word[size] = '\0';
}

const char *mt_text_fail_number(mt_text_block *block, const char *at)
{
    char word[MT_TEXT_WORD];
    const char *stop;
    double number;
    mt_text_word(at, word);
    mt_number_result result = mt_number_parse(at, block->end, &number, &stop);
    if (at >= block->end || mt_is_line_end(*at)) {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "the line ends where a number was expected");
    } else if (result == MT_NUMBER_TOO_LARGE) {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "%s is past the largest double", word);
    } else if (result == MT_NUMBER_OK && *stop == ',') {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected a number, found \"%s\": a decimal comma is not read", word);
    } else {
        mt_text_fail(block, MT_ERROR_SYNTAX, at, "expected a number, found \"%s\"", word);
    }
    return NULL;
}
