/* Bytes to read: a file, standard input, or memory. No file is mapped, so one that shrinks while it is
 * read is an error and not a signal. What gzip or zstd compressed is recognised by its content and read as what comes
 * out of it, a stream: sizes and offsets are those of the expanded bytes. */
#ifndef MESHTOOL_STREAM_INPUT_H
#define MESHTOOL_STREAM_INPUT_H

#include <meshtool/mesh_format.h>

#define MT_INPUT_PEEK 4096 /* bytes that mt_input_peek can show */

/* Opens path ("-": standard input). MT_ERROR_IO says why not: missing, no permission. A directory is
 * MT_ERROR_UNSUPPORTED, and so is compression whose library was left out. Reading then fails with MT_ERROR_SYNTAX for
 * compressed data that is damaged or incomplete, with its place in the compressed file, and with MT_ERROR_TOO_LARGE
 * past the cap of formats/stream/expand.h. */
mt_status mt_input_open(mt_context *context, const char *path, mt_input **out);
/* Reads from memory that outlives the input. */
mt_status mt_input_open_memory(mt_context *context, const char *name, const void *bytes, size_t size, mt_input **out);
/* NULL is allowed. */
void mt_input_close(mt_context *context, mt_input *input);

/* As the user named it, for mt_place.file. */
const char *mt_input_name(const mt_input *input);

/* Whether the name is a path that was opened, so that files beside it can be found by it; false for memory and standard
 * input. */
bool mt_input_has_folder(const mt_input *input);

/* Total bytes; UINT64_MAX for a stream. A file's size is a promise that reading checks. */
uint64_t mt_input_size(const mt_input *input);

/* Bytes consumed so far. */
uint64_t mt_input_offset(const mt_input *input);

/* The first bytes, without consuming them (only before the first read). */
mt_status mt_input_peek(mt_context *context, mt_input *input, const uint8_t **bytes, size_t *size);

/* Reads up to `size` bytes; *got is less only at the end. Small reads are buffered. */
mt_status mt_input_read(mt_context *context, mt_input *input, void *buffer, size_t size, size_t *got);

/* Reads exactly `size` bytes, or MT_ERROR_SYNTAX "ends after N bytes, expected `what`" with the place. */
mt_status mt_input_read_exactly(mt_context *context, mt_input *input, void *buffer, size_t size, const char *what);

/* Whether mt_input_read_at works: files and memory, not pipes before mt_input_collect. It may be called inside a
 * parallel body (it records no error): returns the bytes read, fewer only at the end, SIZE_MAX on failure. */
bool mt_input_can_read_at(const mt_input *input);
size_t mt_input_read_at(const mt_input *input, uint64_t offset, void *buffer, size_t size);

/* Records why mt_input_read_at failed at `offset`: the file became shorter, or the device failed. */
mt_status mt_input_fail_read_at(mt_context *context, const mt_input *input, uint64_t offset);

/* Takes the whole of a stream into memory, so that its size is known and mt_input_read_at works. Nothing to do for
 * files and memory. Bytes consumed before cannot be read at. Memory: the bytes of the stream. */
mt_status mt_input_collect(mt_context *context, mt_input *input);

/* A place in this input. */
mt_place mt_input_place_offset(const mt_input *input, uint64_t offset);
mt_place mt_input_place_line(const mt_input *input, uint64_t line);

#endif
