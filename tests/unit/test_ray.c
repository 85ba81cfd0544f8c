/* The one hit function: known hits, the adversarial places (edges, vertices, planes, axes), and its accuracy. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/ray.h>

#include <string.h>

static const mt_ray_profile profiles[] = {MT_RAY_WATERTIGHT, MT_RAY_FAST, MT_RAY_EXACT};

static const mt_ray_space unit_space = {{0, 0, 0}, 1};

static mt_ray_triangle triangle_of(const double corners[9])
{
    mt_ray_triangle triangle;
    memcpy(triangle.corners, corners, sizeof triangle.corners);
    return triangle;
}

static bool shoot(mt_ray_profile profile, mt_ray ray, const double corners[9], mt_ray_hit *hit)
{
    mt_ray_setup setup;
    mt_ray_setup_init(&unit_space, &ray, profile, &setup);
    mt_ray_triangle triangle = triangle_of(corners);
    *hit = mt_ray_no_hit();
    return mt_ray_hit_triangle(&setup, &triangle, 0, hit);
}

static mt_ray ray_from_to(double ox, double oy, double oz, double x, double y, double z)
{
    return mt_ray_make(mt_vec3_make(ox, oy, oz), mt_vec3_make(x - ox, y - oy, z - oz));
}

static void known_hits_are_found_by_all_profiles(void **state)
{
    (void)state;
    const double flat[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (size_t i = 0; i < 3; i++) {
        mt_ray_hit hit;
        assert_true(shoot(profiles[i], ray_from_to(0.25, 0.5, 1, 0.25, 0.5, 0), flat, &hit));
        assert_true(fabs(hit.t - 1) < 1e-6 && fabs(hit.weights[0] - 0.25) < 1e-6 && fabs(hit.weights[1] - 0.25) < 1e-6);
        assert_true(fabs(hit.weights[2] - 0.5) < 1e-6);
        assert_true(shoot(profiles[i], ray_from_to(0.25, 0.5, -3, 0.25, 0.5, 0), flat, &hit));
        assert_false(shoot(profiles[i], ray_from_to(0.25, 0.5, -3, 0.25, 0.5, -4), flat, &hit));
        assert_false(shoot(profiles[i], ray_from_to(0.75, 0.5, 1, 0.75, 0.5, 0), flat, &hit));
        /* in its plane: a miss */
        assert_false(shoot(profiles[i], ray_from_to(-1, 0.25, 0, 1, 0.25, 0), flat, &hit));
    }
}

static void t_counts_in_directions_and_keeps_its_range(void **state)
{
    (void)state;
    const double flat[9] = {-1, -1, 0.5, 1, -1, 0.5, 0, 1, 0.5};
    for (size_t i = 0; i < 3; i++) {
        mt_ray ray = mt_ray_make(mt_vec3_make(0, 0, -2.5), mt_vec3_make(0, 0, 1e-3));
        mt_ray_hit hit;
        assert_true(shoot(profiles[i], ray, flat, &hit));
        assert_true(fabs(hit.t - 3000) < 1e-2);
        ray.t_maximum = 2999;
        assert_false(shoot(profiles[i], ray, flat, &hit));
        ray.t_maximum = INFINITY, ray.t_minimum = 3001;
        assert_false(shoot(profiles[i], ray, flat, &hit));
        ray.t_minimum = 0, ray.skip = 0;
        assert_false(shoot(profiles[i], ray, flat, &hit));
    }
}

static void what_is_not_finite_is_never_hit(void **state)
{
    (void)state;
    const double flat[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 3; i++) {
        for (size_t b = 0; b < 3; b++) {
            mt_ray_hit hit;
            for (int at = 0; at < 9; at++) {
                double corners[9];
                memcpy(corners, flat, sizeof corners);
                corners[at] = bad[b];
                assert_false(shoot(profiles[i], ray_from_to(0, 0, 1, 0, 0, 0), corners, &hit));
            }
            assert_false(shoot(profiles[i], ray_from_to(0, bad[b], 1, 0, 0, 0), flat, &hit));
        }
        mt_ray_hit hit;
        assert_false(shoot(profiles[i], ray_from_to(0, 0, 0, 0, 0, 0), flat, &hit));
    }
}

/* Random fans around a random vertex seen from afar: a ray aimed at the vertex, or at a spoke, hits one of them. */
static void no_ray_slips_through_a_fan(void **state)
{
    (void)state;
    test_random random = {1};
    for (int round = 0; round < 20000; round++) {
        double rim[5][3], hub[3] = {0, 0, 0.3 * test_random_unit(&random)};
        for (int i = 0; i < 5; i++) {
            static const double circle[5][2] = {
                {1, 0}, {0.309, 0.951}, {-0.809, 0.588}, {-0.809, -0.588}, {0.309, -0.951}};
            rim[i][0] = circle[i][0] * (0.1 + test_random_unit(&random));
            rim[i][1] = circle[i][1] * (0.1 + test_random_unit(&random));
            rim[i][2] = test_random_unit(&random) - 0.5;
        }
        double along = round % 2 ? test_random_unit(&random) * 0.999 : 0;
        const double *spoke = rim[round % 5];
        mt_ray ray = ray_from_to(test_random_unit(&random) * 0.2, test_random_unit(&random) * 0.2, 3,
                                 hub[0] + along * (spoke[0] - hub[0]), hub[1] + along * (spoke[1] - hub[1]),
                                 hub[2] + along * (spoke[2] - hub[2]));
        for (size_t p = 0; p < 3; p += 2) {
            bool hit = false;
            for (int i = 0; i < 5; i++) {
                const double *a = rim[i], *b = rim[(i + 1) % 5];
                double corners[9] = {hub[0], hub[1], hub[2], a[0], a[1], a[2], b[0], b[1], b[2]};
                for (int c = 0; c < 9; c++) {
                    corners[c] = p == 2 ? corners[c] : (double)(float)corners[c];
                }
                mt_ray_hit found;
                hit |= shoot(profiles[p], ray, corners, &found);
            }
            assert_true(hit);
        }
    }
}

