/* Surgery, on every structure from one table: random sequences of operations on meshes of every kind. Each structure
 * must give the same verdict, a change of the plain list of faces says whether it is right, and what is left is the
 * same on all of them and in that list. */
#include "tests/support/surgery_sequence.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

#define SURGEON_ROOM 8

typedef struct operating_table {
    mt_context *context;
    bool triangles;
    void *surgeries[SURGEON_ROOM]; /* NULL: not for polygons */
    test_model *model, *trial;
    mt_index verdicts[TEST_OPERATION_KIND_COUNT][MT_SURGERY_VERDICT_COUNT];
} operating_table;

static void begin(operating_table *at, const mt_mesh *mesh)
{
    test_model_read(at->model, mesh);
    for (size_t i = 0; i < test_surgeon_count; i++) {
        at->surgeries[i] = NULL;
        if (at->triangles || !test_surgeons[i].triangles_only) {
            assert_int_equal(test_surgeons[i].create(at->context, mesh, &at->surgeries[i]), MT_OK);
        }
    }
}

static void end(operating_table *at)
{
    for (size_t i = 0; i < test_surgeon_count; i++) {
        test_surgeons[i].destroy(at->context, at->surgeries[i]);
    }
}

static void expect_map(const mt_surgery_map *map, const test_model *model, const mt_index *vertices,
                       const mt_index *faces)
{
    assert_int_equal(map->vertex_count, model->vertex_count);
    assert_int_equal(map->face_count, model->face_count);
    assert_memory_equal(map->vertices, vertices, model->vertex_count * sizeof *vertices);
    assert_memory_equal(map->faces, faces, model->face_count * sizeof *faces);
}

/* Compacts and validates every structure and compares it with the list; returns that list as a mesh. */
static mt_mesh *examine(operating_table *at)
{
    mt_index vertices[TEST_MODEL_VERTICES], faces[TEST_MODEL_FACES];
    mt_mesh *expected = test_model_mesh(at->context, at->model, vertices, faces);
    for (size_t i = 0; i < test_surgeon_count; i++) {
        if (at->surgeries[i]) {
            mt_surgery_map map;
            mt_mesh *mesh = NULL;
            mt_status status = test_surgeons[i].faces(at->context, at->surgeries[i], &map, &mesh);
            if (status != MT_OK) {
                print_message("%s: %s\n", test_surgeons[i].name, mt_context_error(at->context)->message);
            }
            assert_int_equal(status, MT_OK);
            expect_map(&map, at->model, vertices, faces);
            test_same_faces(expected, mesh);
            mt_surgery_map_release(at->context, &map);
            mt_mesh_destroy(at->context, mesh);
        }
    }
    return expected;
}

static void print_operation(const operating_table *at, const test_operation *operation)
{
    static const char *const kinds[] = {"swap", "split edge", "split vertex", "collapse", "remove", "add"};
    print_message("%s a %u b %u c %u face %u:", kinds[operation->kind], operation->a, operation->b, operation->c,
                  operation->face);
    for (mt_index i = 0; i < operation->count; i++) {
        print_message(" %u", operation->vertices[i]);
    }
    for (mt_index f = 0; f < at->model->face_count; f++) {
        print_message("%s", at->model->faces[f].count ? "\n  " : "");
        for (mt_index i = 0; i < at->model->faces[f].count; i++) {
            print_message("%u ", at->model->faces[f].vertices[i]);
        }
    }
    print_message("\n");
}

/* The verdict that all structures give, right by the definitions. */
static mt_surgery_verdict judge(operating_table *at, const test_operation *operation)
{
    *at->trial = *at->model;
    bool allowed = test_model_apply(at->trial, operation) && test_model_allows(at->model, at->trial, operation);
    mt_surgery_verdict verdict = MT_SURGERY_VERDICT_COUNT;
    for (size_t i = 0; i < test_surgeon_count; i++) {
        if (!at->surgeries[i]) {
            continue;
        }
        mt_surgery_verdict own = test_surgeons[i].judge(at->surgeries[i], operation);
        if ((own == MT_SURGERY_ALLOWED) != allowed || (i > 0 && own != verdict)) {
            print_operation(at, operation);
            print_message("%s: %s; the first: %s; by definition %d\n", test_surgeons[i].name,
                          mt_surgery_verdict_words(own), i ? mt_surgery_verdict_words(verdict) : "-", allowed);
            fail();
        }
        verdict = own;
    }
    at->verdicts[operation->kind][verdict]++;
    return verdict;
}

