/* Sharpness of edges and vertices that were split. */
#ifndef MT_TOPOLOGY_SPLIT_CREASES_H
#define MT_TOPOLOGY_SPLIT_CREASES_H

#include <meshtool/mesh.h>

/* Gives the new edges and vertices of `split`, made from `mesh`, the sharpness of those that they come from.
 * `sources`: per vertex of `split` the one that it is a copy of. O(vertices + corners) for creases spread as on a
 * surface. On failure `split` is whole, but lacks some. */
mt_status mt_split_creases(mt_context *context, const mt_mesh *mesh, const mt_index *sources, mt_mesh *split);

#endif
