/* The oracles' own way past triangles that are out of reach, so that they can ask about more places of a large mesh:
 * triangles in the order of a space-filling curve, in boxes of sixteen, those in boxes of sixteen boxes, and so on.
 * What is passed by is only what the asker's test of a box rules out; with a test that rules out nothing it is brute
 * force. */
#ifndef MESHTOOL_CLI_TRADEOFF_TRIANGLE_BLOCKS_H
#define MESHTOOL_CLI_TRADEOFF_TRIANGLE_BLOCKS_H

#include <meshtool/ray.h>
#include <meshtool/triangulate.h>

#include <stdatomic.h>

#define TRIANGLE_BLOCKS_LEVELS 8

typedef struct triangle_box {
    double low[3], high[3];
} triangle_box;

triangle_box triangle_box_around(const mt_vec3 corners[3]);
/* Whether a ray may come so near, in doubles and generously: no box within this one may be met when this may not. */
bool triangle_box_may_meet(const triangle_box *box, const mt_ray *ray, double margin);

typedef struct triangle_blocks {
    mt_index count;  /* of triangles whose vertices are all finite; the others are never visited */
    mt_index *order; /* their numbers, along the curve */
    int level_count;
    triangle_box *levels[TRIANGLE_BLOCKS_LEVELS]; /* boxes of 16 triangles, of 16 boxes, ... */
    mt_index sizes[TRIANGLE_BLOCKS_LEVELS];
    atomic_uint_fast64_t work; /* boxes and triangles looked at so far, by all threads */
} triangle_blocks;

/* `out` begins with zeros; released in every case. */
mt_status triangle_blocks_make(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                               triangle_blocks *out);
void triangle_blocks_release(mt_context *context, triangle_blocks *blocks);

/* What asks: `may_hold` says whether a box may hold a triangle that matters, `visit` looks at one. The order of visits
 * is the curve's. */
typedef struct triangle_query {
    bool (*may_hold)(const void *user, const triangle_box *box);
    void (*visit)(void *user, mt_index triangle);
} triangle_query;

void triangle_blocks_visit(triangle_blocks *blocks, const triangle_query *query, void *user);

/* Calls `ask` with ranges of [0, count), on all threads, until all are asked or so much work is done; as many are asked
 * first as brute force would ask. Returns how many were: the same on every machine. */
size_t triangle_blocks_ask(mt_context *context, triangle_blocks *blocks, size_t count, uint64_t work,
                           void (*ask)(void *user, uint64_t begin, uint64_t end), void *user);

#endif
