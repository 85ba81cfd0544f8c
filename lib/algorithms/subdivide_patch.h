/* Values at sharp vertices and edges, in the place of what the rule for all made there. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_PATCH_H
#define LIB_ALGORITHMS_SUBDIVIDE_PATCH_H

#include "lib/algorithms/subdivide_pass.h"
#include "lib/algorithms/subdivide_sharp.h"

/* Adds the loops that patch some values (of which topology, source, target and stride are given) to a pass that runs
 * after the two of the level. `wide`: f64, else f32. In a topology of a corner attribute's values the corners of a
 * patch name values, edges on its seams are left as they are, and so are vertices at which `skipped` (NULL: none, else
 * a byte a patch) is set. */
void mt_subdivide_vertex_patches_add(const mt_subdivide_loop *values, const mt_vertex_patch *patches,
                                     const uint8_t *skipped, uint64_t count, bool wide, mt_subdivide_pass *pass);
void mt_subdivide_patches_add(const mt_subdivide_loop *values, const mt_subdivide_sharp *sharp,
                              const mt_subdivide_patches *patches, const uint8_t *skipped, bool wide,
                              mt_subdivide_pass *pass);

#endif
