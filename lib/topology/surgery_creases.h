/* Sharpness of edges and vertices, by the log of surgery. */
#ifndef MT_TOPOLOGY_SURGERY_CREASES_H
#define MT_TOPOLOGY_SURGERY_CREASES_H

#include "lib/topology/edit_program.h"

/* Gives the mesh, which has none, the creases and sharp vertices of the source that are left. */
mt_status mt_surgery_creases(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                             const mt_edit_reading *reading, mt_mesh *mesh);

#endif
