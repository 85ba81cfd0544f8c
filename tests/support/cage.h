/* Cages for subdivision: manifold, oriented, with triangles, quads and hexagons. */
#ifndef TESTS_SUPPORT_CAGE_H
#define TESTS_SUPPORT_CAGE_H

#include "tests/support/fixture.h"

/* The cube of corners (-1 or 1, -1 or 1, -1 or 1): vertex i has x from bit 0 of i, y from bit 1, z from bit 2. */
mt_mesh *test_cube(mt_context *context);

/* A grid of columns x rows cells (at least 3 by 3), rolled to a torus when closed, else a wavy sheet; each cell is left
 * a quad, cut into two triangles or joined with its neighbour to a hexagon, at random, positions shaken. */
mt_mesh *test_cage(mt_context *context, test_random *random, mt_index columns, mt_index rows, bool closed);

/* The first such cage whose faces can be cut into triangles: of others two diagonals are one edge. */
mt_mesh *test_triangle_cage(mt_context *context, test_random *random, mt_index columns, mt_index rows, bool closed);

/* A copy with renumbered vertices, shuffled and turned faces, and, if `reverse`, all faces reversed. corner_images
 * receives per corner of the mesh the one of the copy that has the same vertex in the same face. */
mt_mesh *test_renumbered(mt_context *context, test_random *random, const mt_mesh *mesh, bool reverse,
                         mt_index *corner_images);

/* Adds creases to a third of the sides and corners to a tenth of the vertices, of sharpness 0.5 to 10. */
void test_sharpen(mt_context *context, test_random *random, mt_mesh *mesh);

/* Adds UVs with seams: most corners have their vertex's value, some another. */
void test_add_uvs(mt_context *context, test_random *random, mt_mesh *mesh);

/* No vertex of the refined mesh lies farther out than the cage, in any of many directions. */
void test_expect_within_hull(test_random *random, const mt_mesh *cage, const mt_mesh *refined);

#endif
