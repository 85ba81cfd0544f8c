/* Values at sharp vertices and edges, in the place of what the rule for all made there. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_PATCH_H
#define LIB_ALGORITHMS_SUBDIVIDE_PATCH_H

#include "lib/algorithms/subdivide_pass.h"
#include "lib/algorithms/subdivide_sharp.h"

/* Adds the loops that patch some values to a pass that runs after the two of the level. `wide`: f64, else f32. In a
 * topology of a corner attribute's values the corners of a patch name values, edges on its seams are left as they are,
 * and so are vertices at which `skipped` (NULL: none, else a byte a sharp vertex) is set. */
void mt_subdivide_patches_add(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                              const mt_subdivide_patches *patches, const uint8_t *skipped,
                              const mt_subdivide_loop *values, bool wide, mt_subdivide_pass *pass);

#endif
