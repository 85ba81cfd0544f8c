/* Surgery on a plain list of faces, straight from the definitions: the change is made whatever comes of it, and the
 * list is looked at afterwards. Slow, and without any structure that could be wrong. */
#ifndef TESTS_SUPPORT_SURGERY_MODEL_H
#define TESTS_SUPPORT_SURGERY_MODEL_H

#include "tests/support/surgery.h"

#define TEST_MODEL_SIDES 30
#define TEST_MODEL_VERTICES 600
#define TEST_MODEL_FACES 1200

typedef struct test_model_face {
    mt_index count; /* 0: deleted */
    mt_index vertices[TEST_MODEL_SIDES];
} test_model_face;

typedef struct test_model {
    mt_index vertex_count, face_count;
    uint8_t deleted[TEST_MODEL_VERTICES];
    test_model_face faces[TEST_MODEL_FACES];
} test_model;

void test_model_read(test_model *model, const mt_mesh *mesh);

/* Makes the change; false when it names what is not there, or what the operation has no meaning for. */
bool test_model_apply(test_model *model, const test_operation *operation);

/* Whether the operation may turn one model into the other: the faces stay an oriented manifold, of the same Euler
 * characteristic and with the same isolated vertices but where faces are removed or added, and no more faces lie back
 * to back than did. */
bool test_model_allows(const test_model *before, const test_model *after, const test_operation *operation);

/* The living face that runs from u to v, MT_NONE when there is none. */
mt_index test_model_face_of(const test_model *model, mt_index u, mt_index v);

/* What is left, in its order, with all vertices at the origin. maps, of vertex_count and face_count, receive the new
 * numbers. */
mt_mesh *test_model_mesh(mt_context *context, const test_model *model, mt_index *vertex_map, mt_index *face_map);

/* Asserts that the faces agree, each beginning at any of its vertices. */
void test_same_faces(const mt_mesh *a, const mt_mesh *b);

#endif
