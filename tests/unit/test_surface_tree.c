/* The tree against brute force, its invariants on meshes that break naive builders, and the probe for leaks. */
#include "tests/support/unit.h"

#include "tests/support/ray_meshes.h"
#include "tests/support/rays.h"
#include "tests/support/soup.h"
#include "tests/support/zoo.h"

#include <meshtool/generate.h>

static mt_mesh *generated(mt_context *context, const char *name, mt_index resolution)
{
    mt_generate_options options = {.resolution = resolution};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, &options, &mesh), MT_OK);
    return mesh;
}

static void expect_no_difference(const char *name, mt_mesh *(*make)(mt_context *context), uint64_t count,
                                 mt_ray_profile profile)
{
    mt_context *context = test_context();
    test_target target;
    test_target_init(&target, context, make(context), profile);
    uint64_t differences = test_count_differences(&target, test_ray_count(count), 7);
    if (differences) {
        print_error("%s: %llu rays differ\n", name, (unsigned long long)differences);
    }
    assert_int_equal(differences, 0);
    test_target_end(&target);
    test_context_end(context);
}

static mt_mesh *make_cube(mt_context *context)
{
    return generated(context, "cube", 0);
}

static mt_mesh *make_sphere(mt_context *context)
{
    return generated(context, "icosphere", 2);
}

static mt_mesh *make_torus(mt_context *context)
{
    return test_torus(context, 12, 8, true);
}

static void million_rays_agree_with_brute_force(void **state)
{
    (void)state;
    expect_no_difference("cube", make_cube, 1000000, MT_RAY_WATERTIGHT);
    expect_no_difference("sphere", make_sphere, 1000000, MT_RAY_WATERTIGHT);
    expect_no_difference("torus", make_torus, 1000000, MT_RAY_WATERTIGHT);
    expect_no_difference("slivers", test_slivers, 1000000, MT_RAY_WATERTIGHT);
    expect_no_difference("flat_duplicates", test_flat_duplicates, 1000000, MT_RAY_WATERTIGHT);
    expect_no_difference("two_scales", test_two_scales, 300000, MT_RAY_WATERTIGHT);
    expect_no_difference("far", test_far_torus, 300000, MT_RAY_WATERTIGHT);
}

static void exact_rays_agree_with_brute_force(void **state)
{
    (void)state;
    expect_no_difference("cube", make_cube, 200000, MT_RAY_EXACT);
    expect_no_difference("sphere", make_sphere, 200000, MT_RAY_EXACT);
    expect_no_difference("slivers", test_slivers, 200000, MT_RAY_EXACT);
    expect_no_difference("flat_duplicates", test_flat_duplicates, 200000, MT_RAY_EXACT);
    expect_no_difference("two_scales", test_two_scales, 100000, MT_RAY_EXACT);
    expect_no_difference("far", test_far_torus, 100000, MT_RAY_EXACT);
}

static void every_animal_has_a_sound_tree(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_animal animals[TEST_ZOO_ROOM];
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        mt_mesh *copy = NULL;
        assert_int_equal(mt_mesh_copy(context, animals[i].mesh, &copy), MT_OK);
        test_target target;
        test_target_init(&target, context, copy, MT_RAY_WATERTIGHT);
        assert_int_equal(test_count_differences(&target, 2000, i), 0);
        test_target_end(&target);
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

static void soups_agree_with_brute_force(void **state)
{
    (void)state;
    test_random random = {11};
    for (int round = 0; round < 200; round++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_soup(context, &random);
        test_target target;
        test_target_init(&target, context, mesh, round % 2 ? MT_RAY_WATERTIGHT : MT_RAY_EXACT);
        assert_int_equal(test_count_differences(&target, 1000, (uint64_t)round), 0);
        test_target_end(&target);
        test_context_end(context);
    }
}

static void what_is_not_finite_is_left_out_and_counted(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t b = 0; b < 3; b++) {
        mt_mesh *mesh = generated(context, "icosphere", 3);
        mt_mesh_set_position(mesh, 5, mt_vec3_make(0, bad[b], 0));
        test_target target;
        test_target_init(&target, context, mesh, MT_RAY_WATERTIGHT);
        mt_index left_out = mt_surface_tree_left_out(target.tree);
        assert_true(left_out == 5 || left_out == 6);
        assert_int_equal(mt_surface_tree_count(target.tree) + left_out, 1280);
        assert_int_equal(test_count_differences(&target, 5000, b), 0);
        test_target_end(&target);
    }
    test_context_end(context);
}

/* 1e5 equal triangles: no box can tell them apart; the first one answers. */
static void identical_centroids_end_in_a_tree(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_target target;
    test_target_init(&target, context, test_equal_triangles(context, 100000), MT_RAY_WATERTIGHT);
    mt_ray ray = mt_ray_make(mt_vec3_make(0.25, 0.25, 1), mt_vec3_make(0, 0, -1));
    mt_ray_hit hit;
    assert_true(mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_WATERTIGHT, &hit));
    assert_int_equal(hit.triangle, 0);
    assert_true(hit.t == 1);
    ray.skip = 0;
    assert_true(mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_WATERTIGHT, &hit));
    assert_int_equal(hit.triangle, 1);
    test_target_end(&target);
    test_context_end(context);
}

