/* Every structure for rays against brute force, on meshes that break naive ones, and the probe for leaks. */
#include "tests/support/unit.h"

#include "tests/support/ray_meshes.h"
#include "tests/support/soup.h"
#include "tests/support/structures.h"
#include "tests/support/zoo.h"

#include <meshtool/generate.h>

#include <string.h>

static mt_mesh *generated(mt_context *context, const char *name, mt_index resolution)
{
    mt_generate_options options = {.resolution = resolution};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, &options, &mesh), MT_OK);
    return mesh;
}

static void kinds_have_names(void **state)
{
    (void)state;
    assert_string_equal(mt_ray_structure_name(MT_RAY_STRUCTURE_AABB), "aabb");
    assert_string_equal(mt_ray_structure_name(MT_RAY_STRUCTURE_NONE), "none");
    assert_string_equal(mt_ray_structure_name(MT_RAY_STRUCTURE_OBB), "obb");
    assert_string_equal(mt_ray_structure_name(MT_RAY_STRUCTURE_GRID), "grid");
    assert_string_equal(mt_ray_structure_name(MT_RAY_STRUCTURE_BSP), "bsp");
    assert_null(mt_ray_structure_name(MT_RAY_STRUCTURE_COUNT));
}

static void what_is_no_kind_is_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = generated(context, "cube", 0);
    mt_triangulation triangulation;
    mt_ray_structure *structure = NULL;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(
        mt_ray_structure_create(context, mesh, &triangulation, MT_RAY_STRUCTURE_COUNT, MT_BUILD_BALANCED, &structure),
        MT_ERROR_ARGUMENT);
    assert_null(structure);
    mt_ray_structure_destroy(context, NULL);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
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

static mt_mesh *make_fan(mt_context *context)
{
    return test_fan(context, 400, true);
}

static mt_mesh *make_equal_triangles(mt_context *context)
{
    return test_equal_triangles(context, 100);
}

static mt_mesh *make_series(mt_context *context)
{
    return test_geometric_series(context, 1000);
}

static const struct {
    const char *name;
    mt_mesh *(*make)(mt_context *context);
    uint64_t rays;
} meshes[] = {
    {"cube", make_cube, 100000},
    {"sphere", make_sphere, 25000},
    {"torus", make_torus, 25000},
    {"slivers", test_slivers, 50000},
    {"flat duplicates", test_flat_duplicates, 50000},
    {"slanted plane", test_slanted_plane, 50000},
    {"two scales", test_two_scales, 25000},
    {"far torus", test_far_torus, 25000},
    {"tiny torus", test_tiny_torus, 25000},
    {"huge torus", test_huge_torus, 25000},
    {"fan", make_fan, 10000},
    {"equal triangles", make_equal_triangles, 25000},
    {"series", make_series, 5000},
};

/* Rays at edges, at vertices, along axes, in planes, and any. */
static void expect_agreement(mt_ray_profile profile, uint64_t share)
{
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        mt_context *context = test_context();
        test_structures structures;
        test_structures_init(&structures, context, meshes[i].make(context), profile);
        test_structures_agree(&structures, meshes[i].name, test_ray_count(meshes[i].rays / share), i);
        test_structures_end(&structures);
        test_context_end(context);
    }
}

static void watertight_rays_agree_with_brute_force(void **state)
{
    (void)state;
    expect_agreement(MT_RAY_WATERTIGHT, 1);
}

static void exact_rays_agree_with_brute_force(void **state)
{
    (void)state;
    expect_agreement(MT_RAY_EXACT, 5);
}

static void every_animal_agrees(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_animal animals[TEST_ZOO_ROOM];
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        mt_mesh *copy = NULL;
        assert_int_equal(mt_mesh_copy(context, animals[i].mesh, &copy), MT_OK);
        test_structures structures;
        test_structures_init(&structures, context, copy, i % 2 ? MT_RAY_WATERTIGHT : MT_RAY_EXACT);
        test_structures_agree(&structures, animals[i].name, test_ray_count(4000), i);
        test_structures_end(&structures);
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

static void soups_agree(void **state)
{
    (void)state;
    test_random random = {11};
    for (int round = 0; round < 100; round++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_soup(context, &random);
        test_structures structures;
        test_structures_init(&structures, context, mesh, round % 2 ? MT_RAY_WATERTIGHT : MT_RAY_EXACT);
        test_structures_agree(&structures, "soup", test_ray_count(4000), (uint64_t)round);
        test_structures_end(&structures);
        test_context_end(context);
    }
}

/* 1e5 equal triangles: nothing can tell them apart; the first one answers, and memory and depth stay bounded. */
static void many_equal_triangles_end_in_a_structure(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_index count = (mt_index)test_ray_count(100000);
    test_structures structures;
    test_structures_init(&structures, context, test_equal_triangles(context, count), MT_RAY_WATERTIGHT);
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        const mt_ray_structure *structure = structures.all[kind];
        mt_ray ray = mt_ray_make(mt_vec3_make(0.25, 0.25, 1), mt_vec3_make(0, 0, -1));
        mt_ray_hit hit;
        assert_true(mt_ray_structure_nearest_hit(structure, &ray, MT_RAY_WATERTIGHT, &hit));
        assert_int_equal(hit.triangle, 0);
        assert_true(hit.t == 1);
        ray.skip = 0;
        assert_true(mt_ray_structure_nearest_hit(structure, &ray, MT_RAY_WATERTIGHT, &hit));
        assert_int_equal(hit.triangle, 1);
        assert_true(mt_ray_structure_size(structure) < 400 * (uint64_t)count + 8192);
    }
    test_structures_end(&structures);
    test_context_end(context);
}

