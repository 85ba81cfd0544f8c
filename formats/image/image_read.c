/* Reading pictures: which format it is, by content first, then by name; and the readers in their table. */
#include "formats/image/image_format.h"
#include "formats/stream/input.h"
#include "formats/stream/path.h"

#include <string.h>

/* Contents of formats that may have been left out, and of those that are never read. */
static mt_status refuse_stranger(mt_context *context, const char *name, const uint8_t *bytes, size_t size)
{
    static const struct {
        const char *magic;
        size_t at, size;
        const char *extension; /* NULL: never read */
        const char *title;
    } strangers[] = {
        {"\x89PNG", 0, 4, "png", NULL},
        {"\xff\xd8\xff", 0, 3, "jpg", NULL},
        {"II*\0", 0, 4, "tiff", NULL},
        {"MM\0*", 0, 4, "tiff", NULL},
        {"GIF8", 0, 4, NULL, "GIF"},
        {"BM", 0, 2, NULL, "BMP"},
        {"WEBP", 8, 4, NULL, "WebP"},
        {"#?RADIANCE", 0, 10, NULL, "Radiance HDR"},
        {"\x76\x2f\x31\x01", 0, 4, NULL, "OpenEXR"},
    };
    mt_place place = {.file = name};
    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++) {
        if (size < strangers[i].at + strangers[i].size ||
            memcmp(bytes + strangers[i].at, strangers[i].magic, strangers[i].size) != 0) {
            continue;
        }
        const char *left_out = strangers[i].extension ? mt_image_format_left_out(strangers[i].extension) : NULL;
        if (left_out) {
            return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place, "this meshtool was built without %s", left_out);
        }
        if (!strangers[i].extension) {
            return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place, "is a %s picture, which is not read",
                              strangers[i].title);
        }
    }
    return MT_OK;
}

static mt_status choose(mt_context *context, const char *name, const uint8_t *bytes, size_t size,
                        const mt_image_format **out)
{
    mt_place place = {.file = name};
    const mt_image_format *named = mt_image_format_by_extension(mt_path_extension(name).text), *best = NULL;
    int score = 0;
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        int one = (*format)->sniff ? (*format)->sniff(bytes, size) : 0;
        if (one > score) {
            score = one;
            best = *format;
        }
    }
    if (!best) {
        mt_status status = refuse_stranger(context, name, bytes, size);
        *out = status == MT_OK ? named : NULL;
        return *out || status != MT_OK ? status
                                       : mt_fail_at(context, MT_ERROR_SYNTAX, place,
                                                    "neither the content nor the name tells a picture format");
    }
    *out = best;
    if (named && named != best && named->read != best->read) {
        mt_warn(context, "%s: the content is %s although the name says %s; read as %s", name, best->title, named->title,
                best->title);
    }
    return MT_OK;
}

mt_status mt_recognise_image(mt_context *context, mt_input *input, const char *wanted, const mt_image_format **out)
{
    const uint8_t *bytes;
    size_t size;
    *out = NULL;
    mt_status status = mt_input_peek(context, input, &bytes, &size);
    if (status != MT_OK) {
        return status;
    }
    if (size == 0) {
        mt_place place = {.file = mt_input_name(input)};
        return mt_fail_at(context, MT_ERROR_SYNTAX, place, "is empty (0 bytes), expected a picture");
    }
    if (!wanted) {
        return choose(context, mt_input_name(input), bytes, size, out);
    }
    *out = mt_image_format_by_extension(wanted);
    const char *left_out = mt_image_format_left_out(wanted);
    if (left_out) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "this meshtool was built without %s", left_out);
    }
    return *out ? MT_OK : mt_fail(context, MT_ERROR_ARGUMENT, "no image format is called \"%s\"", wanted);
}

static mt_status read_input(mt_context *context, mt_input *input, const mt_image_read_options *options, mt_image **out,
                            mt_image_source *source)
{
    mt_image_source found = {0};
    mt_status status = mt_recognise_image(context, input, options ? options->format : NULL, &found.format);
    if (status == MT_OK) {
        status = found.format->read(context, input, out, &found.bits);
    }
    if (status != MT_OK) {
        mt_image_destroy(context, *out);
        *out = NULL;
    }
    if (source) {
        *source = found;
    }
    return status;
}

mt_status mt_image_read_file(mt_context *context, const char *path, const mt_image_read_options *options,
                             mt_image **out, mt_image_source *source)
{
    mt_input *input;
    *out = NULL;
    mt_status status = mt_input_open(context, path, &input);
    if (status == MT_OK) {
        status = read_input(context, input, options, out, source);
        mt_input_close(context, input);
    }
    return status;
}

mt_status mt_image_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                               const mt_image_read_options *options, mt_image **out, mt_image_source *source)
{
    mt_input *input;
    *out = NULL;
    mt_status status = mt_input_open_memory(context, name, bytes, size, &input);
    if (status == MT_OK) {
        status = read_input(context, input, options, out, source);
        mt_input_close(context, input);
    }
    return status;
}
