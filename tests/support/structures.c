#include "tests/support/unit.h"

#include "tests/support/structures.h"

#include <string.h>

const char *test_structure_name(int which)
{
    return which == TEST_STRUCTURE_FAST ? "aabb, built fast" : mt_ray_structure_name((mt_ray_structure_kind)which);
}

void test_structures_init(test_structures *structures, mt_context *context, mt_mesh *mesh, mt_ray_profile profile)
{
    test_target_init(&structures->target, context, mesh, profile);
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        mt_ray_structure **structure = &structures->all[kind];
        bool is_fast = kind == TEST_STRUCTURE_FAST;
        assert_int_equal(mt_ray_structure_create(context, mesh, &structures->target.triangulation,
                                                 is_fast ? MT_RAY_STRUCTURE_AABB : (mt_ray_structure_kind)kind,
                                                 is_fast ? MT_BUILD_FAST : MT_BUILD_BALANCED, structure),
                         MT_OK);
        if (mt_ray_structure_validate(context, *structure) != MT_OK) {
            fail_msg("%s: %s", test_structure_name(kind), mt_context_error(context)->message);
        }
    }
}

void test_structures_end(test_structures *structures)
{
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        mt_ray_structure_destroy(structures->target.context, structures->all[kind]);
    }
    test_target_end(&structures->target);
}

/* A point of the triangle's plane, within a few times its size; on a side or at a corner one time in two. */
static mt_vec3 point_in_plane(const mt_vec3 corners[3], test_random *random)
{
    double a = 3 * test_random_unit(random) - 1, b = 3 * test_random_unit(random) - 1;
    if (test_random_below(random, 2)) {
        a = (double)test_random_below(random, 2), b = test_random_below(random, 2) ? 0 : b;
    }
    mt_vec3 ab = mt_vec3_subtract(corners[1], corners[0]), ac = mt_vec3_subtract(corners[2], corners[0]);
    return mt_vec3_add(corners[0], mt_vec3_add(mt_vec3_scale(ab, a), mt_vec3_scale(ac, b)));
}

mt_ray test_grazing_ray(const test_target *target, test_random *random)
{
    const mt_triangulation *triangulation = &target->triangulation;
    mt_index triangle = (mt_index)test_random_below(random, triangulation->triangle_count);
    mt_vec3 corners[3];
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, side);
        corners[side] = mt_mesh_position(target->mesh, target->mesh->corner_vertices[corner]);
    }
    mt_vec3 ab = mt_vec3_subtract(corners[1], corners[0]), ac = mt_vec3_subtract(corners[2], corners[0]);
    mt_vec3 normal = mt_vec3_scale(mt_vec3_normalize(mt_vec3_cross(ab, ac)), mt_vec3_length(ab));
    mt_vec3 from = point_in_plane(corners, random), to = point_in_plane(corners, random);
    if (test_random_below(random, 2)) {
        double off = ldexp(test_random_unit(random) - 0.5, -(int)test_random_below(random, 60));
        from = mt_vec3_add(from, mt_vec3_scale(normal, off));
    }
    return mt_ray_make(from, mt_vec3_subtract(to, from));
}

static bool is_same_hit(const mt_ray_hit *a, const mt_ray_hit *b)
{
    return a->triangle == b->triangle && a->t == b->t && memcmp(a->weights, b->weights, sizeof a->weights) == 0;
}

typedef struct difference {
    mt_ray ray;
    mt_ray_hit expected, hit;
    bool any;
    int kind;
} difference;

typedef struct comparison {
    const test_structures *structures;
    uint64_t seed;
    uint64_t brute_step; /* every so many rays are tried on all triangles, the others by the first tree's answer */
    uint64_t *counts;    /* per block */
    difference *firsts;  /* per block */
} comparison;

#define RAYS_A_BLOCK 1024

static mt_ray_hit expected_hit(const comparison *job, const mt_ray *ray, bool is_brute)
{
    const test_target *target = &job->structures->target;
    mt_ray_hit hit;
    if (is_brute) {
        return test_brute_force(target, ray);
    }
    return mt_ray_structure_nearest_hit(job->structures->all[MT_RAY_STRUCTURE_AABB], ray, target->profile, &hit)
               ? hit
               : mt_ray_no_hit();
}

