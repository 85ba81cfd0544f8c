#include "lib/topology/surgery_room.h"

mt_status mt_surgery_make_room(mt_context *context, uint64_t needed, uint64_t *capacity, mt_surgery_block *blocks,
                               int block_count)
{
    if (needed > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more elements than an index can number");
    }
    if (needed <= *capacity) {
        return MT_OK;
    }
    uint64_t room = needed + needed / 2;
    for (int i = 0; i < block_count; i++) {
        void *grown = mt_reallocate(context, blocks[i].block, room * blocks[i].size);
        if (!grown) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        blocks[i].block = grown;
    }
    *capacity = room;
    return MT_OK;
}