static void geometric_series_keep_the_depth_bounded(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_target target;
    test_target_init(&target, context, test_geometric_series(context, 3000), MT_RAY_WATERTIGHT);
    assert_int_equal(test_count_differences(&target, test_ray_count(5000), 3), 0);
    test_target_end(&target);
    test_context_end(context);
}

static void a_vertex_of_a_million_faces_has_a_tree(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, (mt_index)test_ray_count(1000000), true);
    mt_triangulation triangulation;
    mt_surface_tree *tree = NULL;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(mt_surface_tree_create(context, mesh, &triangulation, NULL, &tree), MT_OK);
    assert_int_equal(mt_surface_tree_validate(context, tree), MT_OK);
    assert_true(mt_surface_tree_size(tree) < 70 * (uint64_t)mesh->face_count + 4096);
    mt_surface_tree_destroy(context, tree);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void rays_through_nothing_hit_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 1, (const double[]){1, 2, 3}, 0, NULL);
    test_target target;
    test_target_init(&target, context, mesh, MT_RAY_WATERTIGHT);
    mt_ray ray = mt_ray_make(mt_vec3_make(0, 0, 0), mt_vec3_make(1, 2, 3));
    mt_ray_hit hit;
    assert_false(mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_WATERTIGHT, &hit));
    assert_int_equal(hit.triangle, MT_NONE);
    assert_false(mt_surface_tree_any_hit(target.tree, &ray, MT_RAY_EXACT));
    test_target_end(&target);
    test_context_end(context);
}

/* A million rays from inside, aimed at every vertex, then at the middle of every edge: all must hit. */
static void no_ray_leaves_a_closed_mesh(void **state)
{
    (void)state;
    const mt_ray_profile profiles[] = {MT_RAY_WATERTIGHT, MT_RAY_EXACT};
    for (size_t p = 0; p < 2; p++) {
        uint64_t count = test_ray_count(p ? 100000 : 1000000);
        mt_context *context = test_context();
        test_target sphere;
        test_target_init(&sphere, context, generated(context, "icosphere", 6), profiles[p]);
        assert_int_equal(test_count_misses(&sphere, mt_vec3_make(0.1, 0, 0), 0.9, false, count), 0);
        assert_int_equal(test_count_misses(&sphere, mt_vec3_make(0.1, 0, 0), 0.9, true, count), 0);
        test_target_end(&sphere);
        test_target cube;
        test_target_init(&cube, context, generated(context, "cube", 0), profiles[p]);
        mt_bounds bounds = mt_mesh_bounds(cube.mesh);
        mt_vec3 middle = mt_vec3_scale(mt_vec3_add(bounds.minimum, bounds.maximum), 0.5);
        double size = bounds.maximum.x - bounds.minimum.x;
        assert_int_equal(test_count_misses(&cube, middle, 0, false, 1000), 0);
        assert_int_equal(test_count_misses(&cube, middle, 0.9 * size, true, count / 10), 0);
        assert_int_equal(test_count_misses(&cube, middle, 0.9 * size, false, count / 10), 0);
        test_target_end(&cube);
        test_context_end(context);
    }
}

/* The same tree for any number of threads: the same size, and the same answer where it depends on the tree's order. */
static void threads_change_nothing(void **state)
{
    (void)state;
    uint64_t hashes[3], sizes[3];
    const unsigned threads[] = {1, 2, 5};
    for (size_t i = 0; i < 3; i++) {
        mt_context *context = test_context_with_threads(threads[i]);
        test_target target;
        test_target_init(&target, context, test_torus(context, 600, 200, true), MT_RAY_WATERTIGHT);
        test_random random = {9};
        uint64_t hash = 0;
        for (int ray_number = 0; ray_number < 5000; ray_number++) {
            mt_ray ray = test_random_ray(&target, &random);
            mt_ray_hit hit;
            mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_WATERTIGHT, &hit);
            hash = hash * 31 + test_hash(&hit.t, sizeof hit.t) + hit.triangle;
        }
        hashes[i] = hash;
        sizes[i] = mt_surface_tree_size(target.tree);
        test_target_end(&target);
        test_context_end(context);
        assert_true(hashes[i] == hashes[0] && sizes[i] == sizes[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(million_rays_agree_with_brute_force),
        cmocka_unit_test(exact_rays_agree_with_brute_force),
        cmocka_unit_test(every_animal_has_a_sound_tree),
        cmocka_unit_test(soups_agree_with_brute_force),
        cmocka_unit_test(what_is_not_finite_is_left_out_and_counted),
        cmocka_unit_test(identical_centroids_end_in_a_tree),
        cmocka_unit_test(geometric_series_keep_the_depth_bounded),
        cmocka_unit_test(a_vertex_of_a_million_faces_has_a_tree),
        cmocka_unit_test(rays_through_nothing_hit_nothing),
        cmocka_unit_test(no_ray_leaves_a_closed_mesh),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
