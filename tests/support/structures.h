/* Every structure that rays can search, over one mesh, beside brute force. */
#ifndef TESTS_SUPPORT_STRUCTURES_H
#define TESTS_SUPPORT_STRUCTURES_H

#include "tests/support/rays.h"

#include <meshtool/ray_structure.h>

/* One of each kind at the quality that all have, then the tree of boxes at each other quality. */
#define TEST_STRUCTURE_COUNT (MT_RAY_STRUCTURE_COUNT + 1)
#define TEST_STRUCTURE_FAST MT_RAY_STRUCTURE_COUNT
const char *test_structure_name(int which);

typedef struct test_structures {
    test_target target;
    mt_ray_structure *all[TEST_STRUCTURE_COUNT];
} test_structures;

/* Takes the mesh over; checks each structure's invariants. Not to be moved. */
void test_structures_init(test_structures *structures, mt_context *context, mt_mesh *mesh, mt_ray_profile profile);
void test_structures_end(test_structures *structures);

/* A ray in the plane of a triangle or off it by a hair: along it, or aimed at a point of it. */
mt_ray test_grazing_ray(const test_target *target, test_random *random);

/* Shoots `count` rays, random ones and grazing ones in turn, through every structure and by brute force; fails the
 * test, with the structure's name and the ray, where the two differ in triangle, t or weights, or a query for any hit
 * disagrees. */
void test_structures_agree(const test_structures *structures, const char *mesh, uint64_t count, uint64_t seed);

/* The same, but only every `brute_step`th ray is tried on all triangles; of the others the structures are compared with
 * the aabb tree. An odd step tries rays of both kinds. */
void test_structures_agree_by_samples(const test_structures *structures, const char *mesh, uint64_t count,
                                      uint64_t seed, uint64_t brute_step);

/* The same for one ray. */
void test_structures_agree_on(const test_structures *structures, const char *mesh, const mt_ray *ray);

/* Shoots `count` rays from near an inside point at every vertex, then at the middle of every side of a triangle; fails
 * the test where a structure lets one through. */
void test_structures_are_tight(const test_structures *structures, const char *mesh, mt_vec3 inside, double jitter,
                               uint64_t count);

#endif
