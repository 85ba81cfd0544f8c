/* Polygons with whole coordinates, and the proof that a triangulation covers one exactly. */
#ifndef TESTS_SUPPORT_POLYGON_H
#define TESTS_SUPPORT_POLYGON_H

#include "tests/support/fixture.h"

typedef struct test_polygon {
    size_t count, capacity;
    int64_t (*points)[2];
} test_polygon;

void test_polygon_add(test_polygon *polygon, int64_t x, int64_t y);
void test_polygon_reverse(test_polygon *polygon);
void test_polygon_release(test_polygon *polygon);

/* Makers of simple polygons, counter-clockwise. */
test_polygon test_polygon_convex(size_t count, int64_t radius); /* on a parabola and its chord */
test_polygon test_polygon_star(test_random *random, size_t count, int64_t radius);
test_polygon test_polygon_comb(test_random *random, size_t teeth);
test_polygon test_polygon_spiral(size_t turns, size_t per_turn);
test_polygon test_polygon_monotone(test_random *random, size_t count);
/* The outline of a random tree of width x height cells, with corridors and walls: straight corners, no order. Walls of
 * thickness 0 touch themselves everywhere, with points repeated. */
test_polygon test_polygon_maze(test_random *random, size_t width, size_t height, int wall);
/* Random points joined by a tour without crossings; count up to a few hundred. */
test_polygon test_polygon_tour(test_random *random, size_t count, int64_t size);
/* A rectangle with rows of diamond holes, joined to it by bridges that are walked twice. */
test_polygon test_polygon_sieve(size_t rows, size_t columns);

/* Corners inserted that change no area: a copy after a random point, the middle of a random side (coordinates double).
 */
test_polygon test_polygon_with_repeats(test_random *random, const test_polygon *polygon, size_t count);
test_polygon test_polygon_with_middles(test_random *random, const test_polygon *polygon, size_t count);

/* Twice the signed area. */
int64_t test_polygon_area(const test_polygon *polygon);

/* The polygon as the one face of a mesh: its plane z = x * slope[0] + y * slope[1], coordinates then rotated by `axis`
 * places and multiplied by `scale`. */
mt_mesh *test_polygon_mesh(mt_context *context, const test_polygon *polygon, const int64_t slope[2], int axis,
                           double scale);

/* Asserts that the triangles use every side once, every diagonal once in each direction, and none turns against the
 * polygon: then each point is covered as often as the polygon winds around it. Returns the number of triangles of
 * zero area. */
size_t test_polygon_check(const test_polygon *polygon, const mt_index *triangles);
/* The first half of that alone, for polygons that no triangulation covers. */
void test_polygon_check_sides(size_t count, const mt_index *triangles);

#endif
