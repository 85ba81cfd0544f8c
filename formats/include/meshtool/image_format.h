/* Image files: one table of formats. */
#ifndef MESHTOOL_IMAGE_FORMAT_H
#define MESHTOOL_IMAGE_FORMAT_H

#include <meshtool/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_output mt_output;

/* All zeros means the defaults. */
typedef struct mt_image_write_options {
    const char *format; /* an extension that overrides the path's; NULL: the path's, "png" for pipes */
    unsigned bits;      /* per channel: 8 (default) or 16 where the format has them */
    bool no_clobber;
} mt_image_write_options;

typedef struct mt_image_format {
    const char *name;
    const char *title;
    const char *const *extensions; /* NULL-terminated, the first is preferred */
    bool holds_alpha;
    mt_status (*write)(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                       mt_output *output);
} mt_image_format;

/* The table, NULL-terminated. */
const mt_image_format *const *mt_image_formats(void);
const mt_image_format *mt_image_format_by_extension(const char *extension);

/* The format that a path's extension names for writing; "png" for "-", devices and pipes. NULL with
 * MT_ERROR_ARGUMENT recorded when it is unknown. */
const mt_image_format *mt_image_format_for_output(mt_context *context, const char *path,
                                                  const mt_image_write_options *options);

/* Writes a picture; linear pixels are sRGB-encoded where the format is (all but pfm). As mt_mesh_write_file:
 * beside its place, then renamed. */
mt_status mt_image_write_file(mt_context *context, const mt_image *image, const char *path,
                              const mt_image_write_options *options);

#ifdef __cplusplus
}
#endif
#endif
