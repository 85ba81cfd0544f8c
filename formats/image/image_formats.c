/* The table of image formats, and writing by a path's extension. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"
#include "formats/stream/path.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const mt_image_format *const formats[] = {
#ifdef MESHTOOL_PNG
    &mt_png_format,
#endif
#ifdef MESHTOOL_JPEG
    &mt_jpeg_format,
#endif
#ifdef MESHTOOL_TIFF
    &mt_tiff_format,
#endif
    &mt_ppm_format,  &mt_pgm_format, &mt_pbm_format, &mt_pam_format, &mt_pfm_format, NULL};

const mt_image_format *const *mt_image_formats(void)
{
    return formats;
}

const mt_image_format *mt_image_format_by_extension(const char *extension)
{
    for (const mt_image_format *const *format = formats; *format; format++) {
        for (const char *const *known = (*format)->extensions; *known; known++) {
            if (strcasecmp(extension, *known) == 0) {
                return *format;
            }
        }
    }
    return NULL;
}

static void list_extensions(char *text, size_t size)
{
    text[0] = '\0';
    for (const mt_image_format *const *format = formats; *format; format++) {
        size_t used = strlen(text);
        if (used + strlen((*format)->extensions[0]) + 3 < size) {
            strcat(strcat(text, used ? ", " : ""), (*format)->extensions[0]);
        }
    }
}

const mt_image_format *mt_image_format_for_output(mt_context *context, const char *path,
                                                  const mt_image_write_options *options)
{
    mt_extension named;
    if (mt_path_output_extension(context, path, options ? options->format : NULL, "png", &named) != MT_OK) {
        return NULL;
    }
    const char *extension = named.text;
    const mt_image_format *format = mt_image_format_by_extension(extension);
    if (format) {
        return format;
    }
    char known[128];
    list_extensions(known, sizeof known);
    const char *left_out = mt_image_format_left_out(extension);
    if (left_out) {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: this meshtool was built without %s; it writes %s", path, left_out,
                known);
    } else if (extension[0] == '\0') {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: the name has no extension that says which image format to write (%s)",
                path, known);
    } else {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: no image format is called \"%s\"; meshtool writes %s", path, extension,
                known);
    }
    return NULL;
}

const char *mt_image_format_left_out(const char *extension)
{
    static const struct {
        const char *extension, *title;
    } optional[] = {{"png", "PNG, with libspng"},
                    {"jpg", "JPEG, with libjpeg"},
                    {"jpeg", "JPEG, with libjpeg"},
                    {"tiff", "TIFF, with libtiff"},
                    {"tif", "TIFF, with libtiff"}};
    for (size_t i = 0; i < sizeof optional / sizeof optional[0]; i++) {
        if (strcasecmp(extension, optional[i].extension) == 0 && !mt_image_format_by_extension(extension)) {
            return optional[i].title;
        }
    }
    return NULL;
}

static bool has_bits(const mt_image_format *format, unsigned bits)
{
    bool found = false;
    for (size_t i = 0; i < sizeof format->bits / sizeof format->bits[0]; i++) {
        found = found || format->bits[i] == bits;
    }
    return found;
}

static mt_status fail_bits(mt_context *context, const mt_image_format *format, unsigned bits)
{
    char known[32] = "";
    size_t room = sizeof format->bits / sizeof format->bits[0], length = 0;
    for (size_t i = 0; i < room && format->bits[i]; i++) {
        bool last = i + 1 == room || !format->bits[i + 1];
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%u",
                                   i == 0 ? ""
                                   : last ? " or "
                                          : ", ",
                                   format->bits[i]);
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "%s is written with %s bits a channel, not %u", format->title, known,
                   bits);
}

mt_status mt_image_written_bits(mt_context *context, const mt_image_format *format,
                                const mt_image_write_options *options, unsigned *bits)
{
    unsigned quality = options ? options->quality : 0;
    *bits = options && options->bits ? options->bits : has_bits(format, 8) ? 8 : format->bits[0];
    if (!has_bits(format, *bits)) {
        return fail_bits(context, format, *bits);
    }
    if (quality > 0 && !format->has_quality) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "%s has no quality to choose", format->title);
    }
    return quality > 100
               ? mt_fail(context, MT_ERROR_ARGUMENT, "the quality of a %s is 1 to 100, not %u", format->title, quality)
               : MT_OK;
}

/* Writes all bytes; when that fails the output is gone. */
static mt_status write_or_abandon(mt_context *context, const mt_image_format *format, const mt_image *image,
                                  const mt_image_write_options *options, mt_output *output)
{
    mt_status status = format->write(context, image, options, output);
    if (status != MT_OK) {
        mt_output_abandon(context, output);
    }
    return status;
}

mt_status mt_image_write_file(mt_context *context, const mt_image *image, const char *path,
                              const mt_image_write_options *options)
{
    const mt_image_format *format = mt_image_format_for_output(context, path, options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_output *output = NULL;
    unsigned bits;
    mt_status status = mt_image_written_bits(context, format, options, &bits);
    if (status == MT_OK) {
        status = mt_output_open(context, path, options && options->no_clobber, &output);
    }
    if (status != MT_OK) {
        return status;
    }
    status = write_or_abandon(context, format, image, options, output);
    return status == MT_OK ? mt_output_commit(context, output) : status;
}

mt_status mt_image_write_memory(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                                void **bytes, size_t *size)
{
    *bytes = NULL;
    *size = 0;
    const mt_image_format *format = mt_image_format_for_output(context, "-", options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_output *output = NULL;
    unsigned bits;
    mt_status status = mt_image_written_bits(context, format, options, &bits);
    if (status == MT_OK) {
        status = mt_output_open_memory(context, &output);
    }
    if (status != MT_OK) {
        return status;
    }
    status = write_or_abandon(context, format, image, options, output);
    return status == MT_OK ? mt_output_take(context, output, bytes, size) : status;
}
