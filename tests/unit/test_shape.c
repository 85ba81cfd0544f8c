/* Planes, spheres and triangles against what their equations say, in long double, over random rays; and a fine torus
 * against the roots of its quartic. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/ray_structure.h>
#include <meshtool/shape.h>
#include <meshtool/transform.h>

#include <math.h>

static double spread(test_random *random, double size)
{
    return size * (2 * test_random_unit(random) - 1);
}

static mt_vec3 somewhere(test_random *random, double size)
{
    double x = spread(random, size), y = spread(random, size), z = spread(random, size);
    return mt_vec3_make(x, y, z);
}

static void planes_are_where_they_say(void **state)
{
    (void)state;
    test_random random = {1};
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        mt_plane plane = {somewhere(&random, 2), somewhere(&random, 1)};
        mt_ray ray = mt_ray_make(somewhere(&random, 3), somewhere(&random, 1));
        double t = NAN;
        bool is_hit = mt_plane_hit(&plane, &ray, &t);
        double above = mt_vec3_dot(plane.normal, mt_vec3_subtract(ray.origin, plane.point));
        double toward = mt_vec3_dot(plane.normal, ray.direction);
        assert_int_equal(is_hit, above * toward < 0);
        if (is_hit) {
            mt_vec3 p = mt_ray_at(&ray, t);
            double off = mt_vec3_dot(mt_plane_normal(&plane), mt_vec3_subtract(p, plane.point));
            assert_true(fabs(off) < 1e-13 * (4 + t * mt_vec3_length(ray.direction)));
            hits++;
        }
        mt_vec3 foot = mt_plane_closest(&plane, ray.origin), way = mt_vec3_subtract(ray.origin, foot);
        assert_true(fabs(mt_vec3_dot(plane.normal, mt_vec3_subtract(foot, plane.point))) < 1e-12);
        assert_true(mt_vec3_length(mt_vec3_cross(way, mt_plane_normal(&plane))) < 1e-12);
    }
    assert_true(hits > 8000);
    mt_plane flat = {{1, 2, 3}, {0, -4, 0}};
    mt_bounds bounds = mt_plane_bounds(&flat);
    assert_true(bounds.minimum.y == 2 && bounds.maximum.y == 2 && isinf(bounds.minimum.x) && isinf(bounds.maximum.z));
    mt_ray within = mt_ray_make(mt_vec3_make(0, 2, 0), mt_vec3_make(1, 0, 1));
    double t;
    assert_false(mt_plane_hit(&flat, &within, &t));
}

/* The roots of |o + t d - c|^2 = r^2, by the textbook in long double; returns how many. */
static int sphere_roots(const mt_sphere *s, const mt_ray *ray, long double roots[2])
{
    long double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    long double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    long double c[3] = {s->center.x, s->center.y, s->center.z}, a = 0, b = 0, e = 0;
    for (int i = 0; i < 3; i++) {
        a += d[i] * d[i];
        b += d[i] * (o[i] - c[i]);
        e += (o[i] - c[i]) * (o[i] - c[i]);
    }
    long double discriminant = b * b - a * (e - (long double)s->radius * s->radius);
    if (discriminant < 0) {
        return 0;
    }
    roots[0] = (-b - sqrtl(discriminant)) / a;
    roots[1] = (-b + sqrtl(discriminant)) / a;
    return 2;
}

static void check_sphere(const mt_sphere *sphere, const mt_ray *ray, double tolerance, int *hits)
{
    long double roots[2];
    double t = NAN;
    int count = sphere_roots(sphere, ray, roots);
    bool is_hit = mt_sphere_hit(sphere, ray, &t);
    long double expected = count == 0 ? -1 : roots[0] >= 0 ? roots[0] : roots[1];
    if (expected < 0) {
        assert_false(is_hit);
        return;
    }
    mt_vec3 p = mt_ray_at(ray, t);
    double miss = mt_vec3_length(mt_vec3_subtract(p, sphere->center)) / sphere->radius - 1;
    assert_true(is_hit);
    if (!(fabs(miss) < tolerance)) {
        fail_msg("the hit is %g radii beside a sphere of radius %g at t %g", miss, sphere->radius, t);
    }
    (*hits)++;
}

