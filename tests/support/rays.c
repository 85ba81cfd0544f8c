#include "tests/support/unit.h"

#include "tests/support/rays.h"

#include <meshtool/clones.h>

#include <string.h>

void test_target_init(test_target *target, mt_context *context, mt_mesh *mesh, mt_ray_profile profile)
{
    *target = (test_target){.context = context, .mesh = mesh, .profile = profile};
    assert_int_equal(mt_triangulation_init(context, mesh, &target->triangulation), MT_OK);
    assert_int_equal(mt_surface_tree_create(context, mesh, &target->triangulation, NULL, &target->tree), MT_OK);
    assert_int_equal(mt_surface_tree_validate(context, target->tree), MT_OK);
    mt_index count = target->triangulation.triangle_count;
    target->triangles = mt_allocate_array(context, count, sizeof *target->triangles);
    assert_non_null(target->triangles);
    for (mt_index i = 0; i < count; i++) {
        mt_ray_triangle_load(mt_surface_tree_space(target->tree), mesh, &target->triangulation, i, profile,
                             &target->triangles[i]);
    }
}

void test_target_end(test_target *target)
{
    mt_free(target->context, target->triangles);
    mt_surface_tree_destroy(target->context, target->tree);
    mt_triangulation_release(target->context, &target->triangulation);
    mt_mesh_destroy(target->context, target->mesh);
}

mt_ray_hit test_brute_force(const test_target *target, const mt_ray *ray)
{
    mt_ray_setup setup;
    mt_ray_setup_init(mt_surface_tree_space(target->tree), ray, target->profile, &setup);
    mt_ray_hit best = mt_ray_no_hit(), hit;
    for (mt_index i = 0; i < target->triangulation.triangle_count; i++) {
        if (mt_ray_hit_triangle(&setup, &target->triangles[i], i, &hit) && mt_ray_hit_is_nearer(&hit, &best)) {
            best = hit;
        }
    }
    return best;
}

static mt_vec3 point_near(const mt_bounds *bounds, test_random *random, double reach)
{
    mt_vec3 middle = mt_vec3_scale(mt_vec3_add(bounds->minimum, bounds->maximum), 0.5);
    mt_vec3 half = mt_vec3_scale(mt_vec3_subtract(bounds->maximum, bounds->minimum), 0.5);
    double size = mt_vec3_max_abs(half) * reach;
    return mt_vec3_make(middle.x + size * (2 * test_random_unit(random) - 1),
                        middle.y + size * (2 * test_random_unit(random) - 1),
                        middle.z + size * (2 * test_random_unit(random) - 1));
}

static mt_vec3 corner_of(const test_target *target, mt_index triangle, mt_index side)
{
    mt_index corner = mt_triangulation_corner(&target->triangulation, triangle, side);
    return mt_mesh_position(target->mesh, target->mesh->corner_vertices[corner]);
}

static mt_vec3 halfway(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_add(mt_vec3_scale(a, 0.5), mt_vec3_scale(b, 0.5));
}

mt_ray test_random_ray(const test_target *target, test_random *random)
{
    mt_bounds bounds = mt_mesh_bounds(target->mesh);
    mt_index count = target->triangulation.triangle_count;
    mt_vec3 origin = point_near(&bounds, random, test_random_below(random, 3) ? 3 : 0.9);
    mt_vec3 aim = point_near(&bounds, random, 1);
    uint64_t kind = test_random_below(random, 8);
    if (count && kind < 4) {
        mt_index triangle = (mt_index)test_random_below(random, count);
        mt_index side = (mt_index)test_random_below(random, 3);
        aim = corner_of(target, triangle, side);
        aim = kind < 2 ? halfway(aim, corner_of(target, triangle, (side + 1) % 3)) : aim;
    }
    if (test_random_below(random, 4) == 0) {
        /* along an axis, or in a plane of two */
        double *to = &aim.x, *from = &origin.x;
        uint64_t axis = test_random_below(random, 3);
        from[axis] = to[axis];
        if (test_random_below(random, 2)) {
            from[(axis + 1) % 3] = to[(axis + 1) % 3];
        }
    }
    mt_ray ray = mt_ray_make(origin, mt_vec3_subtract(aim, origin));
    if (test_random_below(random, 8) == 0) {
        ray.t_minimum = 1;
    }
    return ray;
}

static bool is_same_hit(const mt_ray_hit *a, const mt_ray_hit *b)
{
    return a->triangle == b->triangle && a->t == b->t && memcmp(a->weights, b->weights, sizeof a->weights) == 0;
}

typedef struct comparison {
    const test_target *target;
    uint64_t seed;
    uint64_t *differences; /* per block */
} comparison;

#define RAYS_A_BLOCK 4096

static void compare_rays(void *user, uint64_t begin, uint64_t end)
{
    const comparison *job = user;
    test_random random = {job->seed + begin};
    uint64_t count = 0;
    for (uint64_t i = begin; i < end; i++) {
        mt_ray ray = test_random_ray(job->target, &random);
        mt_ray_hit expected = test_brute_force(job->target, &ray), hit;
        bool found = mt_surface_tree_nearest_hit(job->target->tree, &ray, job->target->profile, &hit);
        bool any = mt_surface_tree_any_hit(job->target->tree, &ray, job->target->profile);
        count += !is_same_hit(&hit, &expected) || found != (expected.triangle != MT_NONE) || any != found;
    }
    job->differences[begin / RAYS_A_BLOCK] = count;
}

uint64_t test_count_differences(const test_target *target, uint64_t count, uint64_t seed)
{
    uint64_t blocks = count / RAYS_A_BLOCK + 1, sum = 0;
    comparison job = {target, seed, mt_allocate_array_zeroed(target->context, blocks, sizeof(uint64_t))};
    assert_non_null(job.differences);
    mt_parallel_for(target->context, count, RAYS_A_BLOCK, compare_rays, &job);
    for (uint64_t i = 0; i < blocks; i++) {
        sum += job.differences[i];
    }
    mt_free(target->context, job.differences);
    return sum;
}

mt_ray test_probe_ray(const test_target *target, mt_vec3 inside, double jitter, bool at_edges, uint64_t number,
                      test_random *random)
{
    mt_index corners = 3 * target->triangulation.triangle_count, corner = (mt_index)(number % corners);
    mt_vec3 aim = corner_of(target, corner / 3, corner % 3);
    aim = at_edges ? halfway(aim, corner_of(target, corner / 3, (corner % 3 + 1) % 3)) : aim;
    inside.x += jitter * (test_random_unit(random) - 0.5);
    inside.y += jitter * (test_random_unit(random) - 0.5);
    inside.z += jitter * (test_random_unit(random) - 0.5);
    return mt_ray_make(inside, mt_vec3_subtract(aim, inside));
}

uint64_t test_count_misses(const test_target *target, mt_vec3 inside, double jitter, bool at_edges, uint64_t count)
{
    test_random random = {count};
    uint64_t misses = 0;
    for (uint64_t i = 0; i < count; i++) {
        mt_ray ray = test_probe_ray(target, inside, jitter, at_edges, i, &random);
        mt_ray_hit hit;
        misses += !mt_surface_tree_nearest_hit(target->tree, &ray, target->profile, &hit);
    }
    return misses;
}

uint64_t test_ray_count(uint64_t count)
{
#ifdef MT_SANITIZED
    return count / 50 + 1;
#else
    return count;
#endif
}
