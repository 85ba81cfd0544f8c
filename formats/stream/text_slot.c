#include "formats/stream/text_slot.h"

#include "formats/stream/cursor.h"
#include "formats/stream/input.h"

#include <stdarg.h>
#include <stdio.h>

static void keep_failure(mt_text_block *block, mt_status status, uint64_t offset, const char *format, va_list arguments)
{
    mt_text_failure *failure = block->failure;
    if (failure->status == MT_OK) {
        failure->status = status;
        failure->offset = offset;
        failure->block = block->number;
        vsnprintf(failure->message, sizeof failure->message, format, arguments);
    }
}

void mt_text_fail(mt_text_block *block, mt_status status, const char *at, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    keep_failure(block, status, at ? block->offset + (uint64_t)(at - block->begin) : UINT64_MAX, format, arguments);
    va_end(arguments);
}

bool mt_text_failed(const mt_text_block *block)
{
    return block->failure->status != MT_OK;
}

/* Makes bytes up to `upto` (clipped to the text's end) present in the slot. */
static bool load_upto(mt_text *text, mt_text_slot *slot, uint64_t upto, mt_text_block *block)
{
    upto = upto < text->end ? upto : text->end;
    if (slot->base + slot->size >= upto) {
        return true;
    }
    size_t size = (size_t)(upto - slot->base);
    if (size + MT_TEXT_PADDING + 1 > slot->capacity) {
        size_t capacity = 2 * (size + MT_TEXT_PADDING + 1);
        char *buffer = mt_try_allocate(text->context, capacity);
        if (!buffer) {
            mt_text_fail(block, MT_ERROR_OUT_OF_MEMORY, NULL, "out of memory for a line of %zu bytes", size);
            return false;
        }
        memcpy(buffer, slot->buffer, slot->size);
        mt_free(text->context, slot->buffer);
        slot->buffer = buffer;
        slot->capacity = capacity;
    }
    size_t got = mt_input_read_at(text->input, slot->base + slot->size, slot->buffer + slot->size, size - slot->size);
    if (got != size - slot->size) {
        mt_text_fail(block, MT_ERROR_IO, NULL, "could not be read");
        block->failure->reading = true;
        block->failure->offset = slot->base + slot->size;
        return false;
    }
    slot->size = size;
    return true;
}

/* Whether a line begins at byte `at` of the slot, which is not its first; the byte itself is present. */
static bool is_line_begin(const mt_text *text, const char *buffer, size_t at)
{
    size_t back = 1;
    if (buffer[at - 1] == '\r') {
        if (buffer[at] == '\n') {
            return false;
        }
    } else if (buffer[at - 1] != '\n') {
        return false;
    } else if (at >= 2 && buffer[at - 2] == '\r') {
        back = 2;
    }
    return !(text->options.continuations && at > back && buffer[at - back - 1] == '\\');
}

/* As is_line_begin, and the line is one that blocks may begin with. Loads the line when it must look at it. */
static bool is_block_begin(mt_text *text, mt_text_slot *slot, uint64_t at, mt_text_block *block)
{
    if (!is_line_begin(text, slot->buffer, (size_t)(at - slot->base))) {
        return false;
    }
    if (!text->options.may_begin) {
        return true;
    }
    size_t line = (size_t)(at - slot->base), end = line;
    for (;;) {
        while (end < slot->size && !mt_is_line_end(slot->buffer[end])) {
            end++;
        }
        uint64_t loaded = slot->base + slot->size;
        if (end < slot->size || loaded == text->end) {
            return text->options.may_begin(slot->buffer + line, slot->buffer + end);
        }
        if (!load_upto(text, slot, loaded + (end - line) + MT_TEXT_SLACK, block)) {
            return true;
        }
    }
}

/* The first byte in [from, limit) that a block begins with; limit when there is none. */
static uint64_t find_block_begin(mt_text *text, mt_text_slot *slot, uint64_t from, uint64_t limit, mt_text_block *block)
{
    uint64_t growth = MT_TEXT_SLACK;
    for (uint64_t at = from; at < limit; at++) {
        if (at >= slot->base + slot->size) {
            if (!load_upto(text, slot, at + growth, block)) {
                return limit;
            }
            growth *= 2;
        }
        if (is_block_begin(text, slot, at, block)) {
            return at;
        }
    }
    return limit;
}

bool mt_text_slot_load(mt_text *text, mt_text_slot *slot, mt_text_block *block)
{
    uint64_t nominal_begin = text->begin + block->number * text->block_size;
    uint64_t nominal_end = text->end - nominal_begin < text->block_size ? text->end : nominal_begin + text->block_size;
    uint64_t back = nominal_begin - text->begin < MT_TEXT_LOOK_BACK ? nominal_begin - text->begin : MT_TEXT_LOOK_BACK;
    slot->base = nominal_begin - back;
    slot->size = 0;
    if (!load_upto(text, slot, nominal_end + MT_TEXT_SLACK, block)) {
        return false;
    }
    uint64_t begin = nominal_begin, end = nominal_end;
    if (block->number > 0) {
        begin = find_block_begin(text, slot, nominal_begin, nominal_end, block);
    }
    if (begin < nominal_end && nominal_end < text->end) {
        end = find_block_begin(text, slot, nominal_end, text->end, block);
    }
    block->offset = begin;
    block->begin = slot->buffer + (begin - slot->base);
    block->end = slot->buffer + (end - slot->base);
    memset(slot->buffer + (end - slot->base) + 1, 0, MT_TEXT_PADDING);
    slot->buffer[end - slot->base] = '\n';
    return !mt_text_failed(block);
}
