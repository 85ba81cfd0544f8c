/* Each strip in a colour of its own. */
#ifndef MESHTOOL_CLI_STRIP_PAINT_H
#define MESHTOOL_CLI_STRIP_PAINT_H

#include "files.h"

#include <meshtool/strips.h>

/* A colour for every face: that of the strip which the strips command would draw it in, without options. *colors is the
 * caller's, freed with mt_free. */
mt_status cli_strip_colors(mt_context *context, const mt_mesh *mesh, unsigned char **colors);

/* Writes the mesh, or a picture of it, with its strips coloured. */
cli_exit cli_strip_paint(const cli_job *job, const mt_mesh *mesh, const mt_strips *strips, const char *path);

#endif
