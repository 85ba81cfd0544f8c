/* What is asked for in the end: by the options, else by the mesh's tags, else by default. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_SETTINGS_H
#define LIB_ALGORITHMS_SUBDIVIDE_SETTINGS_H

#include <meshtool/subdivide.h>

/* Nothing in *settings is left AS_TAGGED, and level_count is at least 1. options may be NULL. MT_ERROR_ARGUMENT. */
mt_status mt_subdivide_settle(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options,
                              mt_subdivide_options *settings);

/* Per face whether it is a hole, 1 or 0: by the mesh, the list, or as a face of an open boundary. *holes is NULL when
 * none is; free it with mt_free. */
mt_status mt_subdivide_holes(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                             const mt_subdivide_options *settings, uint8_t **holes);

#endif