/* Grazing rays: t against the closed form of the plane z = 0 with the triangle's corners on it. */
static void grazing_hits_stay_within_the_stated_error(void **state)
{
    (void)state;
    test_random random = {2};
    const double flat[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    for (int round = 0; round < 10000; round++) {
        double height = ldexp(0.5 + test_random_unit(&random), -(int)test_random_below(&random, 30));
        mt_ray ray = mt_ray_make(mt_vec3_make(-0.3, 0.01, height), mt_vec3_make(1, 0.1, -height / 0.3));
        for (size_t p = 0; p < 3; p += 2) {
            mt_ray_setup setup;
            mt_ray_setup_init(&unit_space, &ray, profiles[p], &setup);
            mt_ray_triangle triangle = triangle_of(flat);
            mt_ray_hit hit;
            assert_true(mt_ray_hit_triangle(&setup, &triangle, 0, &hit));
            assert_true(fabs(hit.t - 0.3) <= mt_ray_hit_error(&setup, &triangle) + 1e-15);
        }
    }
}

static void far_and_tiny_meshes_have_a_space(void **state)
{
    (void)state;
    const double magnitudes[] = {1e-300, 1e-150, 1e-30, 1, 1e30, 1e150, 1e300};
    for (size_t m = 0; m < sizeof magnitudes / sizeof *magnitudes; m++) {
        mt_context *context = test_context();
        double s = magnitudes[m];
        const double positions[] = {1 * s, 0, 0, 2 * s, 0, 0, 1 * s, 1 * s, 0};
        mt_mesh *mesh = test_mesh(context, 3, positions, 1, (const mt_index[]){3, 0, 1, 2});
        mt_triangulation triangulation;
        assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
        mt_ray_space space = mt_ray_space_of(mesh);
        mt_ray ray = mt_ray_make(mt_vec3_make(1.25 * s, 0.25 * s, 1 * s), mt_vec3_make(0, 0, -s));
        for (size_t p = 0; p < 3; p++) {
            mt_ray_setup setup;
            mt_ray_triangle triangle;
            mt_ray_hit hit;
            mt_ray_setup_init(&space, &ray, profiles[p], &setup);
            mt_ray_triangle_load(&space, mesh, &triangulation, 0, profiles[p], &triangle);
            assert_true(mt_ray_hit_triangle(&setup, &triangle, 0, &hit));
            assert_true(fabs(hit.t - 1) < 1e-6);
        }
        mt_triangulation_release(context, &triangulation);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* Rays that start on a triangle do not meet it again when moved off it, and still meet a wall 4e-5 behind it. */
static void secondary_rays_clear_their_face_and_no_wall(void **state)
{
    (void)state;
    test_random random = {3};
    for (int round = 0; round < 20000; round++) {
        double x = 2 * test_random_unit(&random) - 1, y = 2 * test_random_unit(&random) - 1;
        double slope = test_random_unit(&random);
        double corners[9] = {-1, -1, (double)(float)-slope, 1, -1, (double)(float)-slope, 0, 1, (double)(float)slope};
        double wall[9];
        for (int i = 0; i < 9; i++) {
            wall[i] = corners[i] + (i % 3 == 2 ? 4e-5 * sqrt(1 + slope * slope) : 0);
        }
        mt_ray_hit hit, again;
        mt_ray down = ray_from_to(x, y, 1, x * 0.5, y * 0.5, -1);
        if (!shoot(MT_RAY_WATERTIGHT, down, corners, &hit)) {
            continue;
        }
        mt_vec3 normal = mt_vec3_make(0, -slope, 1);
        mt_vec3 start = mt_ray_offset(&unit_space, mt_ray_at(&down, hit.t), normal);
        mt_vec3 up = mt_vec3_make(test_random_unit(&random) - 0.5, test_random_unit(&random) - 0.5, 0);
        up.z = slope * up.y + 0.01 + test_random_unit(&random);
        assert_false(shoot(MT_RAY_WATERTIGHT, mt_ray_make(start, up), corners, &again));
        mt_ray straight = mt_ray_make(start, normal);
        bool inside = hit.weights[0] > 1e-3 && hit.weights[1] > 1e-3 && hit.weights[2] > 1e-3;
        assert_true(!inside || shoot(MT_RAY_WATERTIGHT, straight, wall, &again));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_hits_are_found_by_all_profiles),
        cmocka_unit_test(t_counts_in_directions_and_keeps_its_range),
        cmocka_unit_test(what_is_not_finite_is_never_hit),
        cmocka_unit_test(no_ray_slips_through_a_fan),
        cmocka_unit_test(grazing_hits_stay_within_the_stated_error),
        cmocka_unit_test(far_and_tiny_meshes_have_a_space),
        cmocka_unit_test(secondary_rays_clear_their_face_and_no_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
