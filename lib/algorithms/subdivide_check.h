/* What Catmull-Clark cannot take, found and named. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_CHECK_H
#define LIB_ALGORITHMS_SUBDIVIDE_CHECK_H

#include "lib/algorithms/subdivide_topology.h"

/* MT_OK when every edge is a boundary or regular and no face names a vertex twice. */
mt_status mt_subdivide_check_edges(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs);

/* MT_OK when the faces of each vertex form one fan or ring. After mt_subdivide_check_edges. */
mt_status mt_subdivide_check_rings(mt_context *context, const mt_subdivide_topology *topology);

#endif
