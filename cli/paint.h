/* What --paint options share: a copy of the mesh in new colours, as a file or as a picture. */
#ifndef MESHTOOL_CLI_PAINT_H
#define MESHTOOL_CLI_PAINT_H

#include "files.h"

/* Whether the output is to be a picture, by --to or else by its extension. */
bool cli_paint_is_picture(const cli_job *job, const char *path);

/* Checks an output of --paint before anything is read: a picture, or a mesh format that holds the colours (`ability`),
 * which the message calls colours of `elements`. */
cli_exit cli_paint_check_output(const cli_job *job, const char *path, mt_ability ability, const char *elements);

/* Takes all colours from a mesh. */
void cli_paint_clear(mt_context *context, mt_mesh *mesh);
/* Gives it uninitialised ones, three bytes each; *colors points into the mesh. */
mt_status cli_paint_add(mt_context *context, mt_mesh *mesh, mt_domain domain, unsigned char **colors);

/* Writes a mesh that was painted, or a picture of it. */
cli_exit cli_paint_write(const cli_job *job, const mt_mesh *mesh, const char *path);

#endif
