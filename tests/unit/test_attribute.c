#include "tests/support/fixture.h"
#include "tests/support/laden_mesh.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static mt_mesh *laden(mt_context *context)
{
    mt_mesh *mesh = NULL;
    assert_int_equal(test_laden_mesh(context, &mesh), MT_OK);
    return mesh;
}

static void test_numbers_are_rounded_and_clamped(void **state)
{
    (void)state;
    static const struct {
        mt_type type;
        double given, stored;
    } cases[] = {
        {MT_U8, 254.5, 254},
        {MT_U8, 253.5, 254},
        {MT_U8, -3, 0},
        {MT_U8, 300, 255},
        {MT_U8, NAN, 0},
        {MT_I8, -128.4, -128},
        {MT_I8, -1e9, -128},
        {MT_I8, 127.6, 127},
        {MT_U16, 65535.5, 65535},
        {MT_U16, 0.5, 0},
        {MT_I16, -32769, -32768},
        {MT_I16, 1.5, 2},
        {MT_U32, 4294967295.0, 4294967295.0},
        {MT_U32, 1e300, 4294967295.0},
        {MT_U32, INFINITY, 4294967295.0},
        {MT_I32, -INFINITY, -2147483648.0},
        {MT_I32, 2147483647.0, 2147483647.0},
        {MT_F32, 0.1, (double)0.1f},
        {MT_F64, 0.1, 0.1},
        {MT_F64, -INFINITY, -INFINITY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double storage[2] = {0};
        mt_attribute attribute = {
            .type = cases[i].type, .component_count = 2, .value_count = 1, .values = storage, .domain = MT_DOMAIN_MESH};
        mt_attribute_set(&attribute, 0, 0, 1);
        mt_attribute_set(&attribute, 0, 1, cases[i].given);
        assert_true(mt_attribute_get(&attribute, 0, 1) == cases[i].stored);
        assert_true(mt_attribute_get(&attribute, 0, 0) == 1);
    }
}

static void test_every_value_of_small_types_survives(void **state)
{
    (void)state;
    static const struct {
        mt_type type;
        double first, last;
    } ranges[] = {{MT_U8, 0, 255}, {MT_I8, -128, 127}, {MT_U16, 0, 65535}, {MT_I16, -32768, 32767}};
    for (size_t i = 0; i < 4; i++) {
        double storage[1];
        mt_attribute attribute = {.type = ranges[i].type, .component_count = 1, .value_count = 1, .values = storage};
        for (double number = ranges[i].first; number <= ranges[i].last; number++) {
            mt_attribute_set(&attribute, 0, 0, number);
            assert_true(mt_attribute_get(&attribute, 0, 0) == number);
        }
    }
}

static void test_semantics_say_how_values_travel(void **state)
{
    (void)state;
    assert_int_equal(mt_semantic_interpolation(MT_SEMANTIC_NORMAL, MT_F32), MT_INTERPOLATE_UNIT);
    assert_int_equal(mt_semantic_interpolation(MT_SEMANTIC_UV, MT_F64), MT_INTERPOLATE_LINEAR);
    assert_int_equal(mt_semantic_interpolation(MT_SEMANTIC_COLOR, MT_U8), MT_INTERPOLATE_LINEAR);
    assert_int_equal(mt_semantic_interpolation(MT_SEMANTIC_GENERIC, MT_F32), MT_INTERPOLATE_LINEAR);
    for (mt_type type = MT_U8; type <= MT_I32; type++) {
        assert_int_equal(mt_semantic_interpolation(MT_SEMANTIC_GENERIC, type), MT_INTERPOLATE_NONE);
    }
    assert_true(mt_color_maximum(MT_U8) == 255 && mt_color_maximum(MT_U16) == 65535);
    assert_true(mt_color_maximum(MT_F32) == 1 && mt_color_maximum(MT_F64) == 1);
}

static void test_attributes_are_found_and_removed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden(context);
    mt_attribute *uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    assert_non_null(uv);
    assert_null(mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX));
    assert_int_equal(mt_attribute_value_index(uv, 5), MT_NONE);
    assert_int_equal(mt_attribute_value_index(uv, 1), 3);
    assert_int_equal(mt_attribute_value_index(&mesh->attributes[0], 5), 5);
    mt_index count = mesh->attribute_count;
    mt_mesh_remove_attribute(context, mesh, 1);
    assert_int_equal(mesh->attribute_count, count - 1);
    assert_null(mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER));
    assert_string_equal(mesh->attributes[1].name, "tint");
    while (mesh->attribute_count) {
        mt_mesh_remove_attribute(context, mesh, 0);
    }
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_too_many_values_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden(context);
    mt_index count = mesh->attribute_count;
    mt_attribute_layout layout = {
        .domain = MT_DOMAIN_CORNER, .type = MT_F64, .component_count = 2, .value_count = UINT32_MAX, .indexed = true};
    mt_attribute *attribute;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_ERROR_TOO_LARGE);
    assert_null(attribute);
    assert_int_equal(mesh->attribute_count, count);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_labels_name_faces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden(context);
    mt_labels *groups = mt_mesh_find_labels(mesh, MT_LABEL_GROUP);
    assert_non_null(groups);
    assert_null(mt_mesh_find_labels(mesh, MT_LABEL_SOLID));
    assert_int_equal(groups->face_labels[0], MT_NONE);
    assert_string_equal(groups->names[groups->face_labels[1]], "sides");
    assert_string_equal(mt_label_kind_name(MT_LABEL_GROUP), "group");
    assert_string_equal(mt_label_kind_name(MT_LABEL_PART), "part");
    mt_index number;
    for (mt_index i = 3; i < 1000; i++) {
        char name[16];
        snprintf(name, sizeof name, "%u", i);
        assert_int_equal(mt_labels_add_name(context, groups, name, &number), MT_OK);
        assert_int_equal(number, i);
    }
    assert_string_equal(groups->names[999], "999");
    assert_string_equal(groups->names[2], "");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers_are_rounded_and_clamped),
        cmocka_unit_test(test_every_value_of_small_types_survives),
        cmocka_unit_test(test_semantics_say_how_values_travel),
        cmocka_unit_test(test_attributes_are_found_and_removed),
        cmocka_unit_test(test_too_many_values_are_refused),
        cmocka_unit_test(test_labels_name_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
