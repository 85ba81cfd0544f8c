#include "tests/support/surgery_sequence.h"
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

const test_patient test_patients[TEST_PATIENT_COUNT] = {
    {"torus", true},      {"closed fan", true}, {"open fan", true},     {"tetrahedron", true}, {"components", true},
    {"lone faces", true}, {"cube", false},      {"closed cage", false}, {"open cage", false},  {"back to back", true},
};

/* Several tori, fans, isolated vertices and triangles in one mesh. */
static mt_mesh *components(mt_context *context)
{
    mt_mesh *parts[] = {test_torus(context, 4, 3, false), test_fan(context, 5, true), test_torus(context, 3, 3, false),
                        test_fan(context, 4, false)};
    mt_index faces[4 * 64], count = 0, vertex_count = 2;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        for (mt_index c = 0; c < parts[i]->corner_count; c++) {
            if (c % 3 == 0) {
                faces[4 * count++] = 3;
            }
            faces[4 * (count - 1) + 1 + c % 3] = vertex_count + parts[i]->corner_vertices[c];
        }
        vertex_count += parts[i]->vertex_count + 1;
        mt_mesh_destroy(context, parts[i]);
    }
    double *positions = calloc(3 * (size_t)vertex_count, sizeof *positions);
    assert_non_null(positions);
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, count, faces);
    free(positions);
    return mesh;
}

mt_mesh *test_patient_mesh(mt_context *context, size_t which)
{
    const double nowhere[24] = {0};
    const mt_index tetrahedron[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2};
    const mt_index lone[] = {3, 0, 1, 2, 3, 3, 5, 4}, back_to_back[] = {3, 0, 1, 2, 3, 2, 1, 0};
    test_random random = {which};
    switch (which) {
    case 0:
        return test_torus(context, 5, 4, false);
    case 1:
    case 2:
        return test_fan(context, 6, which == 1);
    case 3:
        return test_mesh(context, 4, nowhere, 4, tetrahedron);
    case 4:
        return components(context);
    case 5:
        return test_mesh(context, 8, nowhere, 2, lone);
    case 6:
        return test_cube(context);
    case 7:
    case 8:
        return test_cage(context, &random, 5, 4, which == 7);
    default:
        return test_mesh(context, 3, nowhere, 2, back_to_back);
    }
}

/* Mostly a living one; now and then one of those that are deleted or were never there. */
static mt_index random_vertex(test_random *random, const test_model *model)
{
    mt_index vertex = MT_NONE;
    do {
        vertex = (mt_index)test_random_below(random, (uint64_t)model->vertex_count + 1);
    } while ((vertex == model->vertex_count || model->deleted[vertex]) && test_random_below(random, 100));
    return vertex;
}

/* A living face, MT_NONE when luck or faces are missing. */
static mt_index random_face(test_random *random, const test_model *model)
{
    for (int i = 0; i < 50 && model->face_count; i++) {
        mt_index face = (mt_index)test_random_below(random, model->face_count);
        if (model->faces[face].count) {
            return face;
        }
    }
    return MT_NONE;
}

/* Both ends of a side of a random face, in either direction; now and then any two vertices. */
static void random_edge(test_random *random, const test_model *model, mt_index *a, mt_index *b)
{
    mt_index face = random_face(random, model);
    *a = random_vertex(random, model);
    *b = random_vertex(random, model);
    if (face != MT_NONE && test_random_below(random, 50)) {
        const test_model_face *own = &model->faces[face];
        mt_index i = (mt_index)test_random_below(random, own->count), j = (i + 1) % own->count;
        bool turned = test_random_below(random, 2);
        *a = own->vertices[turned ? j : i];
        *b = own->vertices[turned ? i : j];
    }
}

/* A neighbour of v, now and then MT_NONE. */
static mt_index random_neighbor(test_random *random, const test_model *model, mt_index v)
{
    mt_index neighbors[2 * TEST_MODEL_VERTICES], count = 0;
    for (mt_index f = 0; f < model->face_count; f++) {
        const test_model_face *face = &model->faces[f];
        for (mt_index i = 0; i < face->count && count + 2 <= 2 * TEST_MODEL_VERTICES; i++) {
            if (face->vertices[i] == v) {
                neighbors[count++] = face->vertices[(i + 1) % face->count];
                neighbors[count++] = face->vertices[(i + face->count - 1) % face->count];
            }
        }
    }
    return count == 0 || test_random_below(random, 5) == 0 ? MT_NONE : neighbors[test_random_below(random, count)];
}