/* A vertex in very many triangles, thin ones that all meet there. */
static void a_vertex_of_many_faces_has_a_structure(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_index count = (mt_index)test_ray_count(200000);
    test_structures structures;
    test_structures_init(&structures, context, test_fan(context, count, true), MT_RAY_WATERTIGHT);
    test_structures_agree(&structures, "fan", 200, 5);
    for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
        assert_true(mt_ray_structure_size(structures.all[kind]) < 400 * (uint64_t)count + 8192);
    }
    test_structures_end(&structures);
    test_context_end(context);
}

/* A ray that begins far behind the mesh and looks away, but may hit before its origin: its slack is more than cells and
 * planes allow for. */
static void rays_that_look_back_agree(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_structures structures;
    test_structures_init(&structures, context, generated(context, "icosphere", 2), MT_RAY_WATERTIGHT);
    test_random random = {6};
    uint64_t hit_count = 0;
    for (uint64_t i = 0; i < test_ray_count(20000); i++) {
        mt_ray ray = test_random_ray(&structures.target, &random);
        double back = ldexp(1, (int)test_random_below(&random, 30));
        ray.origin = mt_ray_at(&ray, back);
        ray.t_minimum = test_random_below(&random, 2) ? (double)-INFINITY : -2 * back;
        test_structures_agree_on(&structures, "looking back", &ray);
        hit_count += test_brute_force(&structures.target, &ray).triangle != MT_NONE;
    }
    assert_true(hit_count > test_ray_count(20000) / 10);
    test_structures_end(&structures);
    test_context_end(context);
}

/* From near the middle at every vertex, and at the middle of every side: nothing gets out. */
static void no_ray_leaves_a_closed_mesh(void **state)
{
    (void)state;
    const mt_ray_profile profiles[] = {MT_RAY_WATERTIGHT, MT_RAY_EXACT};
    for (size_t p = 0; p < 2; p++) {
        uint64_t count = test_ray_count(p ? 20000 : 200000);
        mt_context *context = test_context();
        test_structures sphere, cube;
        test_structures_init(&sphere, context, generated(context, "icosphere", 3), profiles[p]);
        test_structures_are_tight(&sphere, "sphere", mt_vec3_make(0.1, 0, 0), 0.9, count);
        test_structures_end(&sphere);
        test_structures_init(&cube, context, generated(context, "cube", 0), profiles[p]);
        mt_bounds bounds = mt_mesh_bounds(cube.target.mesh);
        mt_vec3 middle = mt_vec3_scale(mt_vec3_add(bounds.minimum, bounds.maximum), 0.5);
        test_structures_are_tight(&cube, "cube", middle, 0, 1000);
        test_structures_are_tight(&cube, "cube", middle, 0.9 * (bounds.maximum.x - bounds.minimum.x), count / 5);
        test_structures_end(&cube);
        test_context_end(context);
    }
}

/* The same structure for any number of threads: the same size, and the same answer where it depends on the order. */
static void threads_change_nothing(void **state)
{
    (void)state;
    uint64_t first[2 * TEST_STRUCTURE_COUNT];
    const unsigned threads[] = {1, 2, 7};
    for (size_t i = 0; i < 3; i++) {
        mt_context *context = test_context_with_threads(threads[i]);
        test_structures structures;
        test_structures_init(&structures, context, test_torus(context, 350, 100, true), MT_RAY_WATERTIGHT);
        for (int kind = 0; kind < TEST_STRUCTURE_COUNT; kind++) {
            test_random random = {9};
            uint64_t size = mt_ray_structure_size(structures.all[kind]), hash = 0;
            for (int number = 0; number < (kind == MT_RAY_STRUCTURE_NONE ? 20 : 2000); number++) {
                mt_ray ray = test_random_ray(&structures.target, &random);
                mt_ray_hit hit;
                mt_ray_structure_nearest_hit(structures.all[kind], &ray, MT_RAY_FAST, &hit);
                hash = hash * 31 + test_hash(&hit.t, sizeof hit.t) + hit.triangle;
            }
            first[2 * kind] = i ? first[2 * kind] : size;
            first[2 * kind + 1] = i ? first[2 * kind + 1] : hash;
            assert_true(first[2 * kind] == size && first[2 * kind + 1] == hash);
        }
        test_structures_end(&structures);
        test_context_end(context);
    }
}

