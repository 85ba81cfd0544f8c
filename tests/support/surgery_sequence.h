/* Meshes to operate on, and operations drawn at random that are worth trying on them. */
#ifndef TESTS_SUPPORT_SURGERY_SEQUENCE_H
#define TESTS_SUPPORT_SURGERY_SEQUENCE_H

#include "tests/support/surgery_model.h"

#define TEST_PATIENT_COUNT 10
typedef struct test_patient {
    const char *name;
    bool triangles; /* of triangles alone */
} test_patient;
extern const test_patient test_patients[TEST_PATIENT_COUNT];
mt_mesh *test_patient_mesh(mt_context *context, size_t which);

/* An operation on what the model holds: mostly on edges and faces that are there. It makes the mesh grow while that has
 * few faces, and shrink while it has many. */
test_operation test_random_operation(test_random *random, const test_model *model, bool triangles);

#endif
