/* Distance to a closed, oriented mesh, negative inside.
 *
 * The sign is that of the angle-weighted pseudonormal at the nearest point, of its face, edge or vertex: Baerentzen and
 * Aanaes, "Signed Distance Computation Using the Angle Weighted Pseudonormal", IEEE TVCG 11 (2005). */
#ifndef MESHTOOL_SIGNED_DISTANCE_H
#define MESHTOOL_SIGNED_DISTANCE_H

#include <meshtool/closest_point.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_signed_distance mt_signed_distance;

/* MT_ERROR_NOT_MANIFOLD when an edge has not exactly two faces, MT_ERROR_NOT_ORIENTED when two run along it alike, each
 * with the first such edge; MT_ERROR_INVALID_MESH when there are no faces or a face's vertex is not finite. The mesh is
 * copied. Self-intersections and nested parts are not looked for: there, inside is what the nearest face says. */
mt_status mt_signed_distance_create(mt_context *context, const mt_mesh *mesh, mt_signed_distance **out);
/* NULL is allowed. */
void mt_signed_distance_destroy(mt_context *context, mt_signed_distance *signed_distance);

/* Below 0 inside, NAN for a point that is not finite. nearest (may be NULL) receives the nearest point; its element is
 * a triangle of the shared triangulation. Thread-safe. */
double mt_signed_distance_at(const mt_signed_distance *signed_distance, mt_vec3 point, mt_closest *nearest);

#ifdef __cplusplus
}
#endif
#endif
