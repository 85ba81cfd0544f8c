/* The manifold check once more, straight from the words of the contract, in any time. */
#ifndef TESTS_SUPPORT_MANIFOLD_REFERENCE_H
#define TESTS_SUPPORT_MANIFOLD_REFERENCE_H

#include "tests/support/fixture.h"

#include <meshtool/manifold.h>

/* Fills every field of the report but the lists, for a mesh of a few hundred corners; area and volume are those of fans
 * of triangles, right for convex planar faces only. */
void test_manifold_reference(const mt_mesh *mesh, mt_manifold_report *report);

/* Whether the element is a defect of that kind by the same words: a vertex, a face, or the edge of two vertices. */
bool test_vertex_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index vertex);
bool test_face_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index face);
bool test_edge_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index a, mt_index b);

/* Whether two defects of a kind name the same vertices and faces. */
bool test_is_same_element(const mt_defect *a, const mt_defect *b);

/* Whether the face is the first of a component that is inside out, and whether three points are exactly on one line:
 * the latter for coordinates whose bits span little more than a double's, as those of small whole numbers moved and
 * scaled do, the former for such whose differences have 38 bits, and false for others. */
bool test_component_is_inside_out(const mt_mesh *mesh, mt_index face);
bool test_points_are_collinear(mt_vec3 a, mt_vec3 b, mt_vec3 c);

#endif
