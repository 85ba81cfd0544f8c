/* Surgery on every structure behind one table: operations are named by vertex numbers, which all structures share. */
#ifndef TESTS_SUPPORT_SURGERY_H
#define TESTS_SUPPORT_SURGERY_H

#include "tests/support/fixture.h"

#include <meshtool/edit_log.h>
#include <meshtool/surgery.h>

typedef enum test_operation_kind {
    TEST_SWAP_EDGE,
    TEST_SPLIT_EDGE,
    TEST_SPLIT_VERTEX,
    TEST_COLLAPSE_EDGE,
    TEST_REMOVE_FACE,
    TEST_ADD_FACE,
    TEST_OPERATION_KIND_COUNT
} test_operation_kind;

#define TEST_FACE_ROOM 8

/* Edges run from a to b. Vertex a is split along its edges to b and c, each of which may be MT_NONE. */
typedef struct test_operation {
    test_operation_kind kind;
    mt_index a, b, c;
    mt_index face;                            /* to be removed */
    mt_index count, vertices[TEST_FACE_ROOM]; /* of the face to be added */
    double weight;
} test_operation;

/* One structure. An edge that the structure does not have is a verdict of NO_ELEMENT. */
typedef struct test_surgeon {
    const char *name;
    bool triangles_only;
    mt_status (*create)(mt_context *context, const mt_mesh *mesh, void **out); /* builds, and begins surgery */
    void (*destroy)(mt_context *context, void *surgery);
    mt_surgery_verdict (*judge)(const void *surgery, const test_operation *operation);
    mt_status (*operate)(mt_context *context, void *surgery, const test_operation *operation);
    const mt_edit_log *(*log)(const void *surgery);
    /* Compacts, validates, and gives the faces back on vertices without positions of their own. */
    mt_status (*faces)(mt_context *context, const void *surgery, mt_surgery_map *map, mt_mesh **out);
    mt_status (*to_mesh)(mt_context *context, const void *surgery, const mt_mesh *source, mt_mesh **out);
    /* A number that changes when anything in the structure does, to see that failed operations change nothing. */
    uint64_t (*hash)(const void *surgery);
} test_surgeon;

/* A mesh of so many vertices, all at the origin; NULL when memory is missing. */
mt_mesh *test_points(mt_context *context, mt_index count);

extern const test_surgeon test_surgeons[];
extern const size_t test_surgeon_count;

#endif
