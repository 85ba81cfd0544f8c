#include "formats/stream/text_slot.h"

#include "formats/stream/cursor.h"
#include "formats/stream/input.h"

/* A block's text and numbers fit the cache in small ones; large ones cost fewer page faults, as what is kept of each is
 * large enough for huge pages. So they are large where every thread still has several, and buffers are a small share of
 * the file. Nothing that is read depends on it. */
#define SMALLEST_BLOCK ((uint64_t)512 << 10)
#define LARGEST_BLOCK ((uint64_t)1 << 20)
#define BLOCKS_A_THREAD 8

#define WAVE 64 /* blocks between two reports of progress */

const char *mt_text_name(const mt_text *text)
{
    return mt_input_name(text->input);
}

uint64_t mt_text_block_count(const mt_text *text)
{
    return text->block_count;
}

unsigned mt_text_slot_count(const mt_text *text)
{
    return text->slot_count;
}

uint64_t mt_text_size(const mt_text *text)
{
    return text->end - text->begin;
}

void mt_text_close(mt_context *context, mt_text *text)
{
    if (!text) {
        return;
    }
    for (unsigned i = 0; text->slots && i < text->slot_count; i++) {
        mt_free(context, text->slots[i].buffer);
    }
    mt_free(context, text->slots);
    mt_free(context, text->first_lines);
    mt_free(context, text);
}

/* Skips a UTF-8 mark; refuses UTF-16. */
static mt_status skip_mark(mt_context *context, mt_text *text)
{
    uint8_t mark[3] = {0};
    size_t got = mt_input_read_at(text->input, text->begin, mark, sizeof mark);
    if (got == SIZE_MAX) {
        return mt_input_fail_read_at(context, text->input, text->begin);
    }
    if (got >= 2 && ((mark[0] == 0xFF && mark[1] == 0xFE) || (mark[0] == 0xFE && mark[1] == 0xFF))) {
        return mt_fail_at(context, MT_ERROR_UNSUPPORTED, mt_input_place_offset(text->input, text->begin),
                          "is text in UTF-16; convert it to UTF-8 first (iconv -f utf-16 -t utf-8)");
    }
    text->begin += got == 3 && mark[0] == 0xEF && mark[1] == 0xBB && mark[2] == 0xBF ? 3 : 0;
    return MT_OK;
}

static size_t choose_block_size(uint64_t size, uint64_t threads)
{
    uint64_t block = size / (BLOCKS_A_THREAD * threads);
    block = block < LARGEST_BLOCK ? block : LARGEST_BLOCK;
    return (size_t)(block > SMALLEST_BLOCK ? block : SMALLEST_BLOCK);
}

static mt_status create_slots(mt_context *context, mt_text *text)
{
    uint64_t size = text->end - text->begin, threads = mt_context_thread_count(context);
    text->block_size = text->options.block_size ? text->options.block_size : choose_block_size(size, threads);
    text->block_count = size == 0 ? 0 : (size - 1) / text->block_size + 1;
    text->slot_count = (unsigned)(text->block_count < threads ? text->block_count : threads);
    text->slot_count += text->slot_count == 0;
    text->slots = mt_allocate_array_zeroed(context, text->slot_count, sizeof *text->slots);
    if (!text->slots) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    size_t block = size < text->block_size ? (size_t)size : text->block_size;
    for (unsigned i = 0; i < text->slot_count; i++) {
        text->slots[i].capacity = block + MT_TEXT_LOOK_BACK + MT_TEXT_SLACK + MT_TEXT_PADDING + 1;
        text->slots[i].buffer = mt_allocate(context, text->slots[i].capacity);
        if (!text->slots[i].buffer) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
    }
    return MT_OK;
}

mt_status mt_text_open(mt_context *context, mt_input *input, const mt_text_options *options, mt_text **out)
{
    *out = NULL;
    mt_text *text = mt_allocate_zeroed(context, sizeof *text);
    if (!text) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    text->context = context;
    text->input = input;
    if (options) {
        text->options = *options;
    }
    mt_status status = mt_input_collect(context, input);
    if (status == MT_OK) {
        text->begin = mt_input_offset(input);
        text->end = mt_input_size(input);
        status = skip_mark(context, text);
    }
    if (status == MT_OK) {
        status = create_slots(context, text);
    }
    if (status != MT_OK) {
        mt_text_close(context, text);
        text = NULL;
    }
    *out = text;
    return status;
}

/* Lines that end in the bytes; one that is cut short by the end counts too. */
static uint64_t count_lines(const char *begin, const char *end)
{
    uint64_t count = 0;
    for (const char *at = begin; at < end;) {
        const char *stop = end - at > 1 << 16 ? at + (1 << 16) : end;
        uint32_t part = 0;
        for (; at < stop; at++) {
            part += (uint32_t)(*at == '\n') + (uint32_t)(*at == '\r' && !(at + 1 < end && at[1] == '\n'));
        }
        count += part;
    }
    return count + (end > begin && !mt_is_line_end(end[-1]));
}

static void keep_first_failure(mt_text *text, mt_text_slot *slot, const mt_text_failure *failure)
{
    if (slot->failure.status == MT_OK || failure->block < slot->failure.block) {
        slot->failure = *failure;
    }
    uint_fast64_t first = atomic_load(&text->failed_block);
    while (failure->block < first && !atomic_compare_exchange_weak(&text->failed_block, &first, failure->block)) {
    }
}

