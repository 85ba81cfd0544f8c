#include "formats/stream/lines.h"

#include "formats/stream/output.h"

#include <math.h>
#include <string.h>

#define FIRST_CAPACITY ((size_t)1 << 16)
#define BLOCKS_PER_THREAD 4 /* formatted before they are written: evens out blocks of unequal cost */

char *mt_lines_grow(mt_lines *lines, size_t size)
{
    size_t needed = lines->size + size;
    size_t capacity = 2 * lines->capacity < FIRST_CAPACITY ? FIRST_CAPACITY : 2 * lines->capacity;
    capacity = capacity < needed ? needed : capacity;
    char *bytes = lines->failed ? NULL : mt_try_allocate(lines->context, capacity);
    if (!bytes) {
        lines->failed = true;
        return NULL;
    }
    if (lines->size > 0) {
        memcpy(bytes, lines->bytes, lines->size);
    }
    mt_free(lines->context, lines->bytes);
    lines->bytes = bytes;
    lines->capacity = capacity;
    return bytes + lines->size;
}

typedef struct wave {
    mt_lines *lines; /* one for each block of the wave */
    mt_lines_function format;
    void *user;
    uint64_t count, grain, first_block;
} wave;

static void format_blocks(void *user, uint64_t begin, uint64_t end)
{
    wave *w = user;
    for (uint64_t i = begin; i < end; i++) {
        uint64_t first = (w->first_block + i) * w->grain;
        uint64_t last = w->count - first < w->grain ? w->count : first + w->grain;
        w->lines[i].size = 0;
        w->format(w->user, &w->lines[i], first, last);
    }
}

static mt_status write_wave(mt_context *context, mt_output *output, const wave *w, uint64_t block_count)
{
    mt_status status = MT_OK;
    for (uint64_t i = 0; status == MT_OK && i < block_count; i++) {
        status = w->lines[i].failed ? mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "out of memory while writing")
                                    : mt_output_write(context, output, w->lines[i].bytes, w->lines[i].size);
    }
    return status;
}

mt_status mt_lines_write(mt_context *context, mt_output *output, uint64_t count, uint64_t grain,
                         mt_lines_function format, void *user)
{
    uint64_t block_count = count == 0 ? 0 : (count - 1) / grain + 1;
    uint64_t wave_size = BLOCKS_PER_THREAD * (uint64_t)mt_context_thread_count(context);
    wave_size = wave_size < block_count ? wave_size : block_count;
    wave w = {.format = format, .user = user, .count = count, .grain = grain};
    w.lines = mt_allocate_array_zeroed(context, wave_size, sizeof *w.lines);
    mt_status status = w.lines ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t i = 0; w.lines && i < wave_size; i++) {
        w.lines[i].context = context;
    }
    while (status == MT_OK && w.first_block < block_count) {
        uint64_t blocks = block_count - w.first_block < wave_size ? block_count - w.first_block : wave_size;
        mt_parallel_for(context, blocks, 1, format_blocks, &w);
        status = write_wave(context, output, &w, blocks);
        w.first_block += blocks;
        if (status == MT_OK && w.first_block < block_count) {
            status = mt_progress(context, "writing", (double)w.first_block / (double)block_count);
        }
    }
    for (uint64_t i = 0; w.lines && i < wave_size; i++) {
        mt_free(context, w.lines[i].bytes);
    }
    mt_free(context, w.lines);
    return status;
}

static const char digit_pairs[] = "0001020304050607080910111213141516171819"
                                  "2021222324252627282930313233343536373839"
                                  "4041424344454647484950515253545556575859"
                                  "6061626364656667686970717273747576777879"
                                  "8081828384858687888990919293949596979899";

char *mt_put_unsigned(char *at, uint64_t number)
{
    char digits[MT_PUT_UNSIGNED_ROOM];
    char *begin = digits + sizeof digits;
    while (number >= 100) {
        begin -= 2;
        memcpy(begin, digit_pairs + 2 * (number % 100), 2);
        number /= 100;
    }
    if (number >= 10) {
        begin -= 2;
        memcpy(begin, digit_pairs + 2 * number, 2);
    } else {
        *--begin = (char)('0' + number);
    }
    size_t size = (size_t)(digits + sizeof digits - begin);
    memcpy(at, begin, size);
    return at + size;
}

/* Eight digits with the zeros at their end left out. */
static char *put_places(char *at, uint32_t places)
{
    char digits[8];
    for (int i = 6; i >= 0; i -= 2) {
        memcpy(digits + i, digit_pairs + 2 * (places % 100), 2);
        places /= 100;
    }
    size_t size = 8;
    while (digits[size - 1] == '0') {
        size--;
    }
    memcpy(at, digits, size);
    return at + size;
}

/* A decimal of at most 15 digits reads back as a double that no other such decimal reads as: when the number is one
 * with eight places, its digits are the shortest, and the general printer is not needed. */
char *mt_put_number(char *at, double number)
{
    const double scale = 1e8, limit = 1e15;
    double magnitude = fabs(number), scaled = magnitude * scale;
    if (!(scaled < limit)) {
        return at + mt_number_print(number, at);
    }
    uint64_t digits = (uint64_t)(scaled + 0.5);
    if ((double)digits / scale != magnitude) {
        return at + mt_number_print(number, at);
    }
    if (signbit(number)) {
        *at++ = '-';
    }
    at = mt_put_unsigned(at, digits / 100000000u);
    if (digits % 100000000u != 0) {
        *at++ = '.';
        at = put_places(at, (uint32_t)(digits % 100000000u));
    }
    return at;
}
