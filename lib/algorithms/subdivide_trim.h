/* Faces that took part and are left out. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_TRIM_H
#define LIB_ALGORITHMS_SUBDIVIDE_TRIM_H

#include <meshtool/subdivide.h>

/* Replaces *result by one without the children of holes (1 per face of `mesh`); the vertices stay. A mark of holes and
 * the wish to make some of the boundary are gone with them. On failure *result is as it was. */
mt_status mt_subdivide_trim(mt_context *context, const mt_mesh *mesh, const uint8_t *holes, unsigned level_count,
                            mt_mesh **result);

#endif
