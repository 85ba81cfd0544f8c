/* Each kind of defect in its colour. */
#ifndef MESHTOOL_CLI_DEFECT_PAINT_H
#define MESHTOOL_CLI_DEFECT_PAINT_H

#include "check.h"

#include <meshtool/components.h>
#include <meshtool/preview.h>

/* Colours of faces and vertices, and the edges to mark. */
typedef struct cli_defect_paint {
    mt_edge_pairs *pairs;
    mt_components *components; /* when one of them is a defect, else NULL */
    unsigned char *faces, *vertices, *marked_vertices;
    mt_index *edges;
    unsigned char *edge_colors;
    size_t edge_count;
    mt_mesh shown; /* the mesh for a picture: isolated vertices are points of it, so that the frame takes them in */
    mt_index *points;
} cli_defect_paint;

/* Colours for a picture, or for a mesh, which has its faces' colours alone. The report lists all defects. */
mt_status cli_defect_paint_init(mt_context *context, const cli_check *check, bool for_picture, cli_defect_paint *out);
void cli_defect_paint_release(mt_context *context, cli_defect_paint *paint);

/* Puts the colours and marks into the options of a picture of paint->shown, which borrow them. */
void cli_defect_paint_apply(const cli_defect_paint *paint, mt_preview_options *how);

/* Says which colours stand for what, and how often. */
void cli_defect_legend(const cli_job *job, const cli_check *check, const char *path);

#endif
