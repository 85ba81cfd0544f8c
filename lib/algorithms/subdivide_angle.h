/* Creases found by the angle between faces. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_ANGLE_H
#define LIB_ALGORITHMS_SUBDIVIDE_ANGLE_H

#include <meshtool/edge_pairs.h>

/* The edges between two faces whose normals are more than `angle` radians apart, each with `sharpness`, in the order of
 * their first corners. Faces without a normal have no crease. *creases is the caller's to free with mt_free. */
mt_status mt_creases_of_angle(mt_context *context, const mt_mesh *mesh, const mt_index *twins, double angle,
                              double sharpness, mt_edge_value **creases, mt_index *count);

#endif