static void spheres_are_where_they_say(void **state)
{
    (void)state;
    test_random random = {2};
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        mt_sphere sphere = {somewhere(&random, 2), 0.01 + test_random_unit(&random)};
        mt_vec3 from = somewhere(&random, 3), aim = mt_vec3_add(sphere.center, somewhere(&random, 1.5));
        mt_ray ray = mt_ray_make(from, mt_vec3_subtract(aim, from));
        long double roots[2];
        if (sphere_roots(&sphere, &ray, roots) == 2 && fabsl(roots[1] - roots[0]) < 1e-5L * fabsl(roots[1])) {
            continue; /* grazing: rounding decides */
        }
        check_sphere(&sphere, &ray, 1e-10, &hits);
        mt_vec3 near = mt_sphere_closest(&sphere, ray.origin);
        double distance = mt_vec3_length(mt_vec3_subtract(near, ray.origin));
        double center = mt_vec3_length(mt_vec3_subtract(sphere.center, ray.origin));
        assert_true(fabs(distance - fabs(center - sphere.radius)) < 1e-13);
    }
    assert_true(hits > 2000);
    /* A ball of radius 1 a million away: the textbook in doubles would be off by a hundredth of it. */
    mt_sphere far = {{0, 0, 0}, 1};
    hits = 0;
    for (int i = 0; i < 1000; i++) {
        mt_vec3 from = mt_vec3_scale(mt_vec3_normalize(somewhere(&random, 1)), 1e6);
        mt_vec3 aim = mt_vec3_scale(mt_vec3_normalize(somewhere(&random, 1)), 0.5);
        mt_ray ray = mt_ray_make(from, mt_vec3_subtract(aim, from));
        check_sphere(&far, &ray, 1e-9, &hits);
    }
    assert_int_equal(hits, 1000);
}

static void rays_from_a_sphere_meet_it_once(void **state)
{
    (void)state;
    test_random random = {3};
    for (int i = 0; i < 20000; i++) {
        mt_sphere sphere = {somewhere(&random, 100), 0.01 + test_random_unit(&random)};
        mt_vec3 normal = mt_vec3_normalize(somewhere(&random, 1)), away = mt_vec3_normalize(somewhere(&random, 1));
        mt_ray ray = mt_ray_make(mt_vec3_add(sphere.center, mt_vec3_scale(normal, sphere.radius)), away);
        double t, cosine = mt_vec3_dot(normal, away);
        if (fabs(cosine) < 1e-9) {
            continue;
        }
        assert_int_equal(mt_sphere_hit_again(&sphere, &ray, &t), cosine < 0);
        if (cosine < 0) {
            assert_true(fabs(t + 2 * cosine * sphere.radius) < 1e-12);
        }
    }
}

static void triangles_are_where_they_say(void **state)
{
    (void)state;
    test_random random = {4};
    int hits = 0;
    for (int i = 0; i < 5000; i++) {
        mt_triangle triangle = {{somewhere(&random, 1), somewhere(&random, 1), somewhere(&random, 1)}};
        double u = test_random_unit(&random), v = test_random_unit(&random);
        bool inside = u + v < 1;
        mt_vec3 ab = mt_vec3_subtract(triangle.corners[1], triangle.corners[0]);
        mt_vec3 ac = mt_vec3_subtract(triangle.corners[2], triangle.corners[0]);
        mt_vec3 p = mt_vec3_add(triangle.corners[0], mt_vec3_add(mt_vec3_scale(ab, u), mt_vec3_scale(ac, v)));
        mt_vec3 from = mt_vec3_add(p, mt_vec3_scale(mt_triangle_normal(&triangle), 0.25 + test_random_unit(&random)));
        mt_ray ray = mt_ray_make(from, mt_vec3_subtract(p, from));
        double t = NAN;
        assert_int_equal(mt_triangle_hit(&triangle, &ray, &t), inside);
        assert_true(!inside || fabs(t - 1) < 1e-9);
        hits += inside;
        /* No point of a grid over the triangle is nearer than the closest one, which is one of the triangle. */
        mt_vec3 q = somewhere(&random, 1.5), near = mt_triangle_closest(&triangle, q);
        double least = mt_vec3_length(mt_vec3_subtract(near, q)), best = INFINITY;
        for (int a = 0; a <= 20; a++) {
            for (int b = 0; a + b <= 20; b++) {
                mt_vec3 g = mt_vec3_add(triangle.corners[0],
                                        mt_vec3_add(mt_vec3_scale(ab, a / 20.0), mt_vec3_scale(ac, b / 20.0)));
                best = fmin(best, mt_vec3_length(mt_vec3_subtract(g, q)));
            }
        }
        double step = fmax(mt_vec3_length(ab), mt_vec3_length(ac)) / 20;
        assert_true(least <= best + 1e-12 && least >= best - 2 * step);
        mt_bounds bounds = mt_triangle_bounds(&triangle);
        assert_true(near.x >= bounds.minimum.x - 1e-12 && near.x <= bounds.maximum.x + 1e-12);
    }
    assert_true(hits > 2000);
}

/* Of the torus around +Y, rings 1, tube 0.4, along the ray: (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2). */
static double torus_quartic(const mt_ray *ray, double t)
{
    mt_vec3 p = mt_ray_at(ray, t);
    double sum = mt_vec3_dot(p, p) + 1 - 0.16;
    return sum * sum - 4 * (p.x * p.x + p.z * p.z);
}

