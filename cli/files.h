/* The files that a command reads and writes, under the common options. */
#ifndef MESHTOOL_CLI_FILES_H
#define MESHTOOL_CLI_FILES_H

#include "command.h"
#include "json.h"

#include <meshtool/image_format.h>
#include <meshtool/mesh_format.h>

/* Whether the path is standard output by any of its names. */
bool cli_is_standard_output(const char *path);

/* What a sentence calls an output: its path, or "standard output". */
const char *cli_output_name(const char *path);

/* Checks what can be known before anything is read; each says what is wrong and returns its exit code.
 * Inputs: --from is known, and standard input is named once at most. */
cli_exit cli_check_inputs(const cli_job *job);
/* An output: it is given (NULL: not), --json leaves standard output to it, its folder is there, --no-clobber. */
cli_exit cli_check_output(const cli_job *job, const char *path);
/* An output for a mesh: also the format is known, and has the encoding asked for. */
cli_exit cli_check_mesh_output(const cli_job *job, const char *path, const mt_mesh_format **format);
/* An output for a picture: also the format is known. */
cli_exit cli_check_image_output(const cli_job *job, const char *path, const mt_image_format **format);

/* Reads a mesh with --from and --precision. A failure is said and returned. *format may not be NULL. */
cli_exit cli_read_mesh(const cli_job *job, const char *path, mt_mesh **out, const mt_mesh_format **format);

/* Writes a mesh with --to, --encoding and their kin; warns of what is lost, and adds it to *lost (a new array, the
 * caller's; NULL: not wanted). A failure is said and returned. */
cli_exit cli_write_mesh(const cli_job *job, const mt_mesh *mesh, const char *path, json_t **lost);
/* The same with the bits and the compression that are given. */
cli_exit cli_write_mesh_as(const cli_job *job, const mt_mesh *mesh, const char *path, const mt_mesh_write_options *how,
                           json_t **lost);
cli_exit cli_write_image(const cli_job *job, const mt_image *image, const char *path);
/* The same with the bits and the quality given. */
cli_exit cli_write_image_as(const cli_job *job, const mt_image *image, const char *path,
                            const mt_image_write_options *how);

/* Where to write for commands of the form IN OUT: the second operand, or what -o gives (NULL: neither). Both are wrong
 * usage, which is said. */
cli_exit cli_output_operand(const cli_job *job, const char **path);

/* The name of an extension without its dot, as tables hold it. */
const char *cli_extension(const char *text);

#endif
