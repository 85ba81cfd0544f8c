/* Every structure for rays against brute force, on meshes that break naive ones, and the probe for leaks. */
#include "tests/support/unit.h"

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
        cmocka_unit_test(every_animal_agrees),
        cmocka_unit_test(soups_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
