/* Reading meshes from bytes in tests: what must be read, what must be refused and with which sentence. */
#ifndef TESTS_SUPPORT_READING_H
#define TESTS_SUPPORT_READING_H

#include <meshtool/mesh_format.h>

/* A context that keeps its warnings, one a line. */
typedef struct test_reading {
    mt_context *context;
    char warnings[4096];
} test_reading;
void test_reading_begin(test_reading *reading);
void test_reading_begin_with(test_reading *reading, mt_context_options options);
/* Destroys the context after asserting that every byte was given back. */
void test_reading_end(test_reading *reading);

/* Reads a mesh, which must be valid; the earlier warnings are forgotten. Fails the test, with the message, when it is
 * refused. */
mt_mesh *test_read(test_reading *reading, const char *name, const void *bytes, size_t size);
mt_mesh *test_read_text(test_reading *reading, const char *name, const char *text);

/* The bytes must be refused with the status, and the message must contain the part given. */
void test_refuse(test_reading *reading, const char *name, const void *bytes, size_t size, mt_status status,
                 const char *part);
void test_refuse_text(test_reading *reading, const char *name, const char *text, mt_status status, const char *part);

/* The warnings since the last reading must contain the part; NULL: there must be none. */
void test_warned(const test_reading *reading, const char *part);

/* Writes the mesh in a format and reads it again. */
mt_mesh *test_round_trip(test_reading *reading, const mt_mesh *mesh, const char *format, mt_encoding encoding);

/* Everything that the two meshes hold must be equal to the bit. */
void test_assert_same_mesh(const mt_mesh *a, const mt_mesh *b);

#endif