static void compare_ray(const comparison *job, uint64_t block, const mt_ray *ray, bool is_brute)
{
    const test_target *target = &job->structures->target;
    mt_ray_hit expected = expected_hit(job, ray, is_brute);
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        mt_ray_hit hit;
        if (kind == MT_RAY_STRUCTURE_NONE && !is_brute) {
            continue;
        }
        bool found = mt_ray_structure_nearest_hit(job->structures->all[kind], ray, target->profile, &hit);
        bool any = mt_ray_structure_any_hit(job->structures->all[kind], ray, target->profile);
        if (!is_same_hit(&hit, &expected) || found != (expected.triangle != MT_NONE) || any != found) {
            job->firsts[block] =
                job->counts[block]++ ? job->firsts[block] : (difference){*ray, expected, hit, any, kind};
        }
    }
}

static void compare_rays(void *user, uint64_t begin, uint64_t end)
{
    const comparison *job = user;
    test_random random = {job->seed + begin};
    bool has_triangles = job->structures->target.triangulation.triangle_count > 0;
    for (uint64_t i = begin; i < end; i++) {
        mt_ray ray = has_triangles && i % 2 ? test_grazing_ray(&job->structures->target, &random)
                                            : test_random_ray(&job->structures->target, &random);
        compare_ray(job, begin / RAYS_A_BLOCK, &ray, i % job->brute_step == 0);
    }
}

static void print_difference(const char *mesh, const difference *d)
{
    print_error("%s, %s: from %.17g %.17g %.17g along %.17g %.17g %.17g: triangle %d at %.17g, expected %d at %.17g, "
                "any hit: %d\n",
                mesh, test_structure_name(d->kind), d->ray.origin.x, d->ray.origin.y, d->ray.origin.z,
                d->ray.direction.x, d->ray.direction.y, d->ray.direction.z, (int)d->hit.triangle, d->hit.t,
                (int)d->expected.triangle, d->expected.t, d->any);
}

void test_structures_agree(const test_structures *structures, const char *mesh, uint64_t count, uint64_t seed)
{
    test_structures_agree_by_samples(structures, mesh, count, seed, 1);
}

void test_structures_agree_by_samples(const test_structures *structures, const char *mesh, uint64_t count,
                                      uint64_t seed, uint64_t brute_step)
{
    mt_context *context = structures->target.context;
    uint64_t blocks = count / RAYS_A_BLOCK + 1, sum = 0;
    comparison job = {structures, seed, brute_step, mt_allocate_array_zeroed(context, blocks, sizeof(uint64_t)),
                      mt_allocate_array_zeroed(context, blocks, sizeof(difference))};
    assert_non_null(job.counts);
    assert_non_null(job.firsts);
    mt_parallel_for(context, count, RAYS_A_BLOCK, compare_rays, &job);
    for (uint64_t i = 0; i < blocks; i++) {
        if (job.counts[i] && sum < 10) {
            print_difference(mesh, &job.firsts[i]);
        }
        sum += job.counts[i];
    }
    mt_free(context, job.counts);
    mt_free(context, job.firsts);
    if (sum) {
        fail_msg("%s: %llu of %llu rays differ", mesh, (unsigned long long)sum, (unsigned long long)count);
    }
}

void test_structures_are_tight(const test_structures *structures, const char *mesh, mt_vec3 inside, double jitter,
                               uint64_t count)
{
    const test_target *target = &structures->target;
    test_random random = {count};
    uint64_t misses[TEST_STRUCTURE_COUNT] = {0}, sum = 0;
    for (uint64_t i = 0; i < count; i++) {
        mt_ray ray = test_probe_ray(target, inside, jitter, 2 * i >= count, i, &random);
        for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
            misses[kind] += !mt_ray_structure_any_hit(structures->all[kind], &ray, target->profile);
        }
    }
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        if (misses[kind]) {
            print_error("%s, %s: %llu of %llu rays leak\n", mesh, test_structure_name(kind),
                        (unsigned long long)misses[kind], (unsigned long long)count);
        }
        sum += misses[kind];
    }
    assert_int_equal(sum, 0);
}

void test_structures_agree_on(const test_structures *structures, const char *mesh, const mt_ray *ray)
{
    uint64_t count = 0;
    difference first = {.kind = 0};
    const comparison job = {structures, 0, 1, &count, &first};
    compare_ray(&job, 0, ray, true);
    if (count) {
        print_difference(mesh, &first);
        fail();
    }
}
