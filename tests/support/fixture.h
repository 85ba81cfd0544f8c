/* What most unit tests need: a context, meshes written as literals, and a fixed random sequence. */
#ifndef TESTS_SUPPORT_FIXTURE_H
#define TESTS_SUPPORT_FIXTURE_H

#include <meshtool/mesh.h>

/* A context with default options; fails the test when it cannot be had. */
mt_context *test_context(void);
mt_context *test_context_with_threads(unsigned thread_count);
/* Destroys the context after asserting that every byte was given back. */
void test_context_end(mt_context *context);

/* A mesh of doubles from `vertex_count` xyz triples and `face_count` faces, whose sides and vertices are laid
 * out as "size, v0, v1, ..." one after the other. */
mt_mesh *test_mesh(mt_context *context, mt_index vertex_count, const double *positions, mt_index face_count,
                   const mt_index *faces);

/* A fixed sequence of 64-bit numbers (SplitMix64): the same on every machine. */
typedef struct test_random {
    uint64_t state;
} test_random;
uint64_t test_random_next(test_random *random);
/* A whole number in [0, limit). */
uint64_t test_random_below(test_random *random, uint64_t limit);
/* A double in [0, 1). */
double test_random_unit(test_random *random);

/* FNV-1a of some bytes, to compare results by one number. */
uint64_t test_hash(const void *bytes, size_t size);
/* Of everything a mesh holds. */
uint64_t test_mesh_hash(const mt_mesh *mesh);

/* The whole of a file in malloc'ed memory, or NULL. */
unsigned char *test_read_file(const char *path, size_t *size);

#endif
