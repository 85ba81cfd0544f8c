/* Sharpness from level to level. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_CREASE_H
#define LIB_ALGORITHMS_SUBDIVIDE_CREASE_H

#include "lib/algorithms/subdivide_field.h"

/* Finds the mesh's creases on topologies[0], of level 0. */
mt_status mt_subdivide_creases_create(mt_context *context, mt_subdivide_state *state);

/* Replaces the state's creases by those of the next level; topologies[0] is still this one's. */
mt_status mt_subdivide_creases_refine(mt_context *context, mt_subdivide_state *state);

/* Adds the sharpness that is left after level_count levels to the result.  */
mt_status mt_subdivide_sharpness_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                        mt_mesh *result);

#endif
