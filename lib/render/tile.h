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
    float *floors;     /* one for each pixel: farther than this no triangle can be seen in it; renewed now and then */
    float floor;       /* the least of these */
    uint32_t drawn_pixels; /* pixels of triangles since they were renewed */
    mt_index *marks;       /* mark * 2, + 1 where it is hidden; MT_NONE: none. NULL when the picture has no marks */
    unsigned char *wanted; /* one for each pixel, 0 where nothing needs to be drawn; NULL: all are */
} mt_tile;

/* Room for a tile of the frame's samples, with marks where asked for. False: memory is missing. May be called inside a
 * parallel body; release it also after a failure. */
bool mt_tile_init(mt_context *context, const mt_frame *frame, bool marked, mt_tile *tile);
bool mt_tile_mask(mt_context *context, mt_tile *tile); /* makes room for `wanted` */
void mt_tile_release(mt_context *context, mt_tile *tile);

/* Makes it the tile of that number in the picture. */
void mt_tile_place(mt_tile *tile, const mt_camera *camera, size_t tile_number);

/* Nothing is drawn yet; in pixels that are not wanted nothing will be. */
void mt_tile_clear(mt_tile *tile);

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
