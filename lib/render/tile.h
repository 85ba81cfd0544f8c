/* A square of the picture while it is drawn: for each sample of each pixel what is nearest. */
#ifndef MESHTOOL_RENDER_TILE_H
#define MESHTOOL_RENDER_TILE_H

#include "lib/render/bins.h"
#include "lib/render/frame.h"

typedef struct mt_tile {
    uint32_t x, y;          /* its first pixel */
    uint32_t width, height; /* pixels, at most MT_TILE_SIZE */
    unsigned lane_count;
    /* lane_count for each pixel, MT_TILE_SIZE pixels a row */
    float *depths;     /* as in mt_screen_point; 0: nothing */
    mt_index *numbers; /* triangle, or triangle_count + stroke; MT_NONE: nothing */
    float *floors;     /* one for each pixel: the least of its depths, as far as triangles tell */
    mt_index *marks;   /* mark * 2, + 1 where it is hidden; MT_NONE: none. NULL when the picture has no marks */
} mt_tile;

/* Lanes of a whole tile. */
static inline size_t mt_tile_lane_count(unsigned lanes_per_pixel)
{
    return (size_t)MT_TILE_SIZE * MT_TILE_SIZE * lanes_per_pixel;
}

static inline size_t mt_tile_pixel(const mt_tile *tile, uint32_t x, uint32_t y)
{
    return (size_t)(y - tile->y) * MT_TILE_SIZE + (x - tile->x);
}

/* The first lane of a pixel of the picture. */
static inline size_t mt_tile_lane(const mt_tile *tile, uint32_t x, uint32_t y)
{
    return mt_tile_pixel(tile, x, y) * tile->lane_count;
}

#endif
