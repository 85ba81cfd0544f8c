#ifndef TESTS_SUPPORT_RANDOM_MESH_H
#define TESTS_SUPPORT_RANDOM_MESH_H

#include "tests/support/fixture.h"

/* A random mesh that PLY holds to the bit: triangles or n-gons, either precision, wires of two vertices, and attributes
 * of every type, meaning and domain that have a place in it. Sometimes without faces, or of nothing at all. */
mt_mesh *test_random_mesh(mt_context *context, test_random *random);

/* Random numbers over many magnitudes, for `count` floats or doubles, or bytes for whole numbers. Never nan. */
void test_random_values(test_random *random, mt_type type, void *values, size_t count);

#endif