/* A NUL byte is an error of its own: the lines before it are parsed, so that an earlier mistake wins. */
static void parse_block(mt_text *text, mt_text_slot *slot, mt_text_block *block)
{
    size_t size = (size_t)(block->end - block->begin);
    char *begin = slot->buffer + (block->begin - slot->buffer);
    char *nul = memchr(begin, 0, size);
    if (nul) {
        char *line = nul;
        while (line > begin && !mt_is_line_end(line[-1])) {
            line--;
        }
        *line = '\n';
        block->end = line;
    }
    if (block->begin < block->end) {
        text->parse(text->user, block);
    }
    if (nul) {
        mt_text_fail(block, MT_ERROR_SYNTAX, nul, "a NUL byte in text");
    }
}

static void run_block(mt_text *text, mt_text_slot *slot, uint64_t number)
{
    mt_text_failure failure = {.status = MT_OK};
    mt_text_block block = {.number = number, .slot = (unsigned)(slot - text->slots), .failure = &failure};
    if (mt_text_slot_load(text, slot, &block) && block.begin < block.end) {
        block.first_line = text->first_lines ? text->first_lines[number] : 0;
        parse_block(text, slot, &block);
    }
    if (failure.status != MT_OK) {
        keep_first_failure(text, slot, &failure);
    }
}

static void run_blocks(void *user, uint64_t begin, uint64_t end)
{
    mt_text *text = user;
    mt_text_slot *slot = text->slots;
    /* There are as many slots as threads, so one is always free. */
    while (atomic_exchange(&slot->busy, true)) {
        slot = slot + 1 == text->slots + text->slot_count ? text->slots : slot + 1;
    }
    for (uint64_t number = text->wave_begin + begin; number < text->wave_begin + end; number++) {
        if (number < atomic_load(&text->failed_block)) {
            run_block(text, slot, number);
        }
    }
    atomic_store(&slot->busy, false);
}

static mt_status report_failure(mt_context *context, mt_text *text)
{
    const mt_text_failure *first = NULL;
    for (unsigned i = 0; i < text->slot_count; i++) {
        const mt_text_failure *failure = &text->slots[i].failure;
        if (failure->status != MT_OK && (!first || failure->block < first->block)) {
            first = failure;
        }
    }
    if (!first) {
        return MT_OK;
    }
    if (first->reading) {
        return mt_input_fail_read_at(context, text->input, first->offset);
    }
    mt_place place = {.file = mt_input_name(text->input)};
    if (first->offset != UINT64_MAX) {
        place = mt_text_place(context, text, first->offset);
    }
    return mt_fail_at(context, first->status, place, "%s", first->message);
}

mt_status mt_text_parse_some(mt_context *context, mt_text *text, const char *task, uint64_t begin, uint64_t end,
                             mt_text_parse_function parse, void *user)
{
    mt_status status = MT_OK;
    text->parse = parse;
    text->user = user;
    atomic_store(&text->failed_block, UINT64_MAX);
    for (unsigned i = 0; i < text->slot_count; i++) {
        text->slots[i].failure.status = MT_OK;
    }
    for (uint64_t at = begin; status == MT_OK && at < end; at += WAVE) {
        uint64_t count = end - at < WAVE ? end - at : WAVE;
        text->wave_begin = at;
        mt_parallel_for(context, count, 1, run_blocks, text);
        status = report_failure(context, text);
        if (status == MT_OK && at + count < end) {
            status = mt_progress(context, task, (double)(at + count) / (double)text->block_count);
        }
    }
    return status;
}

mt_status mt_text_parse(mt_context *context, mt_text *text, const char *task, mt_text_parse_function parse, void *user)
{
    return mt_text_parse_some(context, text, task, 0, text->block_count, parse, user);
}

static void count_block(void *user, mt_text_block *block)
{
    uint64_t *counts = user;
    counts[block->number] = count_lines(block->begin, block->end);
}

mt_status mt_text_count_lines(mt_context *context, mt_text *text, uint64_t *total)
{
    uint64_t *counts = mt_allocate_array_zeroed(context, text->block_count, sizeof *counts);
    if (!counts) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_status status = mt_text_parse(context, text, "counting lines", count_block, counts);
    uint64_t sum = 0;
    for (uint64_t i = 0; i < text->block_count; i++) {
        uint64_t count = counts[i];
        counts[i] = sum;
        sum += count;
    }
    if (total) {
        *total = sum;
    }
    mt_free(context, text->first_lines);
    text->first_lines = counts;
    return status;
}

mt_place mt_text_place(mt_context *context, mt_text *text, uint64_t offset)
{
    (void)context;
    mt_place place = {.file = mt_input_name(text->input)};
    mt_text_slot *slot = &text->slots[0];
    uint64_t line = text->options.lines_before + 1, line_begin = text->begin;
    char before = 0;
    for (uint64_t at = text->begin; at <= offset;) {
        size_t size = offset + 1 - at < slot->capacity ? (size_t)(offset + 1 - at) : slot->capacity;
        size_t got = mt_input_read_at(text->input, at, slot->buffer, size);
        if (got == SIZE_MAX) {
            return place;
        }
        memset(slot->buffer + got, 0, size - got); /* at the very end of the text */
        for (size_t i = 0; i < size; i++) {
            char c = slot->buffer[i];
            if (before == '\n' || (before == '\r' && c != '\n')) {
                line++;
                line_begin = at + i;
            }
            before = c;
        }
        at += size;
    }
    place.line = line;
    place.column = offset - line_begin + 1;
    return place;
}
