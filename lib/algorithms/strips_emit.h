/* Runs written out as indices. */
#ifndef LIB_ALGORITHMS_STRIPS_EMIT_H
#define LIB_ALGORITHMS_STRIPS_EMIT_H

#include "lib/algorithms/strips_graph.h"

#include <meshtool/strips.h>

/* What is being written. The arrays of `strips` have room for everything. */
typedef struct strip_emitter {
    const strip_graph *graph;
    const uint8_t *links;
    mt_strips *strips;
    mt_index index_count, triangle_count; /* so far */
    mt_index strip_begin;                 /* the first index of the strip being written */
    mt_index strip_triangles;             /* its triangles so far */
} strip_emitter;

/* How a run that begins at this end turns at its second triangle, as strip_turn seen from the first: 2 suits a strip
 * that begins with an even index, 1 with an odd one, 0 (fewer than three triangles) both. */
unsigned mt_strip_end_turn(const strip_graph *graph, const uint8_t *links, mt_index end);

/* The corner with which a run begins that starts at this end: the one that its second triangle does not have. */
unsigned mt_strip_end_corner(const uint8_t *links, mt_index end);

/* Appends a run to the strip being written; `corner` is that of its first vertex. Between two runs the caller appends
 * what joins them. */
void mt_strip_emit_run(strip_emitter *emitter, mt_index end, unsigned corner);
/* Appends a run whose turns are all 2 seen from this end as a fan. */
void mt_strip_emit_fan(strip_emitter *emitter, mt_index end);
void mt_strip_emit_index(strip_emitter *emitter, mt_index vertex);
/* Ends the strip or fan being written. */
void mt_strip_emit_end(strip_emitter *emitter);

#endif
