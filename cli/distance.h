/* What the distance command is made of. */
#ifndef MESHTOOL_CLI_DISTANCE_H
#define MESHTOOL_CLI_DISTANCE_H

#include "command.h"

#include <meshtool/deviation.h>

typedef struct cli_distance_settings {
    cli_common common;
    const char *points, *paint;
    bool is_signed;
    double tolerance, spacing;
} cli_distance_settings;

/* Where --paint writes is known to hold colours. */
cli_exit cli_distance_check_paint(const cli_job *job, const char *path);

/* A mesh whose vertices are coloured by a distance each: from dark blue at zero (or below) by green to yellow at
 * `largest`; signed distances from blue (inside) by white to red. NAN: grey. */
cli_exit cli_distance_paint(const cli_job *job, const mt_mesh *mesh, const double *distances, double largest,
                            const char *path);

/* distance MESH --points FILE: each vertex of FILE, its nearest point on MESH. */
cli_exit cli_distance_points(const cli_job *job, const mt_mesh *mesh, const mt_mesh *points);

#endif
