#include "lib/render/settle.h"

#include "lib/render/triangle.h"

#include <float.h>

/* Asks the hit test whether the triangle is what a sample shows. */
static void settle(const mt_frame *frame, mt_tile *tile, mt_index triangle, uint32_t x, uint32_t y, unsigned lane)
{
    size_t at = mt_tile_lane(tile, x, y) + lane;
    mt_ray_setup ray;
    mt_ray_hit hit, old_hit;
    const mt_ray from = mt_hit_ray(mt_frame_ray(frame, x, y, lane));
    mt_ray_setup_init(&frame->model->space, &from, frame->profile, &ray);
    if (!mt_hit(frame->model, &ray, triangle, &hit)) {
        return;
    }
    double exact = mt_camera_depth(&frame->camera, hit.t);
    float depth = (float)(exact < (double)FLT_MAX ? exact : (double)FLT_MAX), old = tile->depths[at];
    float band = old * DEPTH_BAND, nearer = depth - old;
    if (nearer < -band) {
        return;
    }
    mt_index old_number = tile->numbers[at];
    bool asks = nearer <= band && old_number != MT_NONE;
    if (asks && mt_hit(frame->model, &ray, old_number, &old_hit) && !mt_ray_hit_is_nearer(&hit, &old_hit)) {
        return;
    }
    tile->depths[at] = depth;
    tile->numbers[at] = triangle;
}

void mt_settle_groups(const mt_frame *frame, mt_tile *tile, mt_index triangle, int32_t x, int32_t y,
                      const vector8i *groups, unsigned group_count)
{
    for (unsigned g = 0; g < group_count; g++) {
        for (unsigned lanes = mt_lane_bits(&groups[g]); lanes; lanes &= lanes - 1) {
            unsigned lane = MT_GROUP_SIZE * g + (unsigned)__builtin_ctz(lanes);
            settle(frame, tile, triangle, (uint32_t)x, (uint32_t)y, lane);
        }
    }
}
