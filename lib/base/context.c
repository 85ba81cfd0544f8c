#include "lib/base/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

mt_context *mt_context_create(const mt_context_options *options)
{
    mt_context *context = calloc(1, sizeof *context);
    if (!context) {
        return NULL;
    }
    if (options) {
        context->options = *options;
    }
    context->thread_count = context->options.thread_count ? context->options.thread_count : mt_available_threads();
    return context;
}

void mt_context_destroy(mt_context *context)
{
    free(context);
}

const mt_error *mt_context_error(const mt_context *context)
{
    return &context->error;
}

void mt_context_clear_error(mt_context *context)
{
    memset(&context->error, 0, sizeof context->error);
}

unsigned mt_context_thread_count(const mt_context *context)
{
    return context->thread_count;
}

static int print_place(const mt_place *place, char *text, size_t room)
{
    int length = 0;
    if (place->file && place->has_offset) {
        length = snprintf(text, room, "%s@%llu: ", place->file, (unsigned long long)place->offset);
    } else if (place->file && place->line && place->column) {
        length = snprintf(text, room, "%s:%llu:%llu: ", place->file, (unsigned long long)place->line,
                          (unsigned long long)place->column);
    } else if (place->file && place->line) {
        length = snprintf(text, room, "%s:%llu: ", place->file, (unsigned long long)place->line);
    } else if (place->file) {
        length = snprintf(text, room, "%s: ", place->file);
    }
    return length < 0 ? 0 : length;
}

static mt_status keep_failure(mt_context *context, mt_status status, const mt_place *place, const char *format,
                              va_list arguments)
{
    mt_error *error = &context->error;
    if (error->status != MT_OK) {
        return status;
    }
    error->status = status;
    error->place = *place;
    if (place->file) {
        snprintf(context->error_file, sizeof context->error_file, "%s", place->file);
        error->place.file = context->error_file;
    }
    size_t length = (size_t)print_place(&error->place, error->message, sizeof error->message);
    if (length < sizeof error->message) {
        vsnprintf(error->message + length, sizeof error->message - length, format, arguments);
    }
    return status;
}

mt_status mt_fail(mt_context *context, mt_status status, const char *format, ...)
{
    mt_place nowhere = {0};
    va_list arguments;
    va_start(arguments, format);
    keep_failure(context, status, &nowhere, format, arguments);
    va_end(arguments);
    return status;
}

mt_status mt_fail_at(mt_context *context, mt_status status, mt_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    keep_failure(context, status, &place, format, arguments);
    va_end(arguments);
    return status;
}

void mt_warn(mt_context *context, const char *format, ...)
{
    if (!context->options.warning) {
        return;
    }
    char sentence[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    context->options.warning(context->options.warning_user, sentence);
}

mt_status mt_progress(mt_context *context, const char *task, double fraction)
{
    if (context->options.progress && !context->options.progress(context->options.progress_user, task, fraction)) {
        return mt_fail(context, MT_ERROR_CANCELLED, "cancelled while %s", task);
    }
    return MT_OK;
}
