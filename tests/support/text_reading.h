/* Reading meshes from text in memory, with the warnings kept, and comparing meshes value by value. */
#ifndef TESTS_SUPPORT_TEXT_READING_H
#define TESTS_SUPPORT_TEXT_READING_H

#include <meshtool/mesh_format.h>

#define TEST_WARNING_ROOM 8192

/* A context whose warnings are gathered in `text`, one a line. */
typedef struct test_warnings {
    size_t count;
    char text[TEST_WARNING_ROOM];
} test_warnings;
mt_context *test_context_with_warnings(test_warnings *warnings, unsigned thread_count);

/* Reads bytes under a name; fails the test, with the error, unless it succeeds and the mesh is valid. */
mt_mesh *text_read_bytes(mt_context *context, const char *name, const void *bytes, size_t size);
mt_mesh *text_read(mt_context *context, const char *name, const char *text);

/* Reads bytes that must be refused, with nothing left behind; returns the message. */
const char *text_refuse(mt_context *context, const char *name, const void *bytes, size_t size, mt_status status);

/* Writes to memory in the format, and reads that again. */
mt_mesh *text_through(mt_context *context, const mt_mesh *mesh, const char *format, mt_encoding encoding);

#endif
