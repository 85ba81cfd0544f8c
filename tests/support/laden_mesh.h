/* A small mesh that has some of everything a mesh can hold. */
#ifndef TESTS_SUPPORT_LADEN_MESH_H
#define TESTS_SUPPORT_LADEN_MESH_H

#include "tests/support/fixture.h"

/* A square pyramid (a quad and four triangles), two isolated vertices; every attribute domain, an indexed UV with
 * corners without a value, three label sets, two wires, three points, creases, sharp vertices, a material library.
 * Returns the first failure, with nothing left behind, when memory is missing. */
mt_status test_laden_mesh(mt_context *context, mt_mesh **out);

#endif
