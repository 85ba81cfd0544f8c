/* The shortest strips there are, by exhaustive search. */
#ifndef TESTS_SUPPORT_STRIP_OPTIMUM_H
#define TESTS_SUPPORT_STRIP_OPTIMUM_H

#include "tests/support/fixture.h"

/* A connected piece of a surface of 1 to TEST_FEW triangles on at most 10 vertices, without faces that name a vertex
 * twice. manifold: no side runs the same way as another; else edges of any number of sides, both ways. */
#define TEST_FEW 8
mt_mesh *test_few_triangles(mt_context *context, test_random *random, bool manifold);

/* The fewest indices, restarts counted, of any sequence that draws each of these few triangles once, turned as it is.
 */
uint64_t test_strip_optimum(const mt_mesh *mesh);

#endif
