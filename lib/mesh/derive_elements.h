/* What follows the vertices of a derived mesh, and the normals of faces that were turned. */
#ifndef MT_MESH_DERIVE_ELEMENTS_H
#define MT_MESH_DERIVE_ELEMENTS_H

#include <meshtool/derive.h>

/* Wires, points, sharpness and library names, renumbered; those that name a dropped vertex are dropped. */
mt_status mt_derive_elements(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                             mt_mesh *mesh);

/* Turns the corner and face normals of faces that run the other way round than their sources. */
mt_status mt_derive_turned_normals(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                                   mt_mesh *mesh);

#endif
