/* Filling a winged-edge structure from paired sides that are fit for it. */
#ifndef MT_TOPOLOGY_WINGED_FILL_H
#define MT_TOPOLOGY_WINGED_FILL_H

#include <meshtool/edge_pairs.h>
#include <meshtool/winged_edge.h>

/* Fills edges, vertices and faces, and links the boundary; all sides must be boundary or regular. Overwrites
 * pairs->next_side. Where several fans meet in a vertex only one of them is on its ring. */
void mt_winged_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure);

#endif
