/* Checking a triangle-neighbour structure, whoever is to blame for it. */
#ifndef MT_TOPOLOGY_TRIANGLE_VALIDATE_H
#define MT_TOPOLOGY_TRIANGLE_VALIDATE_H

#include <meshtool/triangle_neighbor.h>

/* As mt_triangle_neighbor_validate, but a violation is reported as `status`. */
mt_status mt_triangle_neighbor_inspect(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                       mt_status status);

#endif
