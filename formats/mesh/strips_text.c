/* Strips as text, one a line. */
#include "formats/mesh/records.h"
#include "formats/stream/output.h"

#include <string.h>

#define BUFFER_SIZE 65536
#define NUMBER_ROOM 11 /* ten digits and what follows */

typedef struct line_buffer {
    size_t length;
    char text[BUFFER_SIZE];
} line_buffer;

static void append_number(line_buffer *buffer, mt_index number, char after)
{
    char digits[NUMBER_ROOM];
    size_t count = 0;
    do {
        digits[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    while (count) {
        buffer->text[buffer->length++] = digits[--count];
    }
    buffer->text[buffer->length++] = after;
}

static mt_status write_strip(mt_context *context, mt_output *output, const mt_index *indices, mt_index count,
                             line_buffer *buffer)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < count; i++) {
        append_number(buffer, indices[i], i + 1 < count ? ' ' : '\n');
        if (buffer->length + NUMBER_ROOM > BUFFER_SIZE) {
            status = mt_output_write(context, output, buffer->text, buffer->length);
            buffer->length = 0;
        }
    }
    return status;
}

static mt_status write_all(mt_context *context, const mt_strips *strips, mt_output *output, line_buffer *buffer)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < strips->strip_count; i++) {
        if (i >= strips->fan_begin) {
            status = mt_output_write(context, output, buffer->text, buffer->length);
            memcpy(buffer->text, "f ", 2);
            buffer->length = 2;
        }
        if (status == MT_OK) {
            status = write_strip(context, output, strips->indices + strips->offsets[i],
                                 strips->offsets[i + 1] - strips->offsets[i], buffer);
        }
    }
    return status == MT_OK ? mt_output_write(context, output, buffer->text, buffer->length) : status;
}

static mt_status write(mt_context *context, const mt_mesh *mesh, const mt_strips *strips,
                       const mt_strip_write_options *options, mt_output *output)
{
    (void)mesh;
    (void)options;
    line_buffer *buffer = mt_allocate(context, sizeof *buffer);
    if (!buffer) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    buffer->length = 0;
    mt_status status = write_all(context, strips, output, buffer);
    mt_free(context, buffer);
    return status;
}

static const char *const extensions[] = {"txt", NULL};

const mt_strip_format mt_strips_text_format = {
    .name = "text", .title = "text, one strip a line", .extensions = extensions, .write = write};
