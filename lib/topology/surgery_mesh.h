/* What surgery left, as a mesh with everything that lies on the source. */
#ifndef MT_TOPOLOGY_SURGERY_MESH_H
#define MT_TOPOLOGY_SURGERY_MESH_H

#include "lib/topology/surgery_view.h"

/* The faces in the numbers that surgery works with. */
typedef struct mt_surgery_shape {
    mt_index vertex_count, face_count; /* the deleted included */
    const uint8_t *vertex_deleted;
    mt_index *face_offsets; /* face_count + 1; deleted faces are empty */
    mt_index *corner_vertices;
} mt_surgery_shape;

/* Makes the mesh: vertices and faces that are left keep their order. Source and log must belong together, else
 * MT_ERROR_ARGUMENT. O(size + log). */
mt_status mt_surgery_mesh(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                          const mt_surgery_shape *shape, mt_mesh **out);

/* The same, of any structure. */
mt_status mt_surgery_view_mesh(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                               const mt_surgery_view *view, mt_mesh **out);

#endif
