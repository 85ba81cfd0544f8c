/* Text to write: formatted in parallel, block by block, and written in order. The same bytes for any number of threads.
 */
#ifndef MESHTOOL_STREAM_LINES_H
#define MESHTOOL_STREAM_LINES_H

#include "formats/stream/number.h"

#include <meshtool/mesh_format.h>

/* A buffer that grows; of one block at work. */
typedef struct mt_lines {
    mt_context *context;
    char *bytes;
    size_t size, capacity;
    bool failed; /* memory was missing; what is put then goes nowhere */
} mt_lines;

/* Room for `size` bytes more, or NULL. The caller writes there and adds to lines->size what it wrote. */
char *mt_lines_grow(mt_lines *lines, size_t size);
static inline char *mt_lines_reserve(mt_lines *lines, size_t size)
{
    return lines->capacity - lines->size >= size ? lines->bytes + lines->size : mt_lines_grow(lines, size);
}

/* Formats elements [0, count) in blocks of `grain` by calling format, and writes them. */
typedef void (*mt_lines_function)(void *user, mt_lines *lines, uint64_t begin, uint64_t end);
mt_status mt_lines_write(mt_context *context, mt_output *output, uint64_t count, uint64_t grain,
                         mt_lines_function format, void *user);

/* Each puts its text at `at` and returns the byte after it. */
#define MT_PUT_UNSIGNED_ROOM 20
char *mt_put_unsigned(char *at, uint64_t number);
/* Shortest digits that read back as the same double; MT_NUMBER_ROOM bytes of room. */
char *mt_put_number(char *at, double number);
static inline char *mt_put_float(char *at, float number)
{
    return at + mt_number_print_float(number, at);
}

#endif
