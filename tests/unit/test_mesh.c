#include "tests/support/fixture.h"
#include "tests/support/laden_mesh.h"
#include "tests/support/unit.h"

#include <string.h>

static mt_mesh *laden(mt_context *context)
{
    mt_mesh *mesh = NULL;
    assert_int_equal(test_laden_mesh(context, &mesh), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    return mesh;
}

static void test_an_empty_mesh_is_a_mesh(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (mt_index face_size = 0; face_size < 5; face_size++) {
        mt_mesh_layout layout = {.face_size = face_size, .position_type = MT_F32};
        mt_mesh *mesh, *copy;
        assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
        assert_int_equal(mt_mesh_validate(context, mesh), face_size == 1 || face_size == 2 ? MT_ERROR_INTERNAL : MT_OK);
        assert_int_equal(mt_mesh_copy(context, mesh, &copy), MT_OK);
        assert_true(test_mesh_hash(mesh) == test_mesh_hash(copy));
        assert_int_equal(mt_mesh_bounds(mesh).finite_count, 0);
        assert_true(mt_mesh_bounds(mesh).minimum.x > mt_mesh_bounds(mesh).maximum.x);
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, copy);
        mt_context_clear_error(context);
    }
    mt_mesh_destroy(context, NULL);
    test_context_end(context);
}

static void test_counts_past_an_index_are_too_large(void **state)
{
    (void)state;
    static const mt_mesh_layout layouts[] = {
        {.vertex_count = UINT32_MAX, .position_type = MT_F32},
        {.face_count = (uint64_t)UINT32_MAX + 5, .position_type = MT_F32},
        {.corner_count = UINT64_MAX, .position_type = MT_F32},
        {.face_count = 1u << 31, .face_size = 3, .position_type = MT_F32},
        {.face_count = UINT64_MAX / 2, .face_size = 4, .position_type = MT_F64},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh;
        assert_int_equal(mt_mesh_create(context, &layouts[i], &mesh), MT_ERROR_TOO_LARGE);
        assert_null(mesh);
        assert_int_equal(mt_context_allocation_count(context), 0);
        test_context_end(context);
    }
}

static void test_faces_are_found_from_corners(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden(context);
    assert_int_equal(mt_mesh_face_sides(mesh, 0), 4);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            assert_int_equal(mt_mesh_corner_face(mesh, corner), face);
        }
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_faces_of_one_size_need_no_offsets(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[12] = {0};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 2, 1, 3};
    mt_mesh *mesh = test_mesh(context, 4, positions, 2, faces);
    assert_null(mesh->face_offsets);
    assert_int_equal(mesh->face_size, 3);
    uint64_t hash = test_mesh_hash(mesh);
    assert_int_equal(mt_mesh_corner_face(mesh, 2), 0);
    assert_int_equal(mt_mesh_corner_face(mesh, 3), 1);
    assert_int_equal(mt_mesh_expand_faces(context, mesh), MT_OK);
    assert_non_null(mesh->face_offsets);
    assert_int_equal(mesh->face_size, 0);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    assert_true(test_mesh_hash(mesh) == hash);
    assert_int_equal(mt_mesh_expand_faces(context, mesh), MT_OK);
    mt_mesh_compact_faces(context, mesh);
    assert_null(mesh->face_offsets);
    assert_true(test_mesh_hash(mesh) == hash);
    mt_mesh_destroy(context, mesh);
    mesh = laden(context);
    mt_mesh_compact_faces(context, mesh); /* a quad among triangles: nothing to drop */
    assert_non_null(mesh->face_offsets);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_a_copy_is_equal_and_its_own(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden(context), *copy;
    uint64_t hash = test_mesh_hash(mesh);
    assert_int_equal(mt_mesh_copy(context, mesh, &copy), MT_OK);
    assert_int_equal(mt_mesh_validate(context, copy), MT_OK);
    assert_true(test_mesh_hash(copy) == hash);
    assert_int_equal(copy->up, MT_UP_Z);
    assert_true(copy->welded);
    assert_string_equal(copy->material_libraries[0], "colors.mtl");
    mt_mesh_set_position(mesh, 0, mt_vec3_make(9, 9, 9));
    mt_attribute_set(&mesh->attributes[1], 0, 0, 99);
    mesh->attributes[1].indices[0] = MT_NONE;
    mesh->label_sets[0].names[0][0] = 'X';
    mesh->creases[0].value = 77;
    assert_true(test_mesh_hash(mesh) != hash);
    assert_true(test_mesh_hash(copy) == hash);
    mt_index number;
    for (int i = 0; i < 10; i++) { /* a copy's names can grow as the original's */
        assert_int_equal(mt_labels_add_name(context, &copy->label_sets[0], "more", &number), MT_OK);
    }
    assert_int_equal(number, 12);
    mt_mesh_destroy(context, mesh);
    assert_string_equal(copy->label_sets[0].names[0], "base");
    mt_mesh_destroy(context, copy);
    test_context_end(context);
}

