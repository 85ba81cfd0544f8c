#ifndef MT_MESH_TRIANGULATE_QUAD_H
#define MT_MESH_TRIANGULATE_QUAD_H

#include <meshtool/mesh.h>

/* Triangulates a face of four sides into two triangles of local corner numbers. */
void mt_triangulate_quad(const mt_mesh *mesh, mt_index face, mt_index triangles[6]);

#endif
