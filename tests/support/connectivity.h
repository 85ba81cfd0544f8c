/* The connectivity structures behind one table, so that each is held to the same answers. */
#ifndef TESTS_SUPPORT_CONNECTIVITY_H
#define TESTS_SUPPORT_CONNECTIVITY_H

#include "tests/support/fixture.h"

/* One edge of a ring or side of a face: the vertex at its other end (of a face: where the side begins) and the face
 * after it counter-clockwise (of a face: across the side), MT_NONE outside. */
typedef struct test_spoke {
    mt_index neighbor, face;
} test_spoke;

#define TEST_RING_ROOM 4096

typedef struct test_ring {
    mt_index count;
    test_spoke spokes[TEST_RING_ROOM];
} test_ring;

typedef struct test_structure {
    const char *name;
    bool triangles_only;
    mt_status (*create)(mt_context *context, const mt_mesh *mesh, void **out);
    void (*destroy)(mt_context *context, void *structure);
    mt_status (*validate)(mt_context *context, const void *structure);
    mt_status (*to_mesh)(mt_context *context, const void *structure, const mt_mesh *source, mt_mesh **out);
    uint64_t (*size)(const void *structure);
    uint64_t (*hash)(const void *structure); /* of all its arrays */
    /* Adds the spokes of a vertex, or the sides of a face, in the order in which the structure's circulator meets them;
     * clockwise ones face the same faces. */
    void (*vertex_ring)(const void *structure, mt_index vertex, bool clockwise, test_ring *ring);
    void (*face_ring)(const void *structure, mt_index face, bool clockwise, test_ring *ring);
} test_structure;

#define TEST_STRUCTURE_COUNT 3
extern const test_structure test_structures[TEST_STRUCTURE_COUNT];

#endif
