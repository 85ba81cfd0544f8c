/* Adding to the list of what is lost; for formats that change more than their abilities tell. */
#ifndef MESHTOOL_MESH_LOSS_H
#define MESHTOOL_MESH_LOSS_H

#include <meshtool/mesh_format.h>

void mt_loss_add(mt_loss *loss, const char *format, ...) MT_PRINTF(2, 3);
/* "1 wire" or "3 wires"; nothing for 0. */
void mt_loss_add_count(mt_loss *loss, uint64_t count, const char *one, const char *several);
/* Vertices in no face. */
mt_status mt_loss_add_isolated(mt_context *context, const mt_mesh *mesh, mt_loss *loss);
/* MT_ERROR_LOSS with all that is lost, in one sentence; title is the format's. */
mt_status mt_loss_refuse(mt_context *context, const mt_loss *loss, const char *title);

#endif
