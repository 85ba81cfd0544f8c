/* After random sequences of surgery values that were continuous still agree with the positions to the bit, and every
 * structure gives the same ones. */
#include "tests/support/surgery_case.h"
#include "tests/support/surgery_sequence.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Positions at random, and the same three numbers as attributes of all kinds. */
static mt_mesh *continuous_mesh(mt_context *context, size_t which)
{
    mt_mesh *mesh = test_patient_mesh(context, which);
    mt_index count = mesh->vertex_count;
    const mt_attribute_layout layouts[] = {
        {"vertex", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_F64, 3, count, false},
        {"corner", MT_SEMANTIC_GENERIC, MT_DOMAIN_CORNER, MT_F64, 3, mesh->corner_count, false},
        {"indexed", MT_SEMANTIC_UV, MT_DOMAIN_CORNER, MT_F64, 3, count, true},
        {"single", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_F32, 3, count, false},
        {"whole", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_U16, 1, count, false},
    };
    test_random random = {which};
    for (mt_index v = 0; v < count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_make(test_random_unit(&random), test_random_unit(&random), 2));
    }
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        mt_attribute *attribute = test_surgery_attribute(context, mesh, &layouts[i]);
        bool on_corners = attribute->domain == MT_DOMAIN_CORNER && !attribute->indices;
        for (mt_index k = 0; k < attribute->value_count; k++) {
            mt_vec3 p = mt_mesh_position(mesh, on_corners ? mesh->corner_vertices[k] : k);
            const double values[3] = {attribute->component_count == 1 ? k : p.x, p.y, p.z};
            for (uint32_t j = 0; j < attribute->component_count; j++) {
                mt_attribute_set(attribute, k, j, values[j]);
            }
        }
        if (attribute->indices) {
            memcpy(attribute->indices, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
        }
    }
    return mesh;
}

static void expect_continuous(const mt_mesh *mesh, mt_index source_count)
{
    const mt_attribute *vertex = test_surgery_find(mesh, "vertex"), *corner = test_surgery_find(mesh, "corner"),
                       *indexed = test_surgery_find(mesh, "indexed");
    const mt_attribute *single = test_surgery_find(mesh, "single"), *whole = test_surgery_find(mesh, "whole");
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        const double values[3] = {p.x, p.y, p.z};
        for (uint32_t j = 0; j < 3; j++) {
            assert_true(mt_attribute_get(vertex, v, j) == values[j]);
            assert_true(fabs(mt_attribute_get(single, v, j) - values[j]) < 1e-5);
        }
        assert_true(mt_attribute_get(whole, v, 0) < source_count);
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]);
        const double values[3] = {p.x, p.y, p.z};
        for (uint32_t j = 0; j < 3; j++) {
            assert_true(mt_attribute_get(corner, c, j) == values[j]);
            assert_true(mt_attribute_get(indexed, indexed->indices[c], j) == values[j]);
        }
    }
}

/* Positions, the vertices' values and the corners' agree; the faces were compared already. */
static void expect_same_values(const mt_mesh *a, const mt_mesh *b)
{
    test_same_faces(a, b);
    assert_memory_equal(a->positions, b->positions, 3 * a->vertex_count * sizeof(double));
    assert_memory_equal(test_surgery_find(a, "whole")->values, test_surgery_find(b, "whole")->values,
                        a->vertex_count * sizeof(uint16_t));
    for (mt_index face = 0; face < a->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(a, face); c < mt_mesh_face_end(a, face); c++) {
            mt_index d = test_surgery_corner(b, face, a->corner_vertices[c]);
            assert_true(mt_attribute_get(test_surgery_find(a, "corner"), c, 0) ==
                        mt_attribute_get(test_surgery_find(b, "corner"), d, 0));
        }
    }
}

/* Added faces have no values, so none are added where values must stay continuous, and few removed. */
static void run_sequence(mt_context *context, size_t which, bool adds)
{
    bool triangles = test_patients[which].triangles;
    mt_mesh *source = continuous_mesh(context, which), *first = NULL;
    for (size_t i = 0; i < test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i];
        if (surgeon->triangles_only && !triangles) {
            continue;
        }
        test_model *model = malloc(sizeof *model);
        assert_non_null(model);
        test_model_read(model, source);
        void *surgery = test_surgery_begin(context, surgeon, source);
        test_random random = {which};
        int done = 0;
        for (int turn = 0; turn < 300; turn++) {
            test_operation operation = test_random_operation(&random, model, triangles);
            bool skips = !adds && (operation.kind == TEST_ADD_FACE || (operation.kind == TEST_REMOVE_FACE && turn % 4));
            if (!skips && surgeon->judge(surgery, &operation) == MT_SURGERY_ALLOWED) {
                test_surgery_operate(context, surgeon, surgery, operation);
                assert_true(test_model_apply(model, &operation));
                done++;
            }
        }
        assert_true(done > 50);
        free(model);
        mt_mesh *mesh = test_surgery_finish(context, surgeon, surgery, source);
        if (!adds) {
            expect_continuous(mesh, source->vertex_count);
        }
        if (first) {
            expect_same_values(first, mesh);
            mt_mesh_destroy(context, mesh);
        } else {
            first = mesh;
        }
    }
    mt_mesh_destroy(context, first);
    mt_mesh_destroy(context, source);
}

static void continuous_values_stay_with_the_positions(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t which = 0; which < TEST_PATIENT_COUNT; which++) {
        run_sequence(context, which, false);
        run_sequence(context, which, true);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(continuous_values_stay_with_the_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
