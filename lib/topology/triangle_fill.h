/* Filling a triangle-neighbour structure. */
#ifndef MT_TOPOLOGY_TRIANGLE_FILL_H
#define MT_TOPOLOGY_TRIANGLE_FILL_H

#include "lib/topology/open_sides.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/triangle_neighbor.h>

/* Either fills vertices, neighbours and vertex corners. Where several fans meet in a vertex only one of them can be
 * walked from its corner. */

/* From paired sides, all boundary or regular, whose array becomes the neighbours. */
void mt_triangle_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_triangle_neighbor_mesh *structure);

/* From the triangles themselves. False when lists grow long or the structure cannot hold the mesh; where it can, rings
 * still have to be checked. */
bool mt_triangle_fill_open(const mt_mesh *mesh, const open_sides *open, mt_triangle_neighbor_mesh *structure);

#endif
