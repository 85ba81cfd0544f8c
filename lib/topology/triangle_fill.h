/* Filling a triangle-neighbour structure. */
#ifndef MT_TOPOLOGY_TRIANGLE_FILL_H
#define MT_TOPOLOGY_TRIANGLE_FILL_H

#include "lib/topology/edge_chain.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/triangle_neighbor.h>

/* Either fills vertices, neighbours and vertex corners. Where several fans meet in a vertex only one of them can be
 * walked from its corner. */

/* From paired sides, all boundary or regular, whose array becomes the neighbours. */
void mt_triangle_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_triangle_neighbor_mesh *structure);

/* From the triangles themselves, with fewer than 2^31 corners, by way of empty chains with room for edge_room edges.
 * False when that is too little or the structure cannot hold the mesh. */
bool mt_triangle_fill_by_chains(const mt_mesh *mesh, edge_chains *chains, mt_index edge_room,
                                mt_triangle_neighbor_mesh *structure);

#endif
