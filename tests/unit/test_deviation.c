/* Deviation against closed forms and dense sampling; its bounds; signed distance against closed forms. */
#include "tests/support/unit.h"

#include "tests/support/rays.h"
#include "tests/support/soup.h"
#include "tests/support/zoo.h"

#include <meshtool/deviation.h>
#include <meshtool/generate.h>
#include <meshtool/signed_distance.h>

#include <string.h>

static mt_mesh *generated(mt_context *context, const char *name, mt_index resolution)
{
    mt_generate_options options = {.resolution = resolution};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, &options, &mesh), MT_OK);
    return mesh;
}

static void move(mt_mesh *mesh, double scale, mt_vec3 by)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_add(mt_vec3_scale(mt_mesh_position(mesh, v), scale), by));
    }
}

static mt_mesh *square(mt_context *context, double size, double z)
{
    const double positions[] = {0, 0, z, size, 0, z, size, size, z, 0, size, z};
    return test_mesh(context, 4, positions, 1, (const mt_index[]){4, 0, 1, 2, 3});
}

static void parallel_squares_have_closed_forms(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *a = square(context, 1, 0), *b = square(context, 1, 0.25), *c = square(context, 2, 0);
    mt_deviation d;
    assert_int_equal(mt_measure_deviation(context, a, b, NULL, &d), MT_OK);
    assert_true(fabs(d.hausdorff - 0.25) < 1e-15 && d.hausdorff_error <= 1.001e-4 * d.diagonal &&
                fabs(d.a_to_b.mean - 0.25) < 1e-12);
    assert_true(fabs(d.b_to_a.rms - 0.25) < 1e-12 && d.a_to_b.normal_max < 1e-6);
    mt_deviation_release(context, &d);
    assert_int_equal(mt_measure_deviation(context, a, c, NULL, &d), MT_OK);
    assert_true(d.a_to_b.max < 1e-15 && d.a_to_b.mean < 1e-15 && fabs(d.b_to_a.max - sqrt(2)) < 1e-12);
    assert_true(fabs(d.diagonal - 2 * sqrt(2)) < 1e-12);
    /* over the large square: half of the strips' distances, and the corner's */
    double corner = 0.76519571646421; /* mean distance to a corner of the unit square */
    assert_true(fabs(d.b_to_a.mean - (0.5 + 0.5 + corner) / 4) < 2e-3);
    mt_deviation_release(context, &d);
    mt_mesh_destroy(context, a);
    mt_mesh_destroy(context, b);
    mt_mesh_destroy(context, c);
    test_context_end(context);
}

static void a_mesh_lies_on_itself_and_on_its_refinement(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *a = test_torus(context, 30, 20, true), *coarse = generated(context, "icosphere", 1);
    mt_deviation d;
    assert_int_equal(mt_measure_deviation(context, a, a, NULL, &d), MT_OK);
    assert_true(d.hausdorff < 1e-15 && d.hausdorff_error <= 1.001e-4 * d.diagonal && d.a_to_b.rms < 1e-12 &&
                d.a_to_b.normal_max < 1e-6);
    mt_deviation_release(context, &d);
    mt_mesh *fine = generated(context, "icosphere", 2);
    mt_deviation_options options = {.tolerance = 1e-6};
    assert_int_equal(mt_measure_deviation(context, fine, coarse, &options, &d), MT_OK);
    assert_true(d.hausdorff > 0 && d.hausdorff_error <= 1e-6);
    mt_deviation_release(context, &d);
    mt_mesh_destroy(context, a);
    mt_mesh_destroy(context, fine);
    mt_mesh_destroy(context, coarse);
    test_context_end(context);
}

