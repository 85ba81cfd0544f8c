/* Welding a mesh: places become one vertex, and what the vertices carried stays with the faces. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/weld.h>

#include <string.h>

/* Two triangles side by side, nothing shared by index; one corner is -0 where the other is 0. */
static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, -0.0, 1, 0, 9, 9, 9};
static const mt_index faces[] = {3, 0, 1, 2, 3, 3, 4, 5};

static mt_attribute *add_values(mt_context *context, mt_mesh *mesh, const float *values)
{
    mt_attribute_layout layout = {
        .name = "heat", .domain = MT_DOMAIN_VERTEX, .type = MT_F32, .component_count = 1, .value_count = 7};
    mt_attribute *attribute = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    memcpy(attribute->values, values, 7 * sizeof *values);
    return attribute;
}

static void places_become_one_vertex(void **state)
{
    (void)state;
    static const mt_index welded[] = {0, 1, 2, 1, 3, 2};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, positions, 2, faces);
    mt_index removed = 0;
    assert_int_equal(mt_mesh_weld(context, mesh, &removed), MT_OK);
    assert_int_equal(removed, 2);
    assert_int_equal(mesh->vertex_count, 5);
    assert_memory_equal(mesh->corner_vertices, welded, sizeof welded);
    assert_true(mt_mesh_position(mesh, 4).x == 9);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    uint64_t once = test_mesh_hash(mesh);
    assert_int_equal(mt_mesh_weld(context, mesh, &removed), MT_OK);
    assert_int_equal(removed, 0);
    assert_true(test_mesh_hash(mesh) == once);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void values_that_agree_stay_on_vertices(void **state)
{
    (void)state;
    static const float values[] = {10, 11, 12, 11, 14, 12, 16};
    static const float kept[] = {10, 11, 12, 14, 16};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, positions, 2, faces);
    add_values(context, mesh, values);
    assert_int_equal(mt_mesh_weld(context, mesh, NULL), MT_OK);
    const mt_attribute *attribute = &mesh->attributes[0];
    assert_int_equal(attribute->domain, MT_DOMAIN_VERTEX);
    assert_int_equal(attribute->value_count, 5);
    assert_memory_equal(attribute->values, kept, sizeof kept);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void values_that_differ_move_to_the_corners(void **state)
{
    (void)state;
    static const float values[] = {10, 11, 12, 13, 14, 15, 16};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, positions, 2, faces);
    add_values(context, mesh, values);
    assert_int_equal(mt_mesh_weld(context, mesh, NULL), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    const mt_attribute *attribute = &mesh->attributes[0];
    assert_int_equal(attribute->domain, MT_DOMAIN_CORNER);
    for (mt_index corner = 0; corner < 6; corner++) {
        assert_true(mt_attribute_get(attribute, mt_attribute_value_index(attribute, corner), 0) == 10 + (double)corner);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Every allocation fails once: an error, and a mesh that is whole. */
static void lack_of_memory_leaves_a_whole_mesh(void **state)
{
    (void)state;
    static const float values[] = {10, 11, 12, 13, 14, 15, 16};
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t failing = 1; status != MT_OK; failing++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_mesh(context, 7, positions, 2, faces);
        add_values(context, mesh, values);
        mt_context_options options = {.failing_allocation = failing};
        mt_context *poor = mt_context_create(&options);
        mt_mesh *copy = NULL;
        if (mt_mesh_copy(poor, mesh, &copy) == MT_OK) {
            status = mt_mesh_weld(poor, copy, NULL);
            mt_context_clear_error(poor);
            assert_int_equal(mt_mesh_validate(poor, copy), MT_OK);
            assert_int_equal(copy->vertex_count, status == MT_OK ? 5 : 7);
        }
        mt_mesh_destroy(poor, copy);
        test_context_end(poor);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_become_one_vertex),
        cmocka_unit_test(values_that_agree_stay_on_vertices),
        cmocka_unit_test(values_that_differ_move_to_the_corners),
        cmocka_unit_test(lack_of_memory_leaves_a_whole_mesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