static void test_precision_changes_round_and_count(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[9] = {0.1, 1e39, -1e300, INFINITY, NAN, 1e-60, 16777217, -0.0, 1.0 / 3};
    mt_mesh *mesh = test_mesh(context, 3, positions, 0, NULL);
    mt_index overflowed = 99;
    assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F64, &overflowed), MT_OK);
    assert_int_equal(overflowed, 0);
    assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F32, &overflowed), MT_OK);
    assert_int_equal(overflowed, 2);
    const float *narrow = mesh->positions;
    assert_true(narrow[0] == 0.1f && isinf(narrow[1]) && narrow[2] < 0 && isinf(narrow[2]) && isinf(narrow[3]));
    assert_true(isnan(narrow[4]) && narrow[5] == 0 && narrow[6] == 16777216 && signbit(narrow[7]));
    assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F64, NULL), MT_OK);
    assert_true(mt_mesh_position(mesh, 0).x == (double)0.1f);
    assert_true(mt_mesh_position(mesh, 2).z == (double)(float)(1.0 / 3));
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_bounds_leave_out_what_is_not_finite(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {1, 2, 3, NAN, 0, 0, -4, 5, 6, 0, INFINITY, 0, 7, -8, 9, 0, 0, -INFINITY};
    mt_mesh *mesh = test_mesh(context, 6, positions, 0, NULL);
    for (int narrow = 0; narrow < 2; narrow++) {
        mt_bounds bounds = mt_mesh_bounds(mesh);
        assert_int_equal(bounds.finite_count, 3);
        assert_int_equal(bounds.non_finite_count, 3);
        assert_true(bounds.minimum.x == -4 && bounds.minimum.y == -8 && bounds.minimum.z == 3);
        assert_true(bounds.maximum.x == 7 && bounds.maximum.y == 5 && bounds.maximum.z == 9);
        assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F32, NULL), MT_OK);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Each breaks one invariant; validate must name it. */
static void break_corner(mt_mesh *mesh)
{
    mesh->corner_vertices[3] = 7;
}
static void break_first_offset(mt_mesh *mesh)
{
    mesh->face_offsets[0] = 1;
}
static void break_last_offset(mt_mesh *mesh)
{
    mesh->face_offsets[5] = 15;
}
static void break_face_size(mt_mesh *mesh)
{
    mesh->face_offsets[1] = 5;
}
static void break_order(mt_mesh *mesh)
{
    mesh->face_offsets[2] = 2;
}
static void break_wire(mt_mesh *mesh)
{
    mesh->wire_vertices[4] = 7;
}
static void break_wire_offset(mt_mesh *mesh)
{
    mesh->wire_offsets[1] = 1;
}
static void break_point(mt_mesh *mesh)
{
    mesh->point_vertices[0] = MT_NONE;
}
static void break_value_count(mt_mesh *mesh)
{
    mesh->attributes[0].value_count = 6;
}
static void break_value_index(mt_mesh *mesh)
{
    mesh->attributes[1].indices[2] = 4;
}
static void break_label(mt_mesh *mesh)
{
    mesh->label_sets[1].face_labels[0] = 1;
}
static void break_crease(mt_mesh *mesh)
{
    mesh->creases[1].b = 7;
}
static void break_sharp_vertex(mt_mesh *mesh)
{
    mesh->sharp_vertices[0].vertex = 7;
}