/* The largest distance of points on a's triangles to b's, all asked of all. */
static double sample_densely(const test_target *a, const test_target *b, int n)
{
    double largest = 0;
    for (mt_index t = 0; t < a->triangulation.triangle_count; t++) {
        mt_vec3 p[3];
        for (mt_index side = 0; side < 3; side++) {
            mt_index corner = mt_triangulation_corner(&a->triangulation, t, side);
            p[side] = mt_mesh_position(a->mesh, a->mesh->corner_vertices[corner]);
        }
        for (int i = 0; i <= n; i++) {
            for (int j = 0; j <= n - i; j++) {
                double u = (double)i / n, v = (double)j / n;
                mt_vec3 at = mt_vec3_add(mt_vec3_scale(p[0], 1 - u - v),
                                         mt_vec3_add(mt_vec3_scale(p[1], u), mt_vec3_scale(p[2], v)));
                double nearest = INFINITY;
                for (mt_index s = 0; s < b->triangulation.triangle_count; s++) {
                    mt_closest closest;
                    mt_surface_element_closest(b->tree, s, at, &closest);
                    nearest = closest.distance < nearest ? closest.distance : nearest;
                }
                largest = nearest > largest ? nearest : largest;
            }
        }
    }
    return largest;
}

/* A few random triangles: the maximum mostly lies within one of them, equally far from two others. */
static mt_mesh *random_triangles(mt_context *context, test_random *random, mt_index count)
{
    double positions[9 * 8];
    mt_index faces[4 * 8];
    for (mt_index i = 0; i < 9 * count; i++) {
        positions[i] = test_random_unit(random);
    }
    for (mt_index i = 0; i < count; i++) {
        faces[4 * i] = 3, faces[4 * i + 1] = 3 * i, faces[4 * i + 2] = 3 * i + 1, faces[4 * i + 3] = 3 * i + 2;
    }
    return test_mesh(context, 3 * count, positions, count, faces);
}

static void maxima_lie_within_their_bounds(void **state)
{
    (void)state;
    test_random random = {31};
    for (int round = 0; round < 60; round++) {
        mt_context *context = test_context();
        test_target a, b;
        test_target_init(&a, context, random_triangles(context, &random, 3), MT_RAY_WATERTIGHT);
        test_target_init(&b, context, random_triangles(context, &random, 8), MT_RAY_WATERTIGHT);
        mt_deviation d;
        mt_deviation_options options = {.tolerance = 1e-5};
        assert_int_equal(mt_measure_deviation(context, a.mesh, b.mesh, &options, &d), MT_OK);
        double sampled = sample_densely(&a, &b, 20);
        assert_true(d.a_to_b.max_error <= 1e-5);
        assert_true(sampled <= d.a_to_b.max + d.a_to_b.max_error + 1e-12);
        assert_true(sampled > d.a_to_b.max - 0.1);
        mt_closest closest;
        assert_true(mt_surface_tree_closest(b.tree, d.a_to_b.from, NULL, &closest));
        assert_true(closest.distance == d.a_to_b.max);
        assert_true(mt_surface_tree_closest(a.tree, d.a_to_b.from, NULL, &closest) && closest.distance < 1e-12);
        mt_deviation_release(context, &d);
        test_target_end(&a);
        test_target_end(&b);
        test_context_end(context);
    }
}

static void spheres_of_two_sizes_differ_by_their_radii(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *a = generated(context, "icosphere", 5), *b = generated(context, "icosphere", 5);
    move(b, 1.25, mt_vec3_make(0, 0, 0));
    mt_bounds bounds = mt_mesh_bounds(a);
    double radius = bounds.maximum.y;
    mt_deviation_options options = {.keep_distances = true};
    mt_deviation d;
    assert_int_equal(mt_measure_deviation(context, a, b, &options, &d), MT_OK);
    assert_true(fabs(d.a_to_b.mean - 0.25 * radius) < 1e-3 * radius &&
                fabs(d.b_to_a.rms - 0.25 * radius) < 1e-3 * radius);
    assert_true(fabs(d.hausdorff - 0.25 * radius) < 1e-3 * radius && d.hausdorff_error <= 1.001e-4 * d.diagonal);
    assert_true(d.a_to_b.normal_mean < 3);
    for (mt_index v = 0; v < a->vertex_count; v++) {
        assert_true(fabs(d.a_to_b.vertex_distances[v] - 0.25 * radius) < 1e-3 * radius);
    }
    mt_deviation_release(context, &d);
    mt_mesh_destroy(context, a);
    mt_mesh_destroy(context, b);
    test_context_end(context);
}

