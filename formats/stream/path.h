/* What a path says about its content. */
#ifndef MESHTOOL_STREAM_PATH_H
#define MESHTOOL_STREAM_PATH_H

#include <meshtool/context.h>

/* What follows the last dot of a path's last part; "" when there is none. */
const char *mt_path_suffix(const char *path);

/* An extension by value. Longer ones are cut, as no format has one. */
typedef struct mt_extension {
    char text[24];
} mt_extension;

/* The extension that tells the format: the suffix, or the one before it when the suffix tells of compression
 * ("bunny.obj.gz": "obj"). */
mt_extension mt_path_extension(const char *path);

/* The extension that tells the format to write: `wanted` (NULL: none), `fallback` for "-", devices and pipes, or the
 * path's. *out is "" when there is none. MT_ERROR_ARGUMENT when the path asks for a compression that this meshtool was
 * built without. */
mt_status mt_path_output_extension(mt_context *context, const char *path, const char *wanted, const char *fallback,
                                   mt_extension *out);

#endif
