/* Why a mesh cannot become a connectivity structure of any kind, and what can be done about it. */
#ifndef MT_TOPOLOGY_REFUSAL_H
#define MT_TOPOLOGY_REFUSAL_H

#include <meshtool/edge_pairs.h>

/* Whether no face of more than three sides names a vertex twice (a triangle that does has a side a = b, which any
 * builder meets). */
mt_status mt_polygons_are_simple(mt_context *context, const mt_mesh *mesh, bool *simple);

/* MT_OK, or an error that names the first degenerate face, non-manifold edge or misoriented edge, in that order. */
mt_status mt_refuse_sides(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs);

/* Names the first vertex where fans of faces meet that share no edge there; there must be one, and all sides must be
 * boundary or regular. Pairs the sides again: an error has time. */
mt_status mt_refuse_vertex(mt_context *context, const mt_mesh *mesh);

#endif
