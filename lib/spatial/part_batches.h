/* Parts of a structure that are made in parallel, and between which its making can be stopped. */
#ifndef MT_SPATIAL_PART_BATCHES_H
#define MT_SPATIAL_PART_BATCHES_H

#include <meshtool/context.h>

/* mt_parallel_for over parts, some at a time: after each batch it tells the share of the work done, from `share` to 1,
 * and asks whether to go on. MT_OK, or MT_ERROR_CANCELLED recorded: later parts were not begun. */
mt_status mt_make_in_batches(mt_context *context, const char *task, double share, uint64_t part_count,
                             mt_parallel_body body, void *user);

#endif
