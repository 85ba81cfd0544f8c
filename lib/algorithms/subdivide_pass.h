/* A level is two passes over the corners: face points; then, which need those, all the rest. Each pass runs the loops
 * of all values and of the connectivity together, block by block of faces, so that what one loop read is still in the
 * cache for the next, and threads meet twice a level however many attributes there are. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_PASS_H
#define LIB_ALGORITHMS_SUBDIVIDE_PASS_H

#include "lib/algorithms/subdivide_topology.h"

struct mt_subdivide_pass {
    mt_index face_count; /* of the level: cuts the blocks */
    size_t loop_count, capacity;
    mt_subdivide_loop *loops;
};

mt_status mt_subdivide_pass_init(mt_context *context, mt_index face_count, size_t capacity, mt_subdivide_pass *pass);
void mt_subdivide_pass_release(mt_context *context, mt_subdivide_pass *pass);

/* Adds a copy of the loop, to call body with it over 0 .. count - 1; the loops of a pass do not depend on each other.
 */
void mt_subdivide_pass_add(mt_subdivide_pass *pass, const mt_subdivide_loop *loop, mt_parallel_body body,
                           uint64_t count);

void mt_subdivide_pass_run(mt_context *context, mt_subdivide_pass *pass);

#endif
