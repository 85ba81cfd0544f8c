/* The record behind --explain: what was built and skipped, with its milliseconds and bytes. */
#include "lib/base/context.h"

#include <time.h>

static double milliseconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static mt_part *add_part(mt_context *context, const char *name, const char *reason)
{
    if (!context->options.explain || context->measured_part) {
        return NULL;
    }
    if (context->part_count == MT_PART_CAPACITY) {
        context->parts_left_out++;
        return NULL;
    }
    mt_part *part = &context->parts[context->part_count++];
    *part = (mt_part){.name = name, .reason = reason};
    return part;
}

int mt_part_begin(mt_context *context, const char *name, const char *reason)
{
    mt_part *part = add_part(context, name, reason);
    if (!part) {
        return -1;
    }
    int token = (int)(part - context->parts);
    part->built = true;
    context->part_begins[token] = milliseconds_now();
    context->part_bytes[token] = mt_context_bytes(context);
    return token;
}

int mt_part_begin_skipped(mt_context *context, const char *name, const char *reason)
{
    int token = mt_part_begin(context, name, reason);
    if (token >= 0) {
        context->parts[token].built = false;
        context->measured_part = token + 1;
    }
    return token;
}

void mt_part_end(mt_context *context, int token)
{
    if (token < 0) {
        return;
    }
    if (context->measured_part == token + 1) {
        context->measured_part = 0;
    }
    mt_part *part = &context->parts[token];
    uint64_t before = context->part_bytes[token];
    uint64_t after = mt_context_bytes(context);
    part->milliseconds = milliseconds_now() - context->part_begins[token];
    part->bytes = after > before ? after - before : 0;
}

void mt_part_skip(mt_context *context, const char *name, const char *reason)
{
    add_part(context, name, reason);
}

const mt_part *mt_context_parts(const mt_context *context, size_t *count)
{
    *count = context->part_count;
    return context->parts;
}

uint64_t mt_context_parts_left_out(const mt_context *context)
{
    return context->parts_left_out;
}
