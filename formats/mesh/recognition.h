/* Which format a file is in: by its content first, then by its name. */
#ifndef MESHTOOL_MESH_RECOGNITION_H
#define MESHTOOL_MESH_RECOGNITION_H

#include <meshtool/mesh_format.h>

/* The format to read the input with. `wanted` (may be NULL) is an extension that decides alone. A content that
 * belies the name is warned of, and wins. MT_ERROR_SYNTAX when neither content nor name tells, or for 0 bytes. */
mt_status mt_recognise_mesh(mt_context *context, mt_input *input, const char *wanted, const mt_mesh_format **out);

#endif
