/* Filling a half-edge structure from paired sides that are fit for it. */
#ifndef MT_TOPOLOGY_HALFEDGE_FILL_H
#define MT_TOPOLOGY_HALFEDGE_FILL_H

#include "lib/topology/open_sides.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/halfedge.h>

/* Fills the structure straight from the faces, of which none of more than three sides may name a vertex twice, its
 * arrays given with room for `edge_room` edges. False where it cannot: more edges, long lists, or a mesh that must be
 * refused; what is filled then is of no use. Where it can, rings still have to be checked. */
bool mt_halfedge_fill_open(const mt_mesh *mesh, const open_sides *open, mt_index edge_room,
                           mt_halfedge_mesh *structure);

/* Fills half-edges, faces and boundary loops; all sides must be boundary or regular. Overwrites
 * pairs->next_side with each corner's half-edge. False when two boundary loops meet in a vertex: then the structure
 * is of no use. */
bool mt_halfedge_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_halfedge_mesh *structure);

#endif
