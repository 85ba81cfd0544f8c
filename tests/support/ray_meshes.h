/* Meshes that break naive structures for rays. */
#ifndef TESTS_SUPPORT_RAY_MESHES_H
#define TESTS_SUPPORT_RAY_MESHES_H

#include "tests/support/fixture.h"

/* Triangles of aspect up to 1e6, crossing each other. */
mt_mesh *test_slivers(mt_context *context);
/* Every face three times, in a plane across an axis: boxes of no thickness, ties everywhere. */
mt_mesh *test_flat_duplicates(mt_context *context);
/* The same plane, turned so that no axis lies in it or across it: rays from one vertex to another graze it. */
mt_mesh *test_slanted_plane(mt_context *context);
/* A teapot in a stadium: a small surface amid one a million times as large. */
mt_mesh *test_two_scales(mt_context *context);
/* Ten million units off, details of a thousandth. */
mt_mesh *test_far_torus(mt_context *context);
/* Coordinates around 1e-150, and around 1e150. */
mt_mesh *test_tiny_torus(mt_context *context);
mt_mesh *test_huge_torus(mt_context *context);
/* The same triangle `count` times. */
mt_mesh *test_equal_triangles(mt_context *context, mt_index count);
/* Triangles whose coordinates halve from one to the next, where cuts in the middle peel off one at a time. */
mt_mesh *test_geometric_series(mt_context *context, mt_index count);

#endif
