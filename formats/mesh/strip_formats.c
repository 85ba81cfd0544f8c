/* The table of formats for strips, and writing by a path's extension. */
#include "formats/mesh/records.h"
#include "formats/stream/output.h"
#include "formats/stream/path.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

const mt_strip_format *const *mt_strip_formats(void)
{
    static const mt_strip_format *const table[] = {&mt_strips_text_format, &mt_strips_glb_format,
                                                   &mt_strips_gltf_format, NULL};
    return table;
}

static const mt_strip_format *find_format(const char *extension)
{
    for (const mt_strip_format *const *format = mt_strip_formats(); *format; format++) {
        for (const char *const *known = (*format)->extensions; *known; known++) {
            if (strcasecmp(extension, *known) == 0) {
                return *format;
            }
        }
    }
    return NULL;
}

static void fail_unknown(mt_context *context, const char *path, const char *extension)
{
    char known[128] = "";
    for (const mt_strip_format *const *format = mt_strip_formats(); *format; format++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", (*format)->extensions[0]);
    }
    if (extension[0]) {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: no format for strips is called \"%s\", expected one of: %s", path,
                extension, known);
    } else {
        mt_fail(context, MT_ERROR_ARGUMENT, "%s: the name has no extension to tell the format, expected one of: %s",
                path, known);
    }
}

const mt_strip_format *mt_strip_format_for_output(mt_context *context, const char *path,
                                                  const mt_strip_write_options *options)
{
    mt_extension named;
    if (mt_path_output_extension(context, path, options ? options->format : NULL, "txt", &named) != MT_OK) {
        return NULL;
    }
    const mt_strip_format *format = find_format(named.text);
    if (!format) {
        fail_unknown(context, path, named.text);
    }
    return format;
}

mt_status mt_strips_write_file(mt_context *context, const mt_mesh *mesh, const mt_strips *strips, const char *path,
                               const mt_strip_write_options *options)
{
    static const mt_strip_write_options defaults;
    options = options ? options : &defaults;
    const mt_strip_format *format = mt_strip_format_for_output(context, path, options);
    if (!format) {
        return MT_ERROR_ARGUMENT;
    }
    mt_output *output = NULL;
    mt_status status = mt_output_open(context, path, options->no_clobber, &output);
    if (status != MT_OK) {
        return status;
    }
    status = format->write(context, mesh, strips, options, output);
    if (status != MT_OK) {
        mt_output_abandon(context, output);
        return status;
    }
    return mt_output_commit(context, output);
}
