/* Files of strips: one table of formats. */
#ifndef MESHTOOL_STRIP_FORMAT_H
#define MESHTOOL_STRIP_FORMAT_H

#include <meshtool/strips.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_output mt_output;

/* All zeros means the defaults. */
typedef struct mt_strip_write_options {
    const char *format; /* an extension that overrides the path's; NULL: the path's, "txt" for pipes */
    bool no_clobber;    /* refuse with MT_ERROR_IO when the file exists */
} mt_strip_write_options;

typedef struct mt_strip_format {
    const char *name;
    const char *title;
    const char *const *extensions; /* lower case without the dot, NULL-terminated; the first is preferred */
    bool holds_vertices;           /* of the mesh, beside their numbers */
    mt_status (*write)(mt_context *context, const mt_mesh *mesh, const mt_strips *strips,
                       const mt_strip_write_options *options, mt_output *output);
} mt_strip_format;

/* The table, NULL-terminated. Text: one strip a line, the indices of its vertices from 0 with a space between, "f "
 * before a fan; the end of a line stands for a restart. */
const mt_strip_format *const *mt_strip_formats(void);

/* The format that a path's extension names, options->format (options may be NULL) first; text for "-", devices and
 * pipes. NULL with MT_ERROR_ARGUMENT recorded, naming the known ones, when there is none. */
const mt_strip_format *mt_strip_format_for_output(mt_context *context, const char *path,
                                                  const mt_strip_write_options *options);

/* Writes strips of the mesh beside their place and renames them there; a failed run leaves the old file and nothing
 * new.
 * "-" is standard output; devices and pipes are written into. options may be NULL. */
mt_status mt_strips_write_file(mt_context *context, const mt_mesh *mesh, const mt_strips *strips, const char *path,
                               const mt_strip_write_options *options);

#ifdef __cplusplus
}
#endif
#endif