/* A vertex to which a side without a face runs from u; any other one when there is none, or by chance. */
static mt_index follow_boundary(test_random *random, const test_model *model, mt_index u)
{
    for (mt_index f = 0; f < model->face_count && test_random_below(random, 200); f++) {
        const test_model_face *face = &model->faces[f];
        for (mt_index i = 0; i < face->count; i++) {
            mt_index v = face->vertices[(i + face->count - 1) % face->count];
            if (face->vertices[i] == u && test_model_face_of(model, u, v) == MT_NONE) {
                return v;
            }
        }
    }
    return random_vertex(random, model);
}

static mt_index boundary_vertex(test_random *random, const test_model *model)
{
    for (int i = 0; i < 30; i++) {
        mt_index a, b;
        random_edge(random, model, &a, &b);
        if (test_model_face_of(model, a, b) == MT_NONE) {
            return a;
        }
    }
    return random_vertex(random, model);
}

/* An isolated vertex, when one is met. */
static mt_index lone_vertex(test_random *random, const test_model *model)
{
    mt_index vertex = random_vertex(random, model);
    for (int i = 0; i < 8 && random_neighbor(random, model, vertex) != MT_NONE; i++) {
        vertex = random_vertex(random, model);
    }
    return vertex;
}

/* Mostly along the boundary: it closes holes, bridges gaps, hangs faces on edges and on isolated vertices. */
static void random_new_face(test_random *random, const test_model *model, bool triangles, test_operation *operation)
{
    operation->count = triangles ? 3 : (mt_index)(2 + test_random_below(random, 4));
    mt_index at = boundary_vertex(random, model);
    for (mt_index i = 0; i < operation->count; i++) {
        operation->vertices[i] = at;
        at = test_random_below(random, 4) ? follow_boundary(random, model, at) : lone_vertex(random, model);
    }
}

static test_operation_kind random_kind(test_random *random, const test_model *model)
{
    static const test_operation_kind grow[] = {TEST_SWAP_EDGE, TEST_COLLAPSE_EDGE, TEST_ADD_FACE,    TEST_SPLIT_EDGE,
                                               TEST_ADD_FACE,  TEST_SPLIT_VERTEX,  TEST_REMOVE_FACE, TEST_SPLIT_VERTEX};
    static const test_operation_kind shrink[] = {TEST_SWAP_EDGE, TEST_SPLIT_EDGE,    TEST_SPLIT_VERTEX,
                                                 TEST_ADD_FACE,  TEST_COLLAPSE_EDGE, TEST_REMOVE_FACE,
                                                 TEST_ADD_FACE,  TEST_COLLAPSE_EDGE};
    mt_index living = 0;
    for (mt_index f = 0; f < model->face_count; f++) {
        living += model->faces[f].count != 0;
    }
    return living < 20 + test_random_below(random, 60) ? grow[test_random_below(random, 8)]
                                                       : shrink[test_random_below(random, 8)];
}

test_operation test_random_operation(test_random *random, const test_model *model, bool triangles)
{
    test_operation operation = {.kind = random_kind(random, model), .a = MT_NONE, .b = MT_NONE, .c = MT_NONE};
    operation.face = MT_NONE;
    operation.weight = (double)test_random_below(random, 5) / 4;
    if (operation.kind == TEST_REMOVE_FACE) {
        operation.face = test_random_below(random, 20) ? random_face(random, model) : random_vertex(random, model);
    } else if (operation.kind == TEST_ADD_FACE) {
        random_new_face(random, model, triangles, &operation);
    } else {
        random_edge(random, model, &operation.a, &operation.b);
    }
    if (operation.kind == TEST_SPLIT_VERTEX) {
        operation.b = test_random_below(random, 20) ? random_neighbor(random, model, operation.a) : operation.b;
        operation.c = random_neighbor(random, model, operation.a);
    }
    return operation;
}
