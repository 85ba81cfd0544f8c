/* Any bytes as a file, written as all outputs are. */
#ifndef MESHTOOL_FILE_H
#define MESHTOOL_FILE_H

#include <meshtool/context.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes `size` bytes beside `path` and renames them into place, so that a failure leaves the old file whole and
 * nothing new; "-" is standard output, and devices and pipes are written into. no_clobber: an existing file is
 * MT_ERROR_IO. The bytes are borrowed. */
mt_status mt_file_write(mt_context *context, const char *path, const void *bytes, size_t size, bool no_clobber);

#ifdef __cplusplus
}
#endif
#endif
