/* The sharpness that a subdivision begins with, and what is left of it at the end. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_CREASE_H
#define LIB_ALGORITHMS_SUBDIVIDE_CREASE_H

#include "lib/algorithms/subdivide_field.h"

/* Finds all that is sharp on topologies[0], of level 0: by the mesh, then the angle, then the list of the options. */
mt_status mt_subdivide_creases_create(mt_context *context, mt_subdivide_state *state);

/* Adds the sharpness that is left after level_count levels to the result, whose corners are topologies[0]'s. */
mt_status mt_subdivide_creases_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                      mt_mesh *result);

/* The mesh's creases, those of the angle and those of the options, one after the other: later ones win. Sharp vertices
 * likewise. The caller frees *joined. */
mt_status mt_subdivide_join_creases(mt_context *context, const mt_mesh *mesh, const mt_index *twins,
                                    const mt_subdivide_options *settings, mt_edge_value **joined, mt_index *count);
mt_status mt_subdivide_join_corners(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *settings,
                                    mt_vertex_value **joined, mt_index *count);

#endif
