/* Filling a half-edge structure from paired sides that are fit for it. */
#ifndef MT_TOPOLOGY_HALFEDGE_FILL_H
#define MT_TOPOLOGY_HALFEDGE_FILL_H

#include "lib/topology/edge_chain.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/halfedge.h>

/* Fills the structure straight from the faces, its arrays given with room for `edge_room` edges, by chains. False where
 * it cannot: more edges, long chains, or a mesh that must be refused; what is filled then is of no use. */
bool mt_halfedge_fill_by_chains(const mt_mesh *mesh, edge_chains *chains, mt_index edge_room,
                                mt_halfedge_mesh *structure);

/* Fills half-edges, faces and boundary loops; all sides must be boundary or regular. Overwrites
 * pairs->next_side with each corner's half-edge. False when two boundary loops meet in a vertex: then the structure
 * is of no use. */
bool mt_halfedge_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_halfedge_mesh *structure);

#endif
