/* Fans of vertices from the order of the faces, without a walk around each. */
#ifndef MT_TOPOLOGY_FAN_MINIMA_H
#define MT_TOPOLOGY_FAN_MINIMA_H

#include <meshtool/vertex_fans.h>

/* Decides every vertex of a mesh whose sides are all boundary or regular and whose faces name no vertex twice. `fans`
 * comes as zeros. *done is false, and fans are of no use, when the order of the faces leaves too many to be walked. */
mt_status mt_fans_by_minima(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, uint8_t *fans,
                            bool *done);

#endif
