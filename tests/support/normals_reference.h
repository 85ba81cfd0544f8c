/* Normals by their definitions, in long doubles, face by face and pair by pair: slow, and sharing no code with the
 * library. */
#ifndef TESTS_SUPPORT_NORMALS_REFERENCE_H
#define TESTS_SUPPORT_NORMALS_REFERENCE_H

#include <meshtool/normals.h>

/* The normal of a face, a vertex or a corner by the options; zero where there is none, NaN
 * where its terms cancel so far that doubles keep no direction. */
mt_vec3 test_reference_normal(const mt_mesh *mesh, const mt_normal_options *options, mt_index element);

/* The angle between two directions, right for small ones; NaN when one is zero. */
double test_angle_between(mt_vec3 a, mt_vec3 b);

/* An element's normal as the mesh has it. */
mt_vec3 test_stored_normal(const mt_mesh *mesh, mt_domain domain, mt_index element);

/* Adds normals to the mesh and fails the test when one differs from the reference by more than the tolerance (radians),
 * or is neither of length 1 nor zero; returns the largest difference. */
double test_expect_normals(mt_context *context, mt_mesh *mesh, const mt_normal_options *options, double tolerance,
                           const char *what);

#endif
