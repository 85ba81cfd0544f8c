/* Text read in blocks of whole lines, parsed in parallel, the same for any number of threads.
 *
 * A line ends at LF, CR or CR LF. Blocks are fixed by the text alone: block n holds the lines that begin in bytes
 * [n * size, (n + 1) * size). Lines are not counted while all goes well: a failure or a warning keeps its byte, and
 * its line is counted then. */
#ifndef MESHTOOL_STREAM_TEXT_H
#define MESHTOOL_STREAM_TEXT_H

#include "formats/stream/cursor.h"

#include <meshtool/mesh_format.h>

#define MT_TEXT_PADDING 64 /* zero bytes that may be read after a block's final line end */

typedef struct mt_text mt_text;

typedef struct mt_text_block {
    const char *begin, *end; /* whole lines; *end is a line end of its own, so that a scan needs no bound */
    uint64_t offset;         /* of begin in the input */
    uint64_t number;         /* of the block, from 0 */
    uint64_t first_line;     /* lines before it since the opening; known after mt_text_count_lines, else 0 */
    unsigned slot;           /* below mt_text_slot_count: no two blocks at work at the same time share one */
    struct mt_text_failure *failure;
} mt_text_block;

typedef struct mt_text_options {
    bool continuations;    /* a backslash at the end of a line keeps the next one in the same block */
    uint64_t lines_before; /* lines that were consumed before, for messages */
    size_t block_size;     /* 0: 512 KB to 1 MB, by the file's size and the threads; the smallest is 16 */
    /* Whether a block may begin with this line (bytes up to its line end); NULL: with any. The first block begins
     * where the text does. */
    bool (*may_begin)(const char *line, const char *end);
} mt_text_options;

/* Opens the text from the input's offset to its end; the input is then read by nobody else. A stream is collected
 * first. A UTF-8 mark at the beginning is skipped; UTF-16 is MT_ERROR_UNSUPPORTED. options may be NULL. */
mt_status mt_text_open(mt_context *context, mt_input *input, const mt_text_options *options, mt_text **out);
void mt_text_close(mt_context *context, mt_text *text); /* NULL is allowed */

/* The input's name, for warnings. */
const char *mt_text_name(const mt_text *text);
uint64_t mt_text_block_count(const mt_text *text);
unsigned mt_text_slot_count(const mt_text *text);
/* Bytes from the opening to the end. */
uint64_t mt_text_size(const mt_text *text);

/* Counts the lines of every block, so that parsing knows block.first_line. *total (may be NULL) receives their number.
 */
mt_status mt_text_count_lines(mt_context *context, mt_text *text, uint64_t *total);

/* Calls parse for every block, in parallel and in any order. It may use mt_try_allocate and mt_free, and
 * mt_text_fail. Reports the failure that comes first in the file, a NUL byte among them; after a failure later
 * blocks may go unparsed, earlier ones never. May be called again. */
typedef void (*mt_text_parse_function)(void *user, mt_text_block *block);
mt_status mt_text_parse(mt_context *context, mt_text *text, const char *task, mt_text_parse_function parse, void *user);
/* The same for blocks [begin, end) alone. */
mt_status mt_text_parse_some(mt_context *context, mt_text *text, const char *task, uint64_t begin, uint64_t end,
                             mt_text_parse_function parse, void *user);

/* How many lines of a block say something, from `at` on: they are not blank, and do not begin with the comment
 * character (0: there is none). */
uint64_t mt_text_count_telling_lines(const char *at, const char *end, char comment);

/* Inside parse: records a failure at a byte of the block (NULL: without a place). The first in the block wins; the
 * parser should return after it. */
void mt_text_fail(mt_text_block *block, mt_status status, const char *at, const char *format, ...) MT_PRINTF(4, 5);
/* Records that no number stands at `at`, with what stands there; NULL. */
const char *mt_text_fail_number(mt_text_block *block, const char *at);
/* The word at `at`, cut short and without unprintable bytes, for messages; `word` has room for MT_TEXT_WORD bytes. */
#define MT_TEXT_WORD 40
void mt_text_word(const char *at, char *word);
/* The number that is the word at `at`; returns the byte after it, or NULL with the failure recorded. */
static inline const char *mt_text_number(mt_text_block *block, const char *at, double *number)
{
    const char *stop;
    bool right = mt_scan_number(at, block->end, number, &stop) == MT_NUMBER_OK && mt_is_space(*stop);
    return right ? stop : mt_text_fail_number(block, at);
}
bool mt_text_failed(const mt_text_block *block);

/* The line and column of a byte of the input, for messages. Reads the text up to there again. */
mt_place mt_text_place(mt_context *context, mt_text *text, uint64_t offset);

#endif
