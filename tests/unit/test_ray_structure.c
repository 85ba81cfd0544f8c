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
    assert_int_equal(mt_ray_structure_create(context, mesh, &triangulation, MT_RAY_STRUCTURE_COUNT, &structure),
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
    {"cube", make_cube, 200000},
    {"sphere", make_sphere, 50000},
    {"torus", make_torus, 50000},
    {"slivers", test_slivers, 100000},
    {"flat duplicates", test_flat_duplicates, 100000},
    {"slanted plane", test_slanted_plane, 100000},
    {"two scales", test_two_scales, 50000},
    {"far torus", test_far_torus, 50000},
    {"tiny torus", test_tiny_torus, 50000},
    {"huge torus", test_huge_torus, 50000},
    {"fan", make_fan, 20000},
    {"equal triangles", make_equal_triangles, 50000},
    {"series", make_series, 10000},
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_have_names),
        cmocka_unit_test(what_is_no_kind_is_refused),
        cmocka_unit_test(watertight_rays_agree_with_brute_force),
        cmocka_unit_test(exact_rays_agree_with_brute_force),
        cmocka_unit_test(every_animal_agrees),
        cmocka_unit_test(soups_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
