/* Rays by the thousand against a mesh, by brute force and through the tree. */
#ifndef TESTS_SUPPORT_RAYS_H
#define TESTS_SUPPORT_RAYS_H

#include "tests/support/fixture.h"

#include <meshtool/surface_tree.h>

/* A mesh with its triangulation, its tree, and its triangles loaded for a profile. */
typedef struct test_target {
    mt_context *context;
    mt_mesh *mesh; /* owned */
    mt_triangulation triangulation;
    mt_surface_tree *tree;
    mt_ray_profile profile;
    mt_ray_triangle *triangles;
} test_target;

/* Takes the mesh over; checks the tree's invariants. The target is not to be moved. */
void test_target_init(test_target *target, mt_context *context, mt_mesh *mesh, mt_ray_profile profile);
void test_target_end(test_target *target);

/* The nearest hit, equal t the lowest triangle, by asking every triangle. */
mt_ray_hit test_brute_force(const test_target *target, const mt_ray *ray);

/* A ray towards the mesh: from outside or inside, often along an axis, at a vertex or at the middle of an edge. */
mt_ray test_random_ray(const test_target *target, test_random *random);

/* Shoots `count` such rays both ways; returns for how many the two answers differ in triangle, t or weights, or a query
 * for any hit disagrees. */
uint64_t test_count_differences(const test_target *target, uint64_t count, uint64_t seed);

/* The ray number `number` of a probe for leaks: from near an inside point at a vertex, or at the middle of a side. */
mt_ray test_probe_ray(const test_target *target, mt_vec3 inside, double jitter, bool at_edges, uint64_t number,
                      test_random *random);

/* Shoots from an inside point at every vertex, or at the middle of every side of a triangle, until `count` rays were
 * shot, from points jittered around it; returns how many hit nothing. */
uint64_t test_count_misses(const test_target *target, mt_vec3 inside, double jitter, bool at_edges, uint64_t count);

/* Fewer where a sanitizer makes everything slow. */
uint64_t test_ray_count(uint64_t count);

#endif
