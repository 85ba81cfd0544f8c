#include "formats/mesh/obj_store.h"

#include <string.h>

#define PIECE_HEADER 64 /* keeps items aligned to the cache line */
#define BLOCK_HEADER 64 /* of the allocator: with both headers large pieces are whole huge pages */
#define HUGE_PAGE ((size_t)2 << 20)
#define LARGEST_PIECE (2 * HUGE_PAGE)
#define SMALLEST_SHARE ((size_t)64 << 10)
#define PIECES_A_SERIES 8
#define FIRST_ITEMS 64

struct mt_obj_piece {
    mt_obj_piece *next;
};

static char *items_of(mt_obj_piece *piece)
{
    return (char *)piece + PIECE_HEADER;
}

void mt_obj_store_begin(mt_obj_store *store, mt_obj_block *block)
{
    *block = (mt_obj_block){.store = store};
    for (int series = 0; series < MT_OBJ_SERIES_COUNT; series++) {
        if (store->pieces[series]) {
            block->items[series] = items_of(store->pieces[series]) + store->used[series];
            block->capacities[series] =
                (store->sizes[series] - store->used[series]) / mt_obj_item_size((mt_obj_series)series);
        }
    }
}

void mt_obj_store_keep(const mt_obj_block *block)
{
    mt_obj_store *store = block->store;
    for (int series = 0; series < MT_OBJ_SERIES_COUNT; series++) {
        store->used[series] += block->counts[series] * mt_obj_item_size((mt_obj_series)series);
    }
}

size_t mt_obj_store_piece(uint64_t text_size, unsigned store_count)
{
    uint64_t size = text_size / PIECES_A_SERIES / store_count;
    size = size < LARGEST_PIECE ? size : LARGEST_PIECE;
    size = size > HUGE_PAGE ? size / HUGE_PAGE * HUGE_PAGE : size > SMALLEST_SHARE ? size : SMALLEST_SHARE;
    return (size_t)size - PIECE_HEADER - BLOCK_HEADER;
}

/* Pieces double up to the largest; a block that needs more than that doubles alone. */
static size_t next_size(const mt_obj_store *store, mt_obj_series series, size_t held, size_t needed)
{
    size_t size = 2 * store->sizes[series];
    size = size < store->largest ? size : store->largest;
    size_t first = FIRST_ITEMS * mt_obj_item_size(series);
    size = size > first ? size : first;
    size = size > 2 * held ? size : 2 * held;
    return size > needed ? size : needed;
}

bool mt_obj_reserve_slowly(mt_context *context, mt_obj_block *block, mt_obj_series series, size_t more)
{
    mt_obj_store *store = block->store;
    size_t item = mt_obj_item_size(series), held = block->counts[series] * item;
    size_t needed = held + more * item, size = next_size(store, series, held, needed);
    mt_obj_piece *piece = mt_try_allocate(context, PIECE_HEADER + (uint64_t)size);
    if (!piece && size > needed) {
        size = needed;
        piece = mt_try_allocate(context, PIECE_HEADER + (uint64_t)size);
    }
    if (!piece) {
        return false;
    }
    mt_obj_piece *before = store->pieces[series];
    if (held > 0) {
        memcpy(items_of(piece), block->items[series], held);
    }
    piece->next = before;
    if (before && store->used[series] == 0) {
        piece->next = before->next;
        mt_free(context, before);
    }
    store->pieces[series] = piece;
    store->used[series] = 0;
    store->sizes[series] = size;
    block->items[series] = items_of(piece);
    block->capacities[series] = size / item;
    return true;
}

void mt_obj_store_release_series(mt_context *context, mt_obj_store *store, mt_obj_series series)
{
    while (store->pieces[series]) {
        mt_obj_piece *piece = store->pieces[series];
        store->pieces[series] = piece->next;
        mt_free(context, piece);
    }
    store->used[series] = store->sizes[series] = 0;
}

void mt_obj_store_release(mt_context *context, mt_obj_store *store)
{
    for (int series = 0; series < MT_OBJ_SERIES_COUNT; series++) {
        mt_obj_store_release_series(context, store, (mt_obj_series)series);
    }
}