static void test_validate_names_what_is_broken(void **state)
{
    (void)state;
    static const struct {
        void (*damage)(mt_mesh *mesh);
        const char *part;
    } cases[] = {
        {break_corner, "corner 3 has the index 7"},
        {break_first_offset, "face offsets run from 1"},
        {break_last_offset, "to 15"},
        {break_face_size, "face 1 has fewer than 3"},
        {break_order, "face 1 has fewer"},
        {break_wire, "wire vertex 4"},
        {break_wire_offset, "wire 0"},
        {break_point, "point 0"},
        {break_value_count, "attribute 0 has 6 values"},
        {break_value_index, "index 4, past the count 4"},
        {break_label, "material 0"},
        {break_crease, "crease 1"},
        {break_sharp_vertex, "sharp vertex 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = laden(context);
        cases[i].damage(mesh);
        assert_int_equal(mt_mesh_validate(context, mesh), MT_ERROR_INTERNAL);
        const char *message = mt_context_error(context)->message;
        if (!strstr(message, cases[i].part)) {
            fail_msg("\"%s\" does not contain \"%s\"", message, cases[i].part);
        }
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* ---- missing memory: at each n-th allocation an error, nothing left, and the mesh that was there untouched ---- */

static mt_status make(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    (void)mesh;
    return test_laden_mesh(context, out);
}

static mt_status copy(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    return mt_mesh_copy(context, mesh, out);
}

static mt_status expand(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    return mt_mesh_expand_faces(context, mesh);
}

static mt_status narrow(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    return mt_mesh_set_position_type(context, mesh, MT_F32, NULL);
}

static mt_status add_attribute(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_attribute_layout layout = {.name = "new",
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = MT_U8,
                                  .component_count = 2,
                                  .value_count = 3,
                                  .indexed = true};
    mt_attribute *attribute;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    assert_int_equal(attribute != NULL, status == MT_OK);
    if (attribute) {
        mt_mesh_remove_attribute(context, mesh, mesh->attribute_count - 1);
    }
    return status;
}

static mt_status add_labels(mt_context *context, mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_labels *labels;
    mt_index number;
    mt_status status = mt_mesh_add_labels(context, mesh, MT_LABEL_PART, &labels);
    return status == MT_OK ? mt_labels_add_name(context, labels, "wheel", &number) : status;
}

static mt_mesh *two_triangles(mt_context *context)
{
    static const double positions[12] = {0};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 2, 1, 3};
    return test_mesh(context, 4, positions, 2, faces);
}

static void sweep(mt_status (*operation)(mt_context *, mt_mesh *, mt_mesh **), bool of_triangles)
{
    bool succeeded = false;
    for (uint64_t failing = 1; !succeeded; failing++) {
        mt_context *counter = test_context();
        mt_mesh *mesh = of_triangles ? two_triangles(counter) : laden(counter), *out = NULL;
        uint64_t used = mt_context_allocation_count(counter);
        mt_mesh_destroy(counter, mesh);
        test_context_end(counter);

        mt_context_options options = {.failing_allocation = used + failing};
        mt_context *context = mt_context_create(&options);
        assert_non_null(context);
        mesh = of_triangles ? two_triangles(context) : laden(context);
        mt_status status = operation(context, mesh, &out);
        succeeded = status == MT_OK;
        assert_true(succeeded || (status == MT_ERROR_OUT_OF_MEMORY && !out));
        assert_int_equal(mt_context_error(context)->status, status);
        assert_true(!succeeded || failing > 1);
        assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
        mt_mesh_destroy(context, out);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
        assert_true(failing < 200);
    }
}

static void test_missing_memory_leaves_nothing_behind(void **state)
{
    (void)state;
    sweep(make, false);
    sweep(copy, false);
    sweep(expand, true);
    sweep(narrow, false);
    sweep(add_attribute, false);
    sweep(add_labels, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_empty_mesh_is_a_mesh),
        cmocka_unit_test(test_counts_past_an_index_are_too_large),
        cmocka_unit_test(test_faces_are_found_from_corners),
        cmocka_unit_test(test_faces_of_one_size_need_no_offsets),
        cmocka_unit_test(test_a_copy_is_equal_and_its_own),
        cmocka_unit_test(test_precision_changes_round_and_count),
        cmocka_unit_test(test_bounds_leave_out_what_is_not_finite),
        cmocka_unit_test(test_validate_names_what_is_broken),
        cmocka_unit_test(test_missing_memory_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
