/* Transformations: exact where they can be, normals by the inverse transpose, refusals. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/transform.h>

#include <math.h>
#include <string.h>

static const double triangle_positions[] = {1, 2, 3, -0.5, 0.25, 8, 3e-5, -7, 0.1};
static const mt_index triangle_faces[] = {3, 0, 1, 2};

static mt_mesh *triangle(mt_context *context)
{
    return test_mesh(context, 3, triangle_positions, 1, triangle_faces);
}

static mt_attribute *add_normals(mt_context *context, mt_mesh *mesh, const double *normals)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = MT_F64,
                                  .component_count = 3,
                                  .value_count = mesh->vertex_count};
    mt_attribute *attribute = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    memcpy(attribute->values, normals, 3 * sizeof(double) * mesh->vertex_count);
    return attribute;
}

static void a_power_of_two_is_exact_and_leaves_normals(void **state)
{
    (void)state;
    static const double normals[] = {0.6, 0.8, 0, 0.1, 0.2, 0.97, -0.0, 1.0 / 3, 5};
    mt_context *context = test_context();
    mt_mesh *mesh = triangle(context);
    mt_attribute *attribute = add_normals(context, mesh, normals);
    mt_transform scaling = mt_transform_scaling(0x1p-40);
    assert_int_equal(mt_mesh_transform(context, mesh, &scaling), MT_OK);
    for (size_t i = 0; i < 9; i++) {
        assert_true(((double *)mesh->positions)[i] == ldexp(triangle_positions[i], -40));
    }
    assert_memory_equal(attribute->values, normals, sizeof normals);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void the_identity_changes_nothing(void **state)
{
    (void)state;
    static const double positions[] = {0.0, 5e-324, 1e308, INFINITY, 1, 2, 3, NAN, -INFINITY};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 3, positions, 1, triangle_faces);
    mt_transform identity = mt_transform_identity();
    assert_int_equal(mt_mesh_transform(context, mesh, &identity), MT_OK);
    assert_memory_equal(mesh->positions, positions, sizeof positions);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void quarter_turns_are_exact(void **state)
{
    (void)state;
    static const double degrees[] = {90, -270, 450, 90 + 360.0 * 1e6};
    for (size_t i = 0; i < 4; i++) {
        mt_transform turn = mt_transform_rotation(mt_vec3_make(0, 0, 7), degrees[i]);
        mt_vec3 p = mt_transform_point(&turn, mt_vec3_make(0.1, 0.7, 1e-300));
        assert_true(p.x == -0.7 && p.y == 0.1 && p.z == 1e-300);
    }
    mt_transform half = mt_transform_rotation(mt_vec3_make(1, 0, 0), 180);
    mt_vec3 p = mt_transform_point(&half, mt_vec3_make(0.1, 0.7, 3));
    assert_true(p.x == 0.1 && p.y == -0.7 && p.z == -3);
}

static void rotations_keep_lengths_and_angles(void **state)
{
    (void)state;
    test_random random = {7};
    for (int i = 0; i < 2000; i++) {
        mt_vec3 axis = {test_random_unit(&random) - 0.5, test_random_unit(&random) - 0.5, test_random_unit(&random)};
        mt_vec3 p = {test_random_unit(&random), test_random_unit(&random) - 0.5, test_random_unit(&random) - 0.5};
        mt_transform turn = mt_transform_rotation(axis, 720 * (test_random_unit(&random) - 0.5));
        mt_transform back = mt_transform_rotation(axis, 1);
        mt_vec3 q = mt_transform_point(&turn, p);
        assert_true(fabs(mt_vec3_length(q) - mt_vec3_length(p)) <= 4e-16 * 4);
        assert_true(fabs(mt_vec3_dot(q, axis) - mt_vec3_dot(p, axis)) <= 4e-16 * 4);
        mt_transform both = mt_transform_then(&turn, &back);
        mt_vec3 stepwise = mt_transform_point(&back, q), at_once = mt_transform_point(&both, p);
        assert_true(mt_vec3_length(mt_vec3_subtract(stepwise, at_once)) <= 2e-15);
    }
}

/* The normal of the transformed plane is the transformed normal, whatever the matrix does to angles. */
static void normals_stay_normal(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-150, 1e150};
    mt_context *context = test_context();
    for (size_t s = 0; s < 3; s++) {
        mt_transform shear = {{{2, 1, 0}, {0, 1, 0.5}, {0, 0, 3}}, {0, 0, 0}};
        for (int i = 0; i < 9; i++) {
            shear.linear[i / 3][i % 3] *= scales[s];
        }
        mt_mesh *mesh = triangle(context);
        mt_vec3 a = mt_mesh_position(mesh, 0), b = mt_mesh_position(mesh, 1), c = mt_mesh_position(mesh, 2);
        mt_vec3 n = mt_vec3_scale(mt_vec3_normalize(mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a))), 2);
        double normals[] = {n.x, n.y, n.z, n.x, n.y, n.z, 0, 0, 0};
        mt_attribute *attribute = add_normals(context, mesh, normals);
        assert_int_equal(mt_mesh_transform(context, mesh, &shear), MT_OK);
        double scale = 1 / scales[s];
        a = mt_vec3_scale(mt_mesh_position(mesh, 0), scale);
        b = mt_vec3_scale(mt_mesh_position(mesh, 1), scale);
        c = mt_vec3_scale(mt_mesh_position(mesh, 2), scale);
        mt_vec3 expected = mt_vec3_normalize(mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a)));
        const double *got = attribute->values;
        mt_vec3 difference = mt_vec3_subtract(mt_vec3_make(got[0] / 2, got[1] / 2, got[2] / 2), expected);
        assert_true(mt_vec3_length(difference) < 4e-15);
        assert_true(got[6] == 0 && got[7] == 0 && got[8] == 0);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void what_would_flatten_or_mirror_is_refused(void **state)
{
    (void)state;
    static const double factors[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < 4; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = triangle(context);
        mt_transform scaling = mt_transform_scaling(factors[i]);
        assert_int_equal(mt_mesh_transform(context, mesh, &scaling), MT_ERROR_ARGUMENT);
        assert_memory_equal(mesh->positions, triangle_positions, sizeof triangle_positions);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void count_warning(void *user, const char *sentence)
{
    assert_non_null(strstr(sentence, "3 vertices"));
    ++*(int *)user;
}

static void leaving_the_range_of_floats_is_warned_of(void **state)
{
    (void)state;
    int warnings = 0;
    mt_context_options options = {.warning = count_warning, .warning_user = &warnings};
    mt_context *context = mt_context_create(&options);
    mt_mesh *mesh = triangle(context);
    assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F32, NULL), MT_OK);
    mt_transform scaling = mt_transform_scaling(1e39);
    assert_int_equal(mt_mesh_transform(context, mesh, &scaling), MT_OK);
    assert_int_equal(warnings, 1);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_power_of_two_is_exact_and_leaves_normals),
        cmocka_unit_test(the_identity_changes_nothing),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(rotations_keep_lengths_and_angles),
        cmocka_unit_test(normals_stay_normal),
        cmocka_unit_test(what_would_flatten_or_mirror_is_refused),
        cmocka_unit_test(leaving_the_range_of_floats_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
