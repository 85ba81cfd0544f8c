/* A list of what is sharp and what is a hole, as text: one of
 *     crease A B SHARPNESS     the edge between two vertices
 *     corner V SHARPNESS       a vertex
 *     hole F                   a face
 * a line, numbers from 0 as in OBJ tags, SHARPNESS a number or "infinite"; empty lines and those after # are skipped.
 */
#ifndef MESHTOOL_CLI_CREASE_LIST_H
#define MESHTOOL_CLI_CREASE_LIST_H

#include "command.h"

#include <meshtool/subdivide.h>

typedef struct cli_crease_list {
    mt_index crease_count, corner_count, hole_count;
    mt_edge_value *creases;
    mt_vertex_value *corners;
    mt_index *holes;
} cli_crease_list;

/* Reads the file, whose vertices and faces must be the mesh's. A failure is said and returned. */
cli_exit cli_crease_list_read(const cli_job *job, const char *path, const mt_mesh *mesh, cli_crease_list *list);
void cli_crease_list_release(const cli_job *job, cli_crease_list *list);

#endif
