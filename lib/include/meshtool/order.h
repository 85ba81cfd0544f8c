/* The order of faces and of vertices, for caches: of transformed vertices, and of memory. By libmeshoptimizer; where
 * meshtool was built without it (MESHTOOL_MESHOPT), both are MT_ERROR_UNSUPPORTED. */
#ifndef MESHTOOL_ORDER_H
#define MESHTOOL_ORDER_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The same mesh with its faces in an order in which few vertices are transformed twice, whatever the size of the cache
 * (the n-gons by the first of their triangles). All that lies on faces and corners follows. O(size). *out is the
 * caller's. */
mt_status mt_mesh_order_faces(mt_context *context, const mt_mesh *mesh, mt_mesh **out);

/* The same mesh with its vertices in the order in which faces first use them, those that no face uses behind. All that
 * lies on vertices follows. O(size). *out is the caller's. */
mt_status mt_mesh_order_vertices(mt_context *context, const mt_mesh *mesh, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
