/* What a mesh is, counted by brute force from the definitions, to hold results beside. */
#ifndef TESTS_SUPPORT_CENSUS_H
#define TESTS_SUPPORT_CENSUS_H

#include "tests/support/fixture.h"

typedef struct test_census {
    size_t vertices, faces, edges; /* all vertices */
    size_t isolated_vertices, boundary_edges, non_manifold_edges, misoriented_edges, non_manifold_vertices;
    size_t degenerate_faces;
    size_t components, boundary_loops; /* loops: connected sets of boundary edges */
    int64_t euler_characteristic;
    double volume; /* of fans about each face's first corner, from the origin */
} test_census;

test_census test_census_of(const mt_mesh *mesh);

#endif