static bool is_same_side(const mt_deviation_side *a, const mt_deviation_side *b)
{
    return a->max == b->max && a->mean == b->mean && a->rms == b->rms && a->max_error == b->max_error &&
           a->normal_mean == b->normal_mean && memcmp(&a->from, &b->from, sizeof a->from) == 0;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    mt_deviation first = {0};
    const unsigned threads[] = {1, 2, 5};
    for (size_t i = 0; i < 3; i++) {
        mt_context *context = test_context_with_threads(threads[i]);
        mt_mesh *a = test_torus(context, 60, 30, true), *b = test_torus(context, 41, 23, false);
        mt_deviation d;
        assert_int_equal(mt_measure_deviation(context, a, b, NULL, &d), MT_OK);
        first = i ? first : d;
        assert_true(is_same_side(&d.a_to_b, &first.a_to_b) && is_same_side(&d.b_to_a, &first.b_to_a));
        mt_deviation_release(context, &d);
        mt_mesh_destroy(context, a);
        mt_mesh_destroy(context, b);
        test_context_end(context);
    }
}

static void sizes_and_places_scale_the_result(void **state)
{
    (void)state;
    const double scales[] = {1e-150, 1e-30, 1e30, 1e150};
    mt_context *context = test_context();
    for (size_t i = 0; i < 4; i++) {
        mt_mesh *a = square(context, scales[i], 0), *b = square(context, scales[i], 0.5 * scales[i]);
        mt_deviation d;
        assert_int_equal(mt_measure_deviation(context, a, b, NULL, &d), MT_OK);
        assert_true(fabs(d.hausdorff / scales[i] - 0.5) < 1e-12 && fabs(d.a_to_b.rms / scales[i] - 0.5) < 1e-12);
        mt_deviation_release(context, &d);
        mt_mesh_destroy(context, a);
        mt_mesh_destroy(context, b);
    }
    test_context_end(context);
}

/* Whatever the mesh: a result, or a refusal that says why. */
static void every_animal_is_measured_or_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_animal animals[TEST_ZOO_ROOM];
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        mt_deviation d;
        mt_signed_distance *signed_distance = NULL;
        mt_status status = mt_measure_deviation(context, animals[i].mesh, animals[0].mesh, NULL, &d);
        assert_true(status == MT_OK || status == MT_ERROR_INVALID_MESH);
        assert_true(status != MT_OK || d.hausdorff >= 0);
        mt_deviation_release(context, &d);
        mt_context_clear_error(context);
        status = mt_signed_distance_create(context, animals[i].mesh, &signed_distance);
        assert_true((status == MT_OK) == (signed_distance != NULL));
        mt_signed_distance_destroy(context, signed_distance);
        mt_context_clear_error(context);
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

static double box_distance(mt_vec3 p, double half)
{
    double x = fabs(p.x) - half, y = fabs(p.y) - half, z = fabs(p.z) - half;
    double inside = fmin(fmax(fmax(x, y), z), 0);
    return inside + mt_vec3_length(mt_vec3_make(fmax(x, 0), fmax(y, 0), fmax(z, 0)));
}

