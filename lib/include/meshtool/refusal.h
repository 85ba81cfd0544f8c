/* What structures and operations for oriented manifolds cannot take, refused alike by all of them: the first offender
 * in the order of the mesh is named, and what can mend it. who_needs is put before "a manifold mesh": "half-edges
 * need", "Catmull-Clark needs". */
#ifndef MESHTOOL_REFUSAL_H
#define MESHTOOL_REFUSAL_H

#include <meshtool/edge_pairs.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Whether no face of more than three sides names a vertex twice (a triangle that does has a side a = b, which any
 * builder meets). O(corners) time; 1 byte a face meanwhile. */
mt_status mt_polygons_are_simple(mt_context *context, const mt_mesh *mesh, bool *simple);

/* MT_OK, or an error that names the first degenerate face or non-manifold edge (MT_ERROR_NOT_MANIFOLD) or misoriented
 * edge (MT_ERROR_NOT_ORIENTED), in that order. pairs are the mesh's. O(corners) time; 1 byte a face meanwhile. */
mt_status mt_refuse_sides(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, const char *who_needs);

/* The failure that names the first vertex where fans of faces meet that share no edge there; there must be one, and all
 * sides must be boundary or regular. Pairs the sides again: an error has time. */
mt_status mt_refuse_vertex(mt_context *context, const mt_mesh *mesh, const char *who_needs);

#ifdef __cplusplus
}
#endif
#endif
