/* The rules of a level: values at the vertices of the next topology from those of this one. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_VALUES_H
#define LIB_ALGORITHMS_SUBDIVIDE_VALUES_H

#include "lib/algorithms/subdivide_pass.h"

typedef enum mt_subdivide_rule {
    MT_SUBDIVIDE_SMOOTH,              /* Catmull and Clark's masks, the cubic B-spline's along boundaries */
    MT_SUBDIVIDE_SMOOTH_BUT_BOUNDARY, /* the same, but what is on boundaries stays */
    MT_SUBDIVIDE_LINEAR,              /* old values stay, means of edges and faces join them */
    MT_SUBDIVIDE_ORIGIN               /* mt_index: the value of the element's first corner, unmixed */
} mt_subdivide_rule;

/* Adds the loops that refine some values to the two passes of a level. `type` is MT_F32 or MT_F64, MT_U32 for
 * MT_SUBDIVIDE_ORIGIN (of one component). target has room for the vertices of the next level. Smooth rules
 * need vertex_corners. The same bits for any number of threads, for any rotation, reversal and renumbering of the
 * faces, and for mirrored values mirrored ones (subdivide_sum.h). */
void mt_subdivide_values_plan(const mt_subdivide_topology *topology, mt_subdivide_rule rule, mt_type type,
                              uint32_t component_count, const void *source, void *target, mt_subdivide_pass *first,
                              mt_subdivide_pass *second);

/* Makes the edge points beside triangles anew, by the smooth-triangle rule: to be added after the above. Level 0 only.
 */
void mt_subdivide_triangles_plan(const mt_subdivide_topology *topology, mt_type type, uint32_t component_count,
                                 const void *source, void *target, mt_subdivide_pass *second);

/* The most loops that it adds to one pass. */
size_t mt_subdivide_values_loop_count(uint32_t component_count);

#endif
