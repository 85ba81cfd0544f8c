/* The table of image formats, and writing by a path's extension. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#include <string.h>
#include <strings.h>

static const mt_image_format *const formats[] = {
#ifdef MESHTOOL_PNG
    &mt_png_format,
#endif
    &mt_ppm_format, &mt_pgm_format, &mt_pam_format, &mt_pfm_format, NULL};

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

/* The letters behind the last dot of the last part of the path, "" when there are none. */
static const char *path_extension(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot + 1 : "";
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
    const char *extension = options && options->format ? options->format : NULL;
    if (!extension) {
        extension = mt_output_is_stream(path) ? "png" : path_extension(path);
    }
    const mt_image_format *format = mt_image_format_by_extension(extension);
    if (format) {
        return format;
    }
    char known[64];
    list_extensions(known, sizeof known);
    if (strcasecmp(extension, "png") == 0) {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: this meshtool was built without PNG; it writes %s", path, known);
    } else if (extension[0] == '\0') {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: the name has no extension that says which image format to write (%s)",
                path, known);
    } else {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: no image format is called \"%s\"; meshtool writes %s", path, extension,
                known);
    }
    return NULL;
}

mt_status mt_image_write_file(mt_context *context, const mt_image *image, const char *path,
                              const mt_image_write_options *options)
{
    const mt_image_format *format = mt_image_format_for_output(context, path, options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_output *output = NULL;
    mt_status status = mt_output_open(context, path, options && options->no_clobber, &output);
    if (status != MT_OK) {
        return status;
    }
    status = format->write(context, image, options, output);
    if (status != MT_OK) {
        mt_output_abandon(context, output);
        return status;
    }
    return mt_output_commit(context, output);
}
