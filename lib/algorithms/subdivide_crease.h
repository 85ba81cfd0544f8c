/* Sharpness from level to level. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_CREASE_H
#define LIB_ALGORITHMS_SUBDIVIDE_CREASE_H

#include "lib/algorithms/subdivide_field.h"

/* Replaces the state's creases by those of the next level; topologies[0] is still this one's. */
mt_status mt_subdivide_creases_refine(mt_context *context, mt_subdivide_state *state);

/* Adds the sharpness that is left after level_count levels to the result. Takes the state's creases over. */
mt_status mt_subdivide_sharpness_finish(mt_context *context, mt_subdivide_state *state, unsigned level_count,
                                        mt_mesh *result);

#endif
