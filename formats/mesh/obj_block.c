#include "formats/mesh/obj_block.h"

#include <string.h>

size_t mt_obj_item_size(mt_obj_series series)
{
    static const uint8_t sizes[MT_OBJ_SERIES_COUNT] = {
        [MT_OBJ_POSITIONS] = 3 * sizeof(double),
        [MT_OBJ_COLORS] = 3 * sizeof(double),
        [MT_OBJ_UVS] = 2 * sizeof(double),
        [MT_OBJ_DEPTHS] = sizeof(double),
        [MT_OBJ_NORMALS] = 3 * sizeof(double),
        [MT_OBJ_SIDES] = sizeof(mt_index),
        [MT_OBJ_CORNERS] = sizeof(mt_index),
        [MT_OBJ_CORNER_UVS] = sizeof(mt_index),
        [MT_OBJ_CORNER_NORMALS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_CORNERS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_UVS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_NORMALS] = sizeof(mt_index),
        [MT_OBJ_WIRE_SIDES] = sizeof(mt_index),
        [MT_OBJ_WIRE_VERTICES] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_WIRES] = sizeof(mt_index),
        [MT_OBJ_POINTS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_POINTS] = sizeof(mt_index),
        [MT_OBJ_EVENTS] = sizeof(mt_obj_event),
        [MT_OBJ_NAMES] = 1,
        [MT_OBJ_CREASES] = sizeof(mt_edge_value),
        [MT_OBJ_SHARP_VERTICES] = sizeof(mt_vertex_value),
        [MT_OBJ_HOLES] = sizeof(mt_obj_hole),
        [MT_OBJ_SETTINGS] = sizeof(mt_obj_setting),
    };
    return sizes[series];
}

bool mt_obj_reserve_slowly(mt_context *context, mt_obj_block *block, mt_obj_series series, size_t more)
{
    size_t size = mt_obj_item_size(series);
    size_t capacity = 2 * block->capacities[series];
    size_t needed = block->counts[series] + more;
    capacity = capacity < needed ? needed : capacity;
    capacity = capacity < 64 ? 64 : capacity;
    void *items = mt_try_allocate(context, (uint64_t)capacity * size);
    if (!items) {
        return false;
    }
    if (block->counts[series] > 0) {
        memcpy(items, block->items[series], block->counts[series] * size);
    }
    mt_free(context, block->items[series]);
    block->items[series] = items;
    block->capacities[series] = capacity;
    return true;
}

void mt_obj_block_clear(mt_obj_block *block)
{
    memset(block->counts, 0, sizeof block->counts);
    block->face_count = 0;
    block->face_size = 0;
    block->statement_count = 0;
    block->uncolored_count = 0;
    block->weight_count = 0;
    block->wire_uv_count = 0;
    block->unknown_count = 0;
}

void mt_obj_series_release(mt_context *context, mt_obj_block *block, mt_obj_series series)
{
    mt_free(context, block->items[series]);
    block->items[series] = NULL;
    block->capacities[series] = 0;
}

void mt_obj_block_release(mt_context *context, mt_obj_block *block)
{
    for (int series = 0; series < MT_OBJ_SERIES_COUNT; series++) {
        mt_obj_series_release(context, block, (mt_obj_series)series);
    }
}

bool mt_obj_block_copy(mt_context *context, const mt_obj_block *block, mt_obj_block *copy)
{
    *copy = *block;
    memset(copy->items, 0, sizeof copy->items);
    for (int series = 0; series < MT_OBJ_SERIES_COUNT; series++) {
        size_t size = block->counts[series] * mt_obj_item_size((mt_obj_series)series);
        copy->capacities[series] = block->counts[series];
        if (size == 0) {
            continue;
        }
        copy->items[series] = mt_try_allocate(context, size);
        if (!copy->items[series]) {
            return false;
        }
        memcpy(copy->items[series], block->items[series], size);
    }
    return true;
}
