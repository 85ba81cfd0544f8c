/* Filling a winged-edge structure from paired sides that are fit for it. */
#ifndef MT_TOPOLOGY_WINGED_FILL_H
#define MT_TOPOLOGY_WINGED_FILL_H

#include "lib/topology/open_sides.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/winged_edge.h>

/* Either fills edges, vertices and faces, and links the boundary. Where several fans meet in a vertex only one of them
 * is on its ring. */

/* From paired sides, all boundary or regular. Overwrites pairs->next_side. */
void mt_winged_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure);

/* From the faces themselves, of which none of more than three sides may name a vertex twice, with room for edge_room
 * edges; sets the structure's edge_count. False when that is too little, lists grow long, or the structure cannot hold
 * the mesh. Where it can, rings still have to be checked. */
bool mt_winged_fill_open(const mt_mesh *mesh, const open_sides *open, mt_index edge_room,
                         mt_winged_edge_mesh *structure);

#endif
