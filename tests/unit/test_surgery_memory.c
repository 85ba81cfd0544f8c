/* Surgery without enough memory: the operation fails, nothing has changed, nothing is left behind. */
#include "tests/support/surgery_case.h"
#include "tests/support/surgery_sequence.h"
#include "tests/support/unit.h"

#include <stdlib.h>

#define SCRIPT_ROOM 120

/* Operations of all kinds that are allowed one after the other. */
typedef struct operation_script {
    int count;
    test_operation operations[SCRIPT_ROOM];
} operation_script;

static void write_script(operation_script *out, const mt_mesh *mesh, bool triangles)
{
    test_random random = {17};
    test_model *model = malloc(sizeof *model), *trial = malloc(sizeof *trial);
    assert_true(model && trial);
    test_model_read(model, mesh);
    out->count = 0;
    while (out->count < SCRIPT_ROOM) {
        test_operation operation = test_random_operation(&random, model, triangles);
        *trial = *model;
        if (test_model_apply(trial, &operation) && test_model_allows(model, trial, &operation)) {
            out->operations[out->count++] = operation;
            *model = *trial;
        }
    }
    free(model);
    free(trial);
}

static mt_status follow_script(mt_context *context, const test_surgeon *surgeon, const operation_script *script,
                               void *surgery)
{
    mt_status status = MT_OK;
    for (int i = 0; status == MT_OK && i < script->count; i++) {
        uint64_t before = surgeon->hash(surgery);
        status = surgeon->operate(context, surgery, &script->operations[i]);
        assert_true((surgeon->hash(surgery) == before) == (status != MT_OK));
        if (status != MT_OK) {
            assert_int_equal(surgeon->judge(surgery, &script->operations[i]), MT_SURGERY_ALLOWED);
        }
    }
    return status;
}

/* Something of every kind that follows surgery. */
static void load(mt_context *context, mt_mesh *mesh)
{
    const mt_attribute_layout layouts[] = {
        {"uv", MT_SEMANTIC_UV, MT_DOMAIN_CORNER, MT_F32, 2, mesh->vertex_count, true},
        {"bend", MT_SEMANTIC_GENERIC, MT_DOMAIN_CORNER, MT_F64, 1, mesh->corner_count, false},
        {"normal", MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX, MT_F32, 3, mesh->vertex_count, false},
        {"tint", MT_SEMANTIC_COLOR, MT_DOMAIN_FACE, MT_U8, 4, mesh->face_count, false},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        mt_attribute *attribute = test_surgery_attribute(context, mesh, &layouts[i]);
        for (mt_index value = 0; value < attribute->value_count; value++) {
            for (uint32_t k = 0; k < attribute->component_count; k++) {
                mt_attribute_set(attribute, value, k, value % 7 + k);
            }
        }
        for (mt_index c = 0; attribute->indices && c < mesh->corner_count; c++) {
            attribute->indices[c] = mesh->corner_vertices[c];
        }
    }
    mt_labels *labels = NULL;
    mt_index number;
    assert_int_equal(mt_mesh_add_labels(context, mesh, MT_LABEL_MATERIAL, &labels), MT_OK);
    assert_int_equal(mt_labels_add_name(context, labels, "red", &number), MT_OK);
    mesh->creases = mt_allocate(context, sizeof *mesh->creases);
    mesh->creases[mesh->crease_count++] = (mt_edge_value){mesh->corner_vertices[0], mesh->corner_vertices[1], 2};
    mesh->sharp_vertices = mt_allocate(context, sizeof *mesh->sharp_vertices);
    mesh->sharp_vertices[mesh->sharp_vertex_count++] = (mt_vertex_value){mesh->corner_vertices[0], 3};
}

static mt_status run(mt_context *context, const test_surgeon *surgeon, const mt_mesh *mesh,
                     const operation_script *script)
{
    void *surgery = NULL;
    mt_mesh *left = NULL, *faces = NULL;
    mt_surgery_map map = {0};
    mt_status status = surgeon->create(context, mesh, &surgery);
    assert_true((surgery != NULL) == (status == MT_OK));
    status = status == MT_OK ? follow_script(context, surgeon, script, surgery) : status;
    if (status == MT_OK) {
        status = surgeon->to_mesh(context, surgery, mesh, &left);
        assert_true((left != NULL) == (status == MT_OK));
    }
    if (status == MT_OK) {
        status = surgeon->faces(context, surgery, &map, &faces);
    }
    mt_surgery_map_release(context, &map);
    mt_mesh_destroy(context, left);
    mt_mesh_destroy(context, faces);
    surgeon->destroy(context, surgery);
    return status;
}

static void every_failed_allocation_changes_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t i = 0; i < 2 * test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i / 2];
        size_t patient = i % 2 ? 8 : 4;
        if (surgeon->triangles_only && !test_patients[patient].triangles) {
            continue;
        }
        mt_mesh *mesh = test_patient_mesh(context, patient);
        load(context, mesh);
        operation_script script;
        write_script(&script, mesh, test_patients[patient].triangles);
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        uint64_t nth = 1;
        for (; status == MT_ERROR_OUT_OF_MEMORY; nth++) {
            mt_context_options options = {.failing_allocation = nth, .thread_count = 1};
            mt_context *failing = mt_context_create(&options);
            status = run(failing, surgeon, mesh, &script);
            assert_int_equal(mt_context_error(failing)->status, status);
            test_context_end(failing);
        }
        assert_int_equal(status, MT_OK);
        assert_true(nth > 40);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_failed_allocation_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
