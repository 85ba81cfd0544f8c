/* Small meshes of every kind, for the sweeps: primitives, broken ones, and ones that carry everything a mesh can. */
#ifndef TESTS_SUPPORT_ZOO_H
#define TESTS_SUPPORT_ZOO_H

#include <meshtool/mesh_format.h>

typedef struct test_animal {
    const char *name;
    mt_mesh *mesh;
} test_animal;

#define TEST_ZOO_ROOM 64

/* Makes all of them; returns their number. */
size_t test_zoo(mt_context *context, test_animal *animals);
/* Whether the format may refuse the animal: its numbers are not all finite as floats, and the format needs that. */
bool test_animal_is_refused(const test_animal *animal, const mt_mesh_format *format);

void test_zoo_end(mt_context *context, test_animal *animals, size_t count);

#endif
