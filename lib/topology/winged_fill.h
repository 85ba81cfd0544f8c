/* Filling a winged-edge structure from paired sides that are fit for it. */
#ifndef MT_TOPOLOGY_WINGED_FILL_H
#define MT_TOPOLOGY_WINGED_FILL_H

#include "lib/topology/edge_chain.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/winged_edge.h>

/* Either fills edges, vertices and faces, and links the boundary. Where several fans meet in a vertex only one of them
 * is on its ring. */

/* From paired sides, all boundary or regular. Overwrites pairs->next_side. */
void mt_winged_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure);

/* From the faces themselves, of which none of more than three sides may name a vertex twice, by way of empty chains
 * with room for edge_room edges, as many as the structure has; sets its edge_count. False when that is too little or
 * the structure cannot hold the mesh. */
bool mt_winged_fill_by_chains(const mt_mesh *mesh, edge_chains *chains, mt_index edge_room,
                              mt_winged_edge_mesh *structure);

#endif
