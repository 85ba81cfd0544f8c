#include "lib/render/tile.h"

#include <float.h>

bool mt_tile_init(mt_context *context, const mt_frame *frame, bool marked, mt_tile *tile)
{
    size_t pixels = (size_t)MT_TILE_SIZE * MT_TILE_SIZE, lanes = pixels * frame->sampling.lane_count;
    *tile = (mt_tile){.lane_count = frame->sampling.lane_count};
    tile->depths = (float *)mt_try_allocate(context, lanes * sizeof *tile->depths);
    tile->numbers = (mt_index *)mt_try_allocate(context, lanes * sizeof *tile->numbers);
    tile->floors = (float *)mt_try_allocate(context, pixels * sizeof *tile->floors);
    tile->marks = marked ? (mt_index *)mt_try_allocate(context, lanes * sizeof *tile->marks) : NULL;
    return tile->depths && tile->numbers && tile->floors && (tile->marks || !marked);
}

bool mt_tile_mask(mt_context *context, mt_tile *tile)
{
    tile->wanted = (unsigned char *)mt_try_allocate(context, (uint64_t)MT_TILE_SIZE * MT_TILE_SIZE);
    return tile->wanted != NULL;
}

void mt_tile_release(mt_context *context, mt_tile *tile)
{
    mt_free(context, tile->depths);
    mt_free(context, tile->numbers);
    mt_free(context, tile->floors);
    mt_free(context, tile->marks);
    mt_free(context, tile->wanted);
    *tile = (mt_tile){0};
}

void mt_tile_place(mt_tile *tile, const mt_camera *camera, size_t tile_number)
{
    size_t tiles_x = (camera->width - 1) / MT_TILE_SIZE + 1;
    tile->x = (uint32_t)(tile_number % tiles_x) * MT_TILE_SIZE;
    tile->y = (uint32_t)(tile_number / tiles_x) * MT_TILE_SIZE;
    tile->width = camera->width - tile->x < MT_TILE_SIZE ? camera->width - tile->x : MT_TILE_SIZE;
    tile->height = camera->height - tile->y < MT_TILE_SIZE ? camera->height - tile->y : MT_TILE_SIZE;
}

void mt_tile_clear(mt_tile *tile)
{
    size_t pixels = (size_t)tile->height * MT_TILE_SIZE, lanes = pixels * tile->lane_count;
    tile->floor = 0;
    tile->drawn_pixels = 0;
    for (size_t lane = 0; lane < lanes; lane++) {
        tile->depths[lane] = 0;
        tile->numbers[lane] = MT_NONE;
    }
    for (size_t pixel = 0; pixel < pixels; pixel++) {
        tile->floors[pixel] = tile->wanted && !tile->wanted[pixel] ? FLT_MAX : 0;
    }
    for (size_t lane = 0; tile->marks && lane < lanes; lane++) {
        tile->marks[lane] = MT_NONE;
    }
}