/* The n-th allocation fails, for every n, of a mesh large enough for parts that are made in parallel. */
static void failing_allocations_leave_nothing(void **state)
{
    (void)state;
    mt_context *own = test_context();
    mt_mesh *mesh = test_torus(own, 120, 60, true);
    mt_triangulation triangulation;
    assert_int_equal(mt_triangulation_init(own, mesh, &triangulation), MT_OK);
    for (int kind = 0; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        for (uint64_t n = 1; status != MT_OK; n++) {
            mt_context_options options = {.thread_count = 2, .failing_allocation = n};
            mt_context *context = mt_context_create(&options);
            mt_ray_structure *structure;
            status = mt_ray_structure_create(context, mesh, &triangulation, (mt_ray_structure_kind)kind,
                                             MT_BUILD_BALANCED, &structure);
            if (status != MT_OK) {
                assert_int_equal(status, MT_ERROR_OUT_OF_MEMORY);
                assert_int_equal(mt_context_error(context)->status, status);
                assert_null(structure);
            }
            mt_ray_structure_destroy(context, structure);
            assert_int_equal(mt_context_bytes(context), 0);
            mt_context_destroy(context);
            assert_true(n < 10000);
        }
    }
    mt_triangulation_release(own, &triangulation);
    mt_mesh_destroy(own, mesh);
    test_context_end(own);
}

/* Bytes that are said to be held are those that the context counts. */
static void sizes_are_those_held(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 60, 30, false);
    mt_triangulation triangulation;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    for (int kind = 0; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
        uint64_t before = mt_context_bytes(context);
        mt_ray_structure *structure;
        assert_int_equal(mt_ray_structure_create(context, mesh, &triangulation, (mt_ray_structure_kind)kind,
                                                 MT_BUILD_BALANCED, &structure),
                         MT_OK);
        assert_int_equal(mt_ray_structure_kind_of(structure), kind);
        assert_int_equal(mt_ray_structure_size(structure), mt_context_bytes(context) - before);
        mt_ray_structure_destroy(context, structure);
    }
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

typedef struct stopper {
    unsigned asked, at; /* stops when asked so often; 0: never */
    double share;
    bool goes_back;
} stopper;

static bool keep_on(void *user, const char *task, double fraction)
{
    stopper *s = user;
    assert_non_null(task);
    s->goes_back = s->goes_back || !(fraction >= s->share && fraction <= 1);
    s->share = fraction;
    return ++s->asked != s->at;
}

static mt_status build_with(mt_ray_structure_kind kind, const mt_mesh *mesh, const mt_triangulation *triangulation,
                            stopper *s)
{
    mt_context_options options = {.thread_count = 2, .progress = keep_on, .progress_user = s};
    mt_context *context = mt_context_create(&options);
    mt_ray_structure *structure = NULL;
    assert_non_null(context);
    mt_status status = mt_ray_structure_create(context, mesh, triangulation, kind, MT_BUILD_BALANCED, &structure);
    assert_true((structure != NULL) == (status == MT_OK));
    mt_ray_structure_destroy(context, structure);
    assert_int_equal(mt_context_bytes(context), 0);
    mt_context_destroy(context);
    return status;
}

/* Large enough for a top and several batches of parts. */
static void building_can_be_stopped(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = generated(context, "icosphere", 6);
    mt_triangulation triangulation;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    for (int kind = 0; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
        stopper whole = {.at = 0};
        assert_int_equal(build_with((mt_ray_structure_kind)kind, mesh, &triangulation, &whole), MT_OK);
        assert_false(whole.goes_back);
        assert_true(kind == MT_RAY_STRUCTURE_NONE || whole.asked > 0);
        for (unsigned at = 1; at <= whole.asked; at += at < 4 ? 1 : whole.asked / 4) {
            stopper stopped = {.at = at};
            assert_int_equal(build_with((mt_ray_structure_kind)kind, mesh, &triangulation, &stopped),
                             MT_ERROR_CANCELLED);
            assert_int_equal(stopped.asked, at);
        }
    }
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_have_names),
        cmocka_unit_test(what_is_no_kind_is_refused),
        cmocka_unit_test(watertight_rays_agree_with_brute_force),
        cmocka_unit_test(exact_rays_agree_with_brute_force),
        cmocka_unit_test(every_animal_agrees),
        cmocka_unit_test(soups_agree),
        cmocka_unit_test(many_equal_triangles_end_in_a_structure),
        cmocka_unit_test(a_vertex_of_many_faces_has_a_structure),
        cmocka_unit_test(rays_that_look_back_agree),
        cmocka_unit_test(no_ray_leaves_a_closed_mesh),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(failing_allocations_leave_nothing),
        cmocka_unit_test(sizes_are_those_held),
        cmocka_unit_test(building_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
