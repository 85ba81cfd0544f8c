/* Whether two meshes agree in what a format can hold. */
#ifndef TESTS_SUPPORT_SAME_H
#define TESTS_SUPPORT_SAME_H

#include <meshtool/mesh_format.h>

/* NULL when the meshes agree, to the bit, in everything that `abilities` (of mt_ability) names; else what differs.
 * Without MT_HOLDS_POLYGONS faces are compared as sequences of triangles by position, without MT_HOLDS_INDICES vertices
 * are known by their positions alone. Numbers that one of the two stores as float are compared as floats, colours by
 * their share of the maximum. */
const char *test_difference(mt_context *context, const mt_mesh *a, const mt_mesh *b, unsigned abilities);

#endif
