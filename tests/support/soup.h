/* Small broken meshes with a fixed seed, and large ones with a known answer. */
#ifndef TESTS_SUPPORT_SOUP_H
#define TESTS_SUPPORT_SOUP_H

#include "tests/support/fixture.h"

/* A random soup of a dozen faces on a dozen vertices with whole coordinates from 0 to 3: repeated vertices, faces
 * given twice (turned, reversed), edges of many faces, isolated vertices; sometimes triangles alone, sometimes n-gons,
 * sometimes not a finite coordinate. */
mt_mesh *test_soup(mt_context *context, test_random *random);

/* A random piece of a closed surface (a grid rolled to a torus or a Klein bottle, or left open) with some faces left
 * out and, one time in two, some turned: mostly manifold, with holes, pinches and misoriented edges. */
mt_mesh *test_patch(mt_context *context, test_random *random);

/* One vertex, 0, in `count` triangles; closed: the last shares an edge with the first. */
mt_mesh *test_fan(mt_context *context, mt_index count, bool closed);

/* A torus of 2 * columns * rows triangles; shuffled: faces and vertices in a random order. */
mt_mesh *test_torus(mt_context *context, mt_index columns, mt_index rows, bool shuffled);

#endif
