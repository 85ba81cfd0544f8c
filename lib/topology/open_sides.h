/* Open sides: a side that waits for the face across hangs in a list at the vertex from which that face's side will
 * leave, and the list runs through the very records that the second side will fill. So nothing is written but the
 * structure itself, lists are as short as the front of what has been built, and finding a side brings the record that
 * is written next into cache. Sides of edges that cannot be held stay open or are joined wrongly, two by two; rings
 * show them afterwards (ring_check.h).
 */
#ifndef MT_TOPOLOGY_OPEN_SIDES_H
#define MT_TOPOLOGY_OPEN_SIDES_H

#include "lib/topology/edge_chain.h"

#include <string.h>

typedef struct open_sides {
    mt_index *newest; /* per vertex the head of its list, MT_NONE: empty */
    uint64_t steps;   /* along the lists so far */
} open_sides;

static inline mt_status open_sides_init(mt_context *context, mt_index vertex_count, open_sides *open)
{
    *open = (open_sides){mt_allocate_array(context, vertex_count, sizeof *open->newest), 0};
    if (!open->newest) {
        return mt_context_error(context)->status;
    }
    memset(open->newest, 0xff, vertex_count * sizeof *open->newest);
    return MT_OK;
}

#endif
