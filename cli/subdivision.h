/* What `meshtool subdivide` was asked for, shared by its parts. */
#ifndef MESHTOOL_CLI_SUBDIVISION_H
#define MESHTOOL_CLI_SUBDIVISION_H

#include "command.h"
#include "json.h"

#include <meshtool/subdivide.h>

typedef struct cli_subdivide_settings {
    cli_common common;
    unsigned levels;
    bool dry_run, limit, evaluate;
    unsigned scheme, boundary, crease_method, face_varying, triangles, non_manifold; /* places among the choices */
    double crease_angle;                                                             /* degrees; 0: not given */
    const char *creases;                                                             /* a file, NULL: not given */
} cli_subdivide_settings;

/* --dry-run: what the run would refuse, then counts, bytes and the expected time of each level. */
cli_exit cli_subdivide_foretell(const cli_job *job, const mt_mesh *mesh, const mt_subdivide_options *how);

/* --evaluate: how far each level's vertices are from the limit, as a table (on stderr beside an output) or, with
 * --json, as rows alone. *rows is the caller's. */
cli_exit cli_subdivide_evaluate(const cli_job *job, const mt_mesh *mesh, const mt_subdivide_options *how,
                                json_t **rows);

#endif
