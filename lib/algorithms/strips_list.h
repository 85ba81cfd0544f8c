/* The runs of a cover: found, put in order, and written out. */
#ifndef LIB_ALGORITHMS_STRIPS_LIST_H
#define LIB_ALGORITHMS_STRIPS_LIST_H

#include "lib/algorithms/strips_graph.h"

#include <meshtool/strips.h>

/* Writes the runs of a cover into *strips, whose fields are zero but for `join`: strips first, then the runs of
 * triangles that is_fan (NULL: none) marks. On failure what was allocated is in *strips. */
mt_status mt_strip_list(mt_context *context, const strip_graph *graph, const uint8_t *links, const uint8_t *is_fan,
                        mt_strips *strips);

#endif