static void signed_distances_of_a_cube_are_exact(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = generated(context, "cube", 0);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    double half = 0.5 * (bounds.maximum.x - bounds.minimum.x);
    move(mesh, 1, mt_vec3_scale(mt_vec3_add(bounds.minimum, bounds.maximum), -0.5));
    mt_signed_distance *signed_distance = NULL;
    assert_int_equal(mt_signed_distance_create(context, mesh, &signed_distance), MT_OK);
    test_random random = {3};
    for (int i = 0; i < 100000; i++) {
        mt_vec3 p =
            mt_vec3_make(4 * half * (test_random_unit(&random) - 0.5), 4 * half * (test_random_unit(&random) - 0.5),
                         4 * half * (test_random_unit(&random) - 0.5));
        if (i % 5 == 0) {
            p.x = p.y; /* nearest points on edges and corners, and ties between faces */
        }
        double found = mt_signed_distance_at(signed_distance, p, NULL);
        assert_true(fabs(found - box_distance(p, half)) < 1e-12);
    }
    assert_true(isnan(mt_signed_distance_at(signed_distance, mt_vec3_make(NAN, 0, 0), NULL)));
    mt_signed_distance_destroy(context, signed_distance);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A spike: at its tip plain face normals, or their mean, give the wrong sign; the angles put it right. */
static void signs_hold_around_sharp_corners(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 0.1, 0, -3, 0.1, 0.05, -3, -0.1, 0.02, -3};
    const mt_index faces[] = {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 1, 3, 3, 2, 1};
    mt_mesh *mesh = test_mesh(context, 4, positions, 4, faces);
    mt_signed_distance *signed_distance = NULL;
    assert_int_equal(mt_signed_distance_create(context, mesh, &signed_distance), MT_OK);
    test_random random = {4};
    for (int i = 0; i < 50000; i++) {
        double w[4], sum = 0;
        mt_vec3 inside = {0, 0, 0};
        for (int k = 0; k < 4; k++) {
            w[k] = 0.01 + test_random_unit(&random);
            sum += w[k];
        }
        for (int k = 0; k < 4; k++) {
            inside = mt_vec3_add(inside, mt_vec3_scale(mt_mesh_position(mesh, (mt_index)k), w[k] / sum));
        }
        assert_true(mt_signed_distance_at(signed_distance, inside, NULL) < 0);
        mt_vec3 outside = mt_vec3_make(test_random_unit(&random) - 0.5, test_random_unit(&random) - 0.5,
                                       test_random_unit(&random) * 0.5 + 1e-3);
        assert_true(mt_signed_distance_at(signed_distance, outside, NULL) > 0);
    }
    mt_signed_distance_destroy(context, signed_distance);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void open_and_turned_meshes_have_no_inside(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_signed_distance *signed_distance = NULL;
    mt_mesh *open = square(context, 1, 0);
    assert_int_equal(mt_signed_distance_create(context, open, &signed_distance), MT_ERROR_NOT_MANIFOLD);
    assert_null(signed_distance);
    mt_context_clear_error(context);
    mt_mesh *turned = generated(context, "tetrahedron", 0);
    mt_index *c = turned->corner_vertices, swapped = c[0];
    c[0] = c[1], c[1] = swapped;
    assert_int_equal(mt_signed_distance_create(context, turned, &signed_distance), MT_ERROR_NOT_ORIENTED);
    mt_context_clear_error(context);
    mt_mesh_destroy(context, open);
    mt_mesh_destroy(context, turned);
    test_context_end(context);
}

/* The n-th allocation fails, for every n: the error is told, and everything given back. */
static void running_out_of_memory_leaves_nothing_behind(void **state)
{
    (void)state;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t failing = 1; status != MT_OK; failing++) {
        mt_context *makes = test_context();
        mt_mesh *a = test_torus(makes, 8, 6, true), *b = generated(makes, "cube", 0);
        mt_context *context = mt_context_create(&(mt_context_options){.failing_allocation = failing});
        mt_deviation d;
        mt_signed_distance *signed_distance = NULL;
        status = mt_measure_deviation(context, a, b, &(mt_deviation_options){.keep_distances = true}, &d);
        if (status == MT_OK) {
            status = mt_signed_distance_create(context, b, &signed_distance);
        }
        assert_true(status == MT_OK || mt_context_error(context)->status == MT_ERROR_OUT_OF_MEMORY);
        assert_true(status == MT_OK || (status == MT_ERROR_OUT_OF_MEMORY && !signed_distance));
        mt_signed_distance_destroy(context, signed_distance);
        mt_deviation_release(context, &d);
        test_context_end(context);
        mt_mesh_destroy(makes, a);
        mt_mesh_destroy(makes, b);
        test_context_end(makes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallel_squares_have_closed_forms),
        cmocka_unit_test(a_mesh_lies_on_itself_and_on_its_refinement),
        cmocka_unit_test(maxima_lie_within_their_bounds),
        cmocka_unit_test(spheres_of_two_sizes_differ_by_their_radii),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(sizes_and_places_scale_the_result),
        cmocka_unit_test(every_animal_is_measured_or_refused),
        cmocka_unit_test(signed_distances_of_a_cube_are_exact),
        cmocka_unit_test(signs_hold_around_sharp_corners),
        cmocka_unit_test(open_and_turned_meshes_have_no_inside),
        cmocka_unit_test(running_out_of_memory_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
