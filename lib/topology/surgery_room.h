/* The blocks that surgery works in: their growth, and the numbers of what is left in them. */
#ifndef MT_TOPOLOGY_SURGERY_ROOM_H
#define MT_TOPOLOGY_SURGERY_ROOM_H

#include <meshtool/surgery.h>

/* One block of `size` bytes an element; several may share a capacity. */
typedef struct mt_surgery_block {
    void *block;
    size_t size;
} mt_surgery_block;

/* Makes room for `needed` elements in each block, half as much again when they must grow. On failure some may have
 * grown, but the capacity is what it was; so the caller takes the blocks back in either case. MT_ERROR_TOO_LARGE past
 * what an index can number. Amortised O(1) an element. */
mt_status mt_surgery_make_room(mt_context *context, uint64_t needed, uint64_t *capacity, mt_surgery_block *blocks,
                               int block_count);

#endif
