/* The finished level moved to the limit surface. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_LIMIT_H
#define LIB_ALGORITHMS_SUBDIVIDE_LIMIT_H

#include "lib/algorithms/subdivide_field.h"

/* Moves the vertices of `result`, whose corners and sharpness are the state's (topologies[0] with its twins), to their
 * limits, and puts the limit's normals in the place of those carried: on vertices, or on corners by an index where
 * creases and corners part them. O(corners), and as mt_limit_refine at each semi-sharp vertex and dart. */
mt_status mt_subdivide_to_limit(mt_context *context, mt_subdivide_state *state, mt_mesh *result);

#endif
