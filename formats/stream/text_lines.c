/* Counting lines that say something, quickly where all do. */
#include "formats/stream/cursor.h"
#include "formats/stream/text.h"

#define STRIDE 128 /* bytes whose findings fit the eight bits of a lane */

/* Counts the line feeds among the bytes and whether any byte is a sign of a line that says nothing, or of another kind
 * of line end: a CR, or a blank or comment after a line feed. Looks at the byte after the last too. */
static uint64_t count_line_feeds(const char *at, const char *end, char comment, bool *strange)
{
    uint64_t count = 0;
    uint8_t odd = 0;
    while (at < end) {
        size_t size = end - at < STRIDE ? (size_t)(end - at) : STRIDE;
        uint8_t part = 0;
        for (size_t i = 0; i < size; i++) {
            uint8_t feed = at[i] == '\n', next = (uint8_t)at[i + 1];
            part = (uint8_t)(part + feed);
            odd |= (uint8_t)((at[i] == '\r') | (feed & ((next <= ' ') | (next == (uint8_t)comment))));
        }
        count += part;
        at += size;
    }
    *strange = odd != 0;
    return count;
}

uint64_t mt_text_count_telling_lines(const char *at, const char *end, char comment)
{
    bool strange;
    if (at < end && (uint8_t)*at > ' ' && *at != comment) {
        /* The last line needs no line feed. */
        uint64_t count = count_line_feeds(at, end - 1, comment, &strange) + 1;
        if (!strange && (end[-1] == '\n' || (uint8_t)end[-1] > ' ')) {
            return count;
        }
    }
    uint64_t count = 0;
    while (at < end) {
        at = mt_skip_blanks(at);
        count += at < end && !mt_is_line_end(*at) && (*at != comment || !comment);
        at = mt_skip_line_end(mt_find_line_end(at), end);
    }
    return count;
}
