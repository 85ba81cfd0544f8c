#ifndef MESHTOOL_PLY_WRITE_H
#define MESHTOOL_PLY_WRITE_H

#include "formats/stream/output.h"

/* Writes a mesh as PLY: little-endian unless the options say otherwise. */
mt_status mt_ply_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);

#endif
