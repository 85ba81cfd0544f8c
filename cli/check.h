/* The parts of check-manifold: its report as text, as JSON, and as colours. */
#ifndef MESHTOOL_CLI_CHECK_H
#define MESHTOOL_CLI_CHECK_H

#include "files.h"

#include <meshtool/manifold.h>

typedef struct check_settings {
    cli_common common;
    bool closed, oriented, watertight, self_intersections, all_defects;
    const char *paint;
} check_settings;

/* One file checked. */
typedef struct cli_check {
    const char *file;
    const mt_mesh_format *format;
    const mt_mesh *mesh;
    const mt_manifold_report *report;
    uint64_t listed_per_kind;                       /* defects in JSON */
    bool fails_closed, fails_oriented, fails_apart; /* what was asked for and does not hold */
} cli_check;

/* Whether the answer to all that was asked is yes. */
bool cli_check_holds(const cli_check *check);

/* The verdict as one sentence. */
void cli_check_print_verdict(const cli_check *check);

/* The verdict, then what is wrong and where, the figures, and what to do next. The report lists all defects. */
void cli_check_print_text(mt_context *context, const cli_check *check);

/* The boundary loops of a mesh that is not non-manifold, the largest ones with their places. */
void cli_check_print_loops(mt_context *context, const cli_check *check);

/* One JSON object and a line end. */
void cli_check_print_json(const cli_check *check);

/* The output of --paint, checked before anything is read. */
cli_exit cli_check_paint_output(const cli_job *job, const char *path);

/* Writes the mesh or a picture with its defects coloured, and says which colour is which. */
cli_exit cli_check_paint(const cli_job *job, const cli_check *check, const char *path);

#endif
