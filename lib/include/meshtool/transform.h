/* Affine transformations of meshes that keep their inside in: scale, rotate, move. */
#ifndef MESHTOOL_TRANSFORM_H
#define MESHTOOL_TRANSFORM_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* p becomes linear * p + translation; linear[row][column]. */
typedef struct mt_transform {
    double linear[3][3];
    mt_vec3 translation;
} mt_transform;

mt_transform mt_transform_identity(void);
mt_transform mt_transform_scaling(double factor);
mt_transform mt_transform_translation(mt_vec3 offset);

/* Turns counter-clockwise about an axis through the origin, seen with the axis pointing at the viewer (Rodrigues'
 * formula). The axis has any length but 0. Multiples of 90 degrees about a coordinate axis are exact. */
mt_transform mt_transform_rotation(mt_vec3 axis, double degrees);

/* What doing `first`, then `second` does. */
mt_transform mt_transform_then(const mt_transform *first, const mt_transform *second);

mt_vec3 mt_transform_point(const mt_transform *transform, mt_vec3 point);

/* What undoes the transformation. False, with *out undefined, when nothing does: a number is not finite or too large,
 * or the determinant of `linear` is less than 2^-36 of the product of its rows' lengths. Mirror images can be undone.
 */
bool mt_transform_inverse(const mt_transform *transform, mt_transform *out);

/* Transforms the mesh in place: positions in double arithmetic, rounded once to their precision (past its range they
 * become infinite, with a warning); normals by the inverse transpose, their lengths kept. A scale by a power of two is
 * exact and leaves normals as they are, bit for bit. Other attributes stay.
 * MT_ERROR_ARGUMENT when a number is not finite, or when the determinant of `linear` is not positive: the faces would
 * have no area, or look inwards. */
mt_status mt_mesh_transform(mt_context *context, mt_mesh *mesh, const mt_transform *transform);

#ifdef __cplusplus
}
#endif
#endif
