/* Triangles seen from their side, or nearly so: their areas are as small as what rounding takes from them. What a hit
 * says must still lie on the ray, or a structure culls the box that holds it. */
#include "tests/support/unit.h"

#include "tests/support/structures.h"

#include <string.h>

#define TRIANGLES 48

static mt_vec3 random_point(test_random *random)
{
    return mt_vec3_make(2 * test_random_unit(random) - 1, 2 * test_random_unit(random) - 1,
                        2 * test_random_unit(random) - 1);
}

/* One in two is a needle. */
static mt_mesh *crossing_triangles(mt_context *context, test_random *random)
{
    double positions[9 * TRIANGLES];
    mt_index faces[4 * TRIANGLES];
    for (mt_index i = 0; i < TRIANGLES; i++) {
        mt_vec3 a = random_point(random), b = random_point(random), c = random_point(random);
        if (i % 2) {
            double width = ldexp(1, -(int)test_random_below(random, 24));
            c = mt_vec3_add(mt_vec3_scale(mt_vec3_add(a, b), 0.5), mt_vec3_scale(c, width));
        }
        const mt_vec3 corners[3] = {a, b, c};
        memcpy(positions + 9 * i, corners, sizeof corners);
        const mt_index face[4] = {3, 3 * i, 3 * i + 1, 3 * i + 2};
        memcpy(faces + 4 * i, face, sizeof face);
    }
    return test_mesh(context, 3 * TRIANGLES, positions, TRIANGLES, faces);
}

/* Through a point of the triangle, along its plane but for a tilt of 2^-20 to 2^-59, from near or far. */
static mt_ray ray_along(const test_target *target, mt_index number, test_random *random)
{
    const mt_ray_triangle *triangle = &target->triangles[number];
    const mt_ray_space *space = mt_surface_tree_space(target->tree);
    mt_vec3 corners[3], point, direction;
    for (int i = 0; i < 3; i++) {
        const double *p = triangle->corners[i];
        corners[i] = mt_vec3_scale(mt_vec3_add(mt_vec3_make(p[0], p[1], p[2]), space->center), 1 / space->scale);
    }
    mt_vec3 ab = mt_vec3_subtract(corners[1], corners[0]), ac = mt_vec3_subtract(corners[2], corners[0]);
    double u = test_random_unit(random), v = test_random_unit(random) * (1 - u);
    point = mt_vec3_add(corners[0], mt_vec3_add(mt_vec3_scale(ab, u), mt_vec3_scale(ac, v)));
    direction = mt_vec3_add(mt_vec3_scale(ab, 2 * test_random_unit(random) - 1),
                            mt_vec3_scale(ac, 2 * test_random_unit(random) - 1));
    double tilt = ldexp(test_random_unit(random) - 0.5, -20 - (int)test_random_below(random, 40));
    direction = mt_vec3_add(direction, mt_vec3_scale(mt_vec3_normalize(mt_vec3_cross(ab, ac)), tilt));
    double back = ldexp(1, (int)test_random_below(random, 3));
    return mt_ray_make(mt_vec3_subtract(point, mt_vec3_scale(direction, back)), direction);
}

/* How far the point that the weights make lies off the one that t makes, on an axis, in space. */
static double gap_of(const mt_ray_setup *setup, const mt_ray_triangle *triangle, const mt_ray_hit *hit)
{
    long double parameter = (long double)hit->t * (long double)setup->parameter_factor - (long double)setup->begin;
    long double largest = 0;
    for (int i = 0; i < 3; i++) {
        long double by_weights = 0, by_t = (long double)setup->origin[i] + parameter * (long double)setup->direction[i];
        for (int corner = 0; corner < 3; corner++) {
            by_weights += (long double)hit->weights[corner] * (long double)triangle->corners[corner][setup->axes[i]];
        }
        long double gap = by_weights > by_t ? by_weights - by_t : by_t - by_weights;
        largest = gap > largest ? gap : largest;
    }
    return (double)largest;
}

static void expect_hits_on_the_ray(const test_target *target, const mt_ray *ray, mt_index number, uint64_t *hit_count)
{
    mt_ray_setup setup;
    mt_ray_hit hit;
    mt_ray_setup_init(mt_surface_tree_space(target->tree), ray, target->profile, &setup);
    if (mt_ray_hit_triangle(&setup, &target->triangles[number], number, &hit)) {
        double gap = gap_of(&setup, &target->triangles[number], &hit);
        if (gap > 1.25 * (double)setup.slack) {
            fail_msg("the hit of triangle %u lies %g off the ray, whose slack is %g", number, gap, (double)setup.slack);
        }
        ++*hit_count;
    }
}

static void expect_sound_hits(mt_ray_profile profile, uint64_t seed)
{
    test_random random = {seed};
    uint64_t hit_count = 0, ray_count = test_ray_count(5000);
    for (int round = 0; round < 20; round++) {
        mt_context *context = test_context();
        test_structures structures;
        test_structures_init(&structures, context, crossing_triangles(context, &random), profile);
        for (uint64_t i = 0; i < ray_count; i++) {
            mt_index number = (mt_index)test_random_below(&random, TRIANGLES);
            mt_ray ray = ray_along(&structures.target, number, &random);
            expect_hits_on_the_ray(&structures.target, &ray, number, &hit_count);
            test_structures_agree_on(&structures, "crossing triangles", &ray);
        }
        test_structures_end(&structures);
        test_context_end(context);
    }
    print_message("%llu of %llu rays met the triangle that they run along\n", (unsigned long long)hit_count,
                  (unsigned long long)(20 * ray_count));
    assert_true(hit_count > 2 * ray_count);
}

static void watertight_hits_lie_on_the_ray(void **state)
{
    (void)state;
    expect_sound_hits(MT_RAY_WATERTIGHT, 21);
}

static void exact_hits_lie_on_the_ray(void **state)
{
    (void)state;
    expect_sound_hits(MT_RAY_EXACT, 22);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(watertight_hits_lie_on_the_ray),
        cmocka_unit_test(exact_hits_lie_on_the_ray),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
