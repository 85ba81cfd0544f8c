/* Drawing a triangle of a few pixels, everything in floats. */
#ifndef MESHTOOL_RENDER_SMALL_TRIANGLE_H
#define MESHTOOL_RENDER_SMALL_TRIANGLE_H

#include "lib/render/samples.h"

/* Pixels along the box of a triangle that is drawn in floats: with more, their rounding would leave doubts. */
#define SMALL_SIZE 8

/* A small triangle: its three edge functions, with their doubt added, and its depth as the fourth, in floats from the
 * top left corner of its box. */
typedef struct small_setup {
    vector4f origin, right, down; /* right, down: a step further */
    vector4f lowest;              /* at a pixel's corner, from which a sample may be inside */
    float inside[3];              /* above which a sample is clearly inside; infinite where only the hit test knows */
    float nearest;
    mt_index number;
} small_setup;

MT_INLINE void prepare_small(const mt_frame *frame, mt_index triangle, const corners *c, pixel_box whole,
                             small_setup *s)
{
    const depth_plane plane = make_plane(frame, c);
    float x[3], y[3], first = (float)frame->sampling.first, last = (float)frame->sampling.last;
    for (int i = 0; i < 3; i++) {
        x[i] = (float)(c->v[i]->x - (double)whole.first_x * MT_STEPS);
        y[i] = (float)(c->v[i]->y - (double)whole.first_y * MT_STEPS);
    }
    int32_t width = whole.last_x - whole.first_x, height = whole.last_y - whole.first_y;
    float size = (float)((width > height ? width : height) + 2) * MT_STEPS, doubt = (float)doubt_of(frame, c);
    float sign = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) < 0 ? -1.0F : 1.0F;
    float a[3], b[3], c0[3], lowest[3];
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        a[i] = sign * (y[i] - y[next]), b[i] = sign * (x[next] - x[i]);
        float own = (fabsf(a[i]) + fabsf(b[i])) * doubt + size * size * FLOAT_ROUNDING;
        c0[i] = own - (a[i] * x[i] + b[i] * y[i]);
        s->inside[i] = plane.vague ? INFINITY : 2.0F * own;
        lowest[i] = -(a[i] * (a[i] > 0 ? last : first) + b[i] * (b[i] > 0 ? last : first)) - own;
    }
    s->right = (vector4f){a[0], a[1], a[2], (float)plane.slope_x};
    s->down = (vector4f){b[0], b[1], b[2], (float)plane.slope_y};
    s->origin = (vector4f){c0[0], c0[1], c0[2], depth_at(&plane, whole.first_x, whole.first_y)};
    s->lowest = (vector4f){lowest[0], lowest[1], lowest[2], -INFINITY};
    s->nearest = plane.nearest;
    s->number = triangle;
}

/* Offsets of a small triangle's functions at the samples of a pixel. */
typedef struct offsets {
    vector8f edges[3][MAXIMUM_GROUPS], depths[MAXIMUM_GROUPS];
} offsets;

MT_INLINE void draw_small_pixel(const mt_frame *frame, mt_tile *tile, const small_setup *s, const offsets *at,
                                const vector4f *from, unsigned group_count, int32_t x, int32_t y)
{
    const vector4f e = *from;
    size_t lane = mt_tile_lane(tile, (uint32_t)x, (uint32_t)y);
    vector8i doubts[MAXIMUM_GROUPS], any = {0};
    for (unsigned g = 0; g < group_count; g++) {
        vector8f e0 = e[0] + at->edges[0][g], e1 = e[1] + at->edges[1][g], e2 = e[2] + at->edges[2][g];
        vector8i maybe = (e0 >= 0.0F) & (e1 >= 0.0F) & (e2 >= 0.0F);
        vector8i inside = (e0 > s->inside[0]) & (e1 > s->inside[1]) & (e2 > s->inside[2]);
        vector8f near = e[3] + at->depths[g];
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(s->number, &maybe, &inside, &near, tile->depths + first, tile->numbers + first, &doubts[g]);
        any |= doubts[g];
    }
    if (__builtin_expect(mt_any_lane(&any), 0)) {
        mt_settle_groups(frame, tile, s->number, x, y, doubts, group_count);
    }
}

MT_INLINE bool is_lower(const vector4f *e, const vector4f *lowest)
{
    const vector2l lanes = (vector2l)(*e < *lowest);
    return (lanes[0] | lanes[1]) != 0;
}

/* The box of a small triangle: everything in floats. */
MT_INLINE void draw_small(const mt_frame *frame, mt_tile *tile, const small_setup *s, pixel_box whole, pixel_box box,
                          unsigned group_count)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    offsets at;
    for (unsigned g = 0; g < group_count; g++) {
        for (int i = 0; i < 3; i++) {
            at.edges[i][g] = s->right[i] * xs[g] + s->down[i] * ys[g];
        }
        at.depths[g] = s->right[3] * xs[g] + s->down[3] * ys[g];
    }
    const vector4f step = s->right * MT_STEPS;
    const vector4f left = s->origin + s->right * (float)((box.first_x - whole.first_x) * MT_STEPS);
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        vector4f e = left + s->down * (float)((y - whole.first_y) * MT_STEPS);
        for (int32_t x = box.first_x; x <= box.last_x; x++, e += step) {
            float floor = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            if (!is_lower(&e, &s->lowest) && !is_behind(s->nearest, floor)) {
                draw_small_pixel(frame, tile, s, &at, &e, group_count, x, y);
            }
        }
    }
}

#endif
