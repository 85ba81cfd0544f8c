/* Loop's scheme for triangles, in the frame of Catmull-Clark's: what differs. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_LOOP_H
#define LIB_ALGORITHMS_SUBDIVIDE_LOOP_H

#include "lib/algorithms/subdivide_pass.h"

/* Bodies over the faces: the corners of the next level, and but on the last its twins and ranks. */
void mt_subdivide_loop_refine(void *user, uint64_t begin, uint64_t end);
void mt_subdivide_loop_refine_last(void *user, uint64_t begin, uint64_t end);

/* What an old vertex of this valence moves by: so much of the sum of its neighbours' differences from it. */
double mt_loop_weight(mt_index valence);

/* Adds the loops that refine components loop->offset and up to three more. Smooth rules need vertex_corners of all
 * vertices. */
void mt_subdivide_loop_rules(const mt_subdivide_loop *loop, bool wide, mt_subdivide_pass *pass);

#endif
