/* A folder of one's own for files that a test writes, gone when the test ends. */
#ifndef TESTS_SUPPORT_SCRATCH_H
#define TESTS_SUPPORT_SCRATCH_H

#include <stddef.h>

/* The path of a file in the folder, which is made at the first call. Valid until the eighth call after. */
const char *test_scratch_path(const char *name);

/* Writes a file there; returns its path. */
const char *test_scratch_file(const char *name, const void *bytes, size_t size);

/* Makes a pipe there that another process fills with the bytes; _end reaps that process and removes the pipe. One at a
 * time. */
const char *test_scratch_pipe(const char *name, const void *bytes, size_t size);
void test_scratch_pipe_end(const char *path);

/* Files in the folder, whatever their names. */
size_t test_scratch_count(void);

#endif