static void operate(operating_table *at, const test_operation *operation)
{
    bool allowed = judge(at, operation) == MT_SURGERY_ALLOWED;
    for (size_t i = 0; i < test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i];
        if (at->surgeries[i] && allowed) {
            assert_int_equal(surgeon->operate(at->context, at->surgeries[i], operation), MT_OK);
        } else if (at->surgeries[i]) {
            uint64_t before = surgeon->hash(at->surgeries[i]);
            assert_int_equal(surgeon->operate(at->context, at->surgeries[i], operation), MT_ERROR_ARGUMENT);
            assert_true(surgeon->hash(at->surgeries[i]) == before);
            mt_context_clear_error(at->context);
        }
    }
    if (allowed) {
        *at->model = *at->trial;
    }
}

static bool is_full(const test_model *model)
{
    bool full = model->vertex_count + 20 > TEST_MODEL_VERTICES || model->face_count + 20 > TEST_MODEL_FACES;
    for (mt_index f = 0; f < model->face_count; f++) {
        full = full || model->faces[f].count + 2 > TEST_MODEL_SIDES;
    }
    return full;
}

/* So many operations; looks at the result often, and goes on with the compacted mesh now and then. */
static void operate_at_random(operating_table *at, size_t which, int count, uint64_t seed)
{
    at->triangles = test_patients[which].triangles;
    test_random random = {seed};
    mt_mesh *mesh = test_patient_mesh(at->context, which);
    begin(at, mesh);
    for (int i = 0; i < count; i++) {
        test_operation operation = test_random_operation(&random, at->model, at->triangles);
        operate(at, &operation);
        bool full = is_full(at->model);
        if (i % 10 == 0 || full) {
            mt_mesh_destroy(at->context, mesh);
            mesh = examine(at);
        }
        if (i % 200 == 0 || full) {
            end(at);
            begin(at, mesh);
        }
    }
    end(at);
    mt_mesh_destroy(at->context, mesh);
}

static void open_table(operating_table *at)
{
    memset(at, 0, sizeof *at);
    at->context = test_context();
    at->model = malloc(sizeof *at->model);
    at->trial = malloc(sizeof *at->trial);
    assert_true(at->model && at->trial && test_surgeon_count <= SURGEON_ROOM);
}

static void close_table(operating_table *at)
{
    free(at->model);
    free(at->trial);
    test_context_end(at->context);
}

/* A sequence that met only easy cases would show nothing: every verdict that an operation can have must be met. */
static void expect_verdicts(const operating_table *at)
{
    static const unsigned met[TEST_OPERATION_KIND_COUNT] = {
        [TEST_SWAP_EDGE] = 1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_BOUNDARY_EDGE |
                           1u << MT_SURGERY_NOT_TRIANGLES | 1u << MT_SURGERY_EDGE_EXISTS,
        [TEST_SPLIT_EDGE] = 1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_DUPLICATE_FACE,
        [TEST_SPLIT_VERTEX] =
            1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_INTERIOR_VERTEX | 1u << MT_SURGERY_DUPLICATE_FACE,
        [TEST_COLLAPSE_EDGE] = 1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_LONE_FACE |
                               1u << MT_SURGERY_DUPLICATE_FACE | 1u << MT_SURGERY_PINCH |
                               1u << MT_SURGERY_COMMON_NEIGHBOR | 1u << MT_SURGERY_COMMON_FACE,
        [TEST_REMOVE_FACE] = 1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_PINCH,
        [TEST_ADD_FACE] = 1u << MT_SURGERY_NO_ELEMENT | 1u << MT_SURGERY_NOT_A_FACE | 1u << MT_SURGERY_EDGE_EXISTS |
                          1u << MT_SURGERY_PINCH | 1u << MT_SURGERY_DUPLICATE_FACE,
    };
    for (int kind = 0; kind < TEST_OPERATION_KIND_COUNT; kind++) {
        assert_true(at->verdicts[kind][MT_SURGERY_ALLOWED] > 800);
        for (unsigned verdict = 1; verdict < MT_SURGERY_VERDICT_COUNT; verdict++) {
            bool expected = met[kind] & 1u << verdict;
            if (expected != (at->verdicts[kind][verdict] > 0)) {
                print_message("kind %d: %s was met %u times\n", kind, mt_surgery_verdict_words(verdict),
                              at->verdicts[kind][verdict]);
            }
            assert_int_equal(expected, at->verdicts[kind][verdict] > 0);
        }
    }
}

static void random_operations_agree_with_the_list_of_faces(void **state)
{
    (void)state;
    operating_table at;
    open_table(&at);
    for (size_t which = 0; which < TEST_PATIENT_COUNT; which++) {
        operate_at_random(&at, which, 4000, 11 + which);
        for (uint64_t seed = 100; seed < 150; seed++) {
            operate_at_random(&at, which, 30, seed); /* begins have their own cases */
        }
    }
    expect_verdicts(&at);
    close_table(&at);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_operations_agree_with_the_list_of_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
