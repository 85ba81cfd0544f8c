/* Where the blocks of an OBJ file keep what they hold: each slot of the text appends to a store of its own, series by
 * series, in pieces that become large. A block's items of one series lie side by side, and stay where they are until
 * the series is let go. Large pieces fill huge pages, and nothing is copied where a block ends. */
#ifndef MESHTOOL_OBJ_STORE_H
#define MESHTOOL_OBJ_STORE_H

#include "formats/mesh/obj_block.h"

typedef struct mt_obj_piece mt_obj_piece;

typedef struct mt_obj_store {
    mt_obj_piece *pieces[MT_OBJ_SERIES_COUNT]; /* the newest first, which is the one that is filled */
    size_t used[MT_OBJ_SERIES_COUNT];          /* bytes of the newest that blocks have kept */
    size_t sizes[MT_OBJ_SERIES_COUNT];         /* bytes that it has room for */
    size_t largest;                            /* bytes that a piece has, unless one block needs more */
} mt_obj_store;

/* What `largest` should be: large enough to fill huge pages, and so small that the room which the last pieces of all
 * stores leave unused is a fraction of the text. */
size_t mt_obj_store_piece(uint64_t text_size, unsigned store_count);

/* Makes *block an empty one that fills the room which is left. Until it is kept no other block may be begun. */
void mt_obj_store_begin(mt_obj_store *store, mt_obj_block *block);
/* The block's items are kept; without this call the next block overwrites them. */
void mt_obj_store_keep(const mt_obj_block *block);

/* Makes room for `more` items of the block that was begun last: moves what it has to a new piece. False when memory is
 * missing. Records nothing: it is called in parallel. */
bool mt_obj_reserve_slowly(mt_context *context, mt_obj_block *block, mt_obj_series series, size_t more);

static inline bool mt_obj_reserve(mt_context *context, mt_obj_block *block, mt_obj_series series, size_t more)
{
    return block->capacities[series] - block->counts[series] >= more ||
           mt_obj_reserve_slowly(context, block, series, more);
}

/* Frees one series of every block that was kept. */
void mt_obj_store_release_series(mt_context *context, mt_obj_store *store, mt_obj_series series);
void mt_obj_store_release(mt_context *context, mt_obj_store *store);

#endif
