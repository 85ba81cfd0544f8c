/* A triangle's way into the samples of a pixel: stored where it is clearly seen, asked about where it is not clear. */
#ifndef MESHTOOL_RENDER_SAMPLES_H
#define MESHTOOL_RENDER_SAMPLES_H

#include "lib/render/settle.h"
#include "lib/render/tile.h"
#include "lib/render/triangle.h"
#include "lib/render/vectors.h"

#define MAXIMUM_GROUPS (MT_MAXIMUM_SAMPLES / MT_GROUP_SIZE)

/* Stores the triangle in the samples of a group where it is clearly inside and nearest; *doubt receives those about
 * which the hit test is to be asked. */
MT_INLINE void store_group(mt_index number, const vector8i *maybe, const vector8i *inside, const vector8f *near,
                           float *depths, mt_index *numbers, vector8i *doubt)
{
    vector8f *old = (vector8f *)depths;
    vector8i *old_number = (vector8i *)numbers;
    vector8f nearer = *near - *old, band = *old * DEPTH_BAND;
    vector8i wins = *inside & (nearer > band);
    *doubt = *maybe & ~wins & (nearer >= -band);
    *old = (vector8f)(((vector8i)*near & wins) | ((vector8i)*old & ~wins));
    *old_number = ((int32_t)number & wins) | (*old_number & ~wins);
}

/* The least depth of a pixel's samples. */
MT_INLINE float floor_of(const float *depths, unsigned group_count)
{
    vector8f least = *(const vector8f *)depths;
    for (unsigned g = 1; g < group_count; g++) {
        const vector8f other = *(const vector8f *)(depths + MT_GROUP_SIZE * g);
        vector8i less = other < least;
        least = (vector8f)(((vector8i)other & less) | ((vector8i)least & ~less));
    }
    vector4f low = __builtin_shufflevector(least, least, 0, 1, 2, 3);
    vector4f high = __builtin_shufflevector(least, least, 4, 5, 6, 7);
    vector4i less = low < high;
    low = (vector4f)(((vector4i)low & less) | ((vector4i)high & ~less));
    float a = low[0] < low[1] ? low[0] : low[1], b = low[2] < low[3] ? low[2] : low[3];
    return a < b ? a : b;
}

/* Whether a triangle that comes as near as `nearest` is clearly behind what a floor (tile.h) stands for. */
MT_INLINE bool is_behind(float nearest, float floor)
{
    return nearest < floor;
}

/* Pixels drawn between two renewals of the floors: four times those of a tile, so that finding the floors costs little
 * beside drawing, and what lies behind a surface is found hidden soon after it was drawn. */
#define PIXELS_PER_RENEWAL (4u * MT_TILE_SIZE * MT_TILE_SIZE)

MT_INLINE void renew_floors(mt_tile *tile, unsigned group_count)
{
    float least = FLT_MAX;
    for (uint32_t y = 0; y < tile->height; y++) {
        for (uint32_t x = 0; x < tile->width; x++) {
            size_t pixel = mt_tile_pixel(tile, tile->x + x, tile->y + y);
            float depth = floor_of(tile->depths + pixel * tile->lane_count, group_count);
            float floor = depth - depth * DEPTH_BAND, *old = &tile->floors[pixel];
            *old = floor > *old ? floor : *old;
            least = *old < least ? *old : least;
        }
    }
    tile->floor = least;
    tile->drawn_pixels = 0;
}

#endif
