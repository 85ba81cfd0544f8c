/* The vertices of a mesh, for faces that a structure gives back. */
#ifndef MT_TOPOLOGY_SOURCE_MESH_H
#define MT_TOPOLOGY_SOURCE_MESH_H

#include <meshtool/mesh.h>

/* Makes a mesh of the layout's counts with the positions of `source`; its faces are the caller's to fill.
 * MT_ERROR_ARGUMENT when `source` has another number of vertices than the layout; its position type is taken. */
mt_status mt_source_mesh_create(mt_context *context, const mt_mesh *source, const mt_mesh_layout *layout,
                                mt_mesh **out);

#endif
