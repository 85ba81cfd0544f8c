/* How far each operation holds: meshes made more and more extreme, until a result is wrong. */
#ifndef MESHTOOL_CLI_TRADEOFF_EXTREMES_H
#define MESHTOOL_CLI_TRADEOFF_EXTREMES_H

#include "command.h"

#include <meshtool/mesh.h>

/* An operation, judged on the positions as they are stored. */
typedef struct extreme_operation {
    const char *name;
    const char *oracle;
    bool needs_manifold, needs_faces;
    double bound; /* the largest error that is none of ours */
    /* The error beside the oracle, relative to what the mesh's own rounding allows. */
    mt_status (*error)(mt_context *context, const mt_mesh *mesh, double *out);
} extreme_operation;

/* The table, NULL-terminated. */
extern const extreme_operation *const extreme_operations[];

/* Sweeps all extremes over all operations in both precisions and prints where each breaks, and why. */
cli_exit tradeoff_extremes(const cli_job *job);

#endif
