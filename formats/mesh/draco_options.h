/* What the user asked of Draco, for .drc files and for glTF. */
#ifndef MESHTOOL_MESH_DRACO_OPTIONS_H
#define MESHTOOL_MESH_DRACO_OPTIONS_H

#include "formats/codec/draco_job.h"

#include <meshtool/mesh_format.h>

/* Bits for a kind of float attribute, 0: as they are. */
unsigned mt_draco_bits(const mt_draco_options *options, mt_draco_kind kind);

/* Encodes with the options, which are filled into the source. Warns when other vertices or triangles come back than
 * went in; with strict_loss that is MT_ERROR_LOSS. A mesh that edgebreaker cannot hold is encoded sequentially. */
mt_status mt_draco_compress(mt_context *context, mt_draco_source *source, const mt_draco_options *options,
                            bool strict_loss, mt_draco_bytes *out);

/* Adds what the options lose of the mesh. */
mt_status mt_draco_changes(mt_context *context, const mt_mesh *mesh, const mt_draco_options *options, mt_loss *loss);

#endif
