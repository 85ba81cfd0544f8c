/* Bytes to write, buffered. A regular file is written beside its place and renamed by mt_output_commit;
 * mt_output_abandon leaves the old file and nothing new. Standard output, devices and pipes are written into. A regular
 * file whose name ends in .gz or .zst is compressed: the same bytes for the same content, at any time. */
#ifndef MESHTOOL_STREAM_OUTPUT_H
#define MESHTOOL_STREAM_OUTPUT_H

#include <meshtool/mesh_format.h>

/* Opens path ("-": standard output) for writing. MT_ERROR_IO with the reason; no_clobber: also when it exists. */
mt_status mt_output_open(mt_context *context, const char *path, bool no_clobber, mt_output **out);
/* Collects the bytes in memory. */
mt_status mt_output_open_memory(mt_context *context, mt_output **out);

/* Appends bytes. The first failure is recorded; later calls return it again. */
mt_status mt_output_write(mt_context *context, mt_output *output, const void *bytes, size_t size);
mt_status mt_output_text(mt_context *context, mt_output *output, const char *text);
mt_status mt_output_format(mt_context *context, mt_output *output, const char *format, ...) MT_PRINTF(3, 4);

/* Flushes, closes and renames into place; frees the output whether it succeeds or not. */
mt_status mt_output_commit(mt_context *context, mt_output *output);
/* Memory outputs: hands the bytes over (freed with mt_free) and frees the output. */
mt_status mt_output_take(mt_context *context, mt_output *output, void **bytes, size_t *size);
/* Drops what was written and frees the output. NULL is allowed. */
void mt_output_abandon(mt_context *context, mt_output *output);

/* Whether a path must be written into, not replaced: "-", a device, a pipe. */
bool mt_output_is_stream(const char *path);

#endif
