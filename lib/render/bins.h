/* Which primitives touch which tile of the picture. */
#ifndef MESHTOOL_RENDER_BINS_H
#define MESHTOOL_RENDER_BINS_H

#include <meshtool/context.h>

/* Pixels along a side of a tile: 32 x 32 pixels of 16 samples fill 128 KB, which stays in a core's own cache. */
#define MT_TILE_SIZE 32

/* Tiles, first and last column and row. Empty when first_x > last_x. */
typedef struct mt_tile_range {
    uint16_t first_x, first_y, last_x, last_y;
} mt_tile_range;

/* What is sorted into tiles: numbers 0 to count - 1. */
typedef struct mt_binned {
    const void *user;
    mt_index count;
    mt_tile_range (*range)(const void *user, mt_index number);
    /* Narrows first_x and last_x to the tiles of row tile_y that the primitive touches; may leave too many. Called for
     * primitives whose range is more than two tiles wide and more than one high. */
    void (*narrow)(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row);
} mt_binned;

typedef struct mt_bins {
    uint32_t tiles_x, tiles_y;
    size_t *firsts;    /* per tile the first of its numbers, and one more */
    mt_index *numbers; /* ascending within a tile; drawing may put them into another order */
    mt_index *large;   /* primitives of very many tiles are not listed by tile; ascending */
    mt_index large_count;
} mt_bins;

/* Cost: two passes over the primitives, four bytes for each tile that one touches. */
mt_status mt_bins_init(mt_context *context, const mt_binned *binned, uint32_t width, uint32_t height, mt_bins *bins);
void mt_bins_release(mt_context *context, mt_bins *bins);

/* The tiles of a rectangle of pixels, clipped to the picture. */
static inline mt_tile_range mt_tile_range_of(int32_t first_x, int32_t first_y, int32_t last_x, int32_t last_y,
                                             uint32_t width, uint32_t height)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    int32_t right = (int32_t)width - 1, bottom = (int32_t)height - 1;
    first_x = first_x > 0 ? first_x : 0;
    first_y = first_y > 0 ? first_y : 0;
    last_x = last_x < right ? last_x : right;
    last_y = last_y < bottom ? last_y : bottom;
    if (first_x > last_x || first_y > last_y) {
        return empty;
    }
    mt_tile_range range = {(uint16_t)((uint32_t)first_x / MT_TILE_SIZE), (uint16_t)((uint32_t)first_y / MT_TILE_SIZE),
                           (uint16_t)((uint32_t)last_x / MT_TILE_SIZE), (uint16_t)((uint32_t)last_y / MT_TILE_SIZE)};
    return range;
}

#endif
