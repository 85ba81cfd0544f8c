/* Replaces what the state holds by the next level of it. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_LEVEL_H
#define LIB_ALGORITHMS_SUBDIVIDE_LEVEL_H

#include "lib/algorithms/subdivide_field.h"

/* With `result` (else NULL) the level is the last one, and its values and corners go there where they can. On failure
 * the state is as it was. */
mt_status mt_subdivide_level(mt_context *context, mt_subdivide_state *state, const mt_mesh *result);

#endif