/* The first root after 0, by steps that are short beside the tube, then bisection; NAN: none. */
static double torus_root(const mt_ray *ray)
{
    const double step = 1e-3;
    for (double t = 0; t < 8; t += step) {
        if (torus_quartic(ray, t) > 0 && torus_quartic(ray, t + step) <= 0) {
            double low = t, high = t + step;
            for (int i = 0; i < 50; i++) {
                double middle = 0.5 * (low + high);
                *(torus_quartic(ray, middle) > 0 ? &low : &high) = middle;
            }
            return high;
        }
    }
    return NAN;
}

/* Facets of 2 pi / 800 lie up to R (1 - cos(pi / 800)) inside of the surface; a ray that is steep meets them at most
 * that over its cosine later. */
static void a_fine_torus_is_its_quartic(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    mt_triangulation triangulation;
    mt_ray_structure *structure = NULL;
    assert_int_equal(mt_generate(context, "torus", &(mt_generate_options){.resolution = 800}, &mesh), MT_OK);
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(
        mt_ray_structure_create(context, mesh, &triangulation, MT_RAY_STRUCTURE_AABB, MT_BUILD_BALANCED, &structure),
        MT_OK);
    test_random random = {5};
    int hits = 0, differ = 0;
    double worst = 0;
    for (int i = 0; i < 2000; i++) {
        mt_vec3 from = mt_vec3_scale(mt_vec3_normalize(somewhere(&random, 1)), 3), aim = somewhere(&random, 1.3);
        mt_ray ray = mt_ray_make(from, mt_vec3_normalize(mt_vec3_subtract(aim, from)));
        double t = torus_root(&ray);
        mt_ray_hit hit;
        bool is_hit = mt_ray_structure_nearest_hit(structure, &ray, MT_RAY_WATERTIGHT, &hit);
        if (is_hit != isfinite(t)) {
            differ++; /* at the rim, where the facets lie inside */
            continue;
        }
        if (is_hit) {
            mt_vec3 p = mt_ray_at(&ray, t);
            double ring = sqrt(p.x * p.x + p.z * p.z);
            mt_vec3 n = {p.x - p.x / ring, p.y, p.z - p.z / ring};
            double cosine = fabs(mt_vec3_dot(mt_vec3_normalize(n), ray.direction));
            worst = cosine > 0.2 ? fmax(worst, fabs(hit.t - t)) : worst;
            hits++;
        }
    }
    print_message("torus: %d hits, %d at the rim differ, t off by %.2g\n", hits, differ, worst);
    assert_true(hits > 1000 && differ < 10 && worst < 1e-4);
    mt_ray_structure_destroy(context, structure);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void transforms_are_undone(void **state)
{
    (void)state;
    test_random random = {6};
    for (int i = 0; i < 5000; i++) {
        mt_transform t = mt_transform_identity(), inverse;
        for (int k = 0; k < 9; k++) {
            t.linear[k / 3][k % 3] = spread(&random, 1);
        }
        t.translation = somewhere(&random, 10);
        if (!mt_transform_inverse(&t, &inverse)) {
            continue;
        }
        mt_transform both = mt_transform_then(&t, &inverse);
        double size = 0;
        for (int k = 0; k < 9; k++) {
            size = fmax(size, fabs(inverse.linear[k / 3][k % 3]));
        }
        for (int k = 0; k < 9; k++) {
            assert_true(fabs(both.linear[k / 3][k % 3] - (k % 4 == 0)) < 1e-13 * (1 + size * size));
        }
        assert_true(mt_vec3_max_abs(both.translation) < 1e-12 * (1 + size * size));
    }
    mt_transform t = mt_transform_scaling(2), inverse;
    assert_true(mt_transform_inverse(&t, &inverse) && inverse.linear[1][1] == 0.5 && inverse.linear[0][1] == 0);
    t = mt_transform_scaling(1e-200); /* its determinant underflows, and does not matter */
    assert_true(mt_transform_inverse(&t, &inverse) && inverse.linear[2][2] == 1e200);
    t = mt_transform_scaling(0);
    assert_false(mt_transform_inverse(&t, &inverse));
    t = mt_transform_identity();
    t.linear[2][0] = 1, t.linear[2][2] = 0; /* the third row is the first */
    assert_false(mt_transform_inverse(&t, &inverse));
    t = mt_transform_identity();
    t.translation.y = NAN;
    assert_false(mt_transform_inverse(&t, &inverse));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_where_they_say),       cmocka_unit_test(spheres_are_where_they_say),
        cmocka_unit_test(rays_from_a_sphere_meet_it_once), cmocka_unit_test(triangles_are_where_they_say),
        cmocka_unit_test(a_fine_torus_is_its_quartic),     cmocka_unit_test(transforms_are_undone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
