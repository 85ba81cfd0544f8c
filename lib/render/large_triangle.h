/* Drawing a triangle of many pixels, or one that crosses the plane of the eye. */
#ifndef MESHTOOL_RENDER_LARGE_TRIANGLE_H
#define MESHTOOL_RENDER_LARGE_TRIANGLE_H

#include "lib/render/samples.h"

/* A large triangle: edge functions in doubles. */
typedef struct large_setup {
    triangle_setup base;
    double lowest[3], highest[3]; /* at a pixel's samples, above its corner */
} large_setup;

/* A pixel of a large triangle; whole: clearly all inside. */
MT_INLINE void draw_large_pixel(const mt_frame *frame, mt_tile *tile, const large_setup *s, const double e[3],
                                bool whole, int32_t x, int32_t y)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    size_t pixel = mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y), lane = pixel * tile->lane_count;
    unsigned group_count = frame->sampling.lane_count / MT_GROUP_SIZE;
    float depth = depth_at(&s->base.plane, x, y);
    vector8i doubts[MAXIMUM_GROUPS], any = {0};
    for (unsigned g = 0; g < group_count; g++) {
        vector8i maybe = ~(vector8i){0}, inside = maybe;
        if (!whole) {
            vector8d dx = __builtin_convertvector(xs[g], vector8d), dy = __builtin_convertvector(ys[g], vector8d);
            for (int i = 0; i < 3; i++) {
                vector8d at = e[i] + (s->base.edges[i].a * dx + s->base.edges[i].b * dy);
                maybe &= __builtin_convertvector(at >= -s->base.edges[i].doubt, vector8i);
                inside &= __builtin_convertvector(at > s->base.edges[i].doubt, vector8i);
            }
        }
        inside &= s->base.plane.vague ? 0 : -1;
        vector8f near = depth + (s->base.slope_x * xs[g] + s->base.slope_y * ys[g]);
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(s->base.number, &maybe, &inside, &near, tile->depths + first, tile->numbers + first, &doubts[g]);
        any |= doubts[g];
    }
    if (__builtin_expect(mt_any_lane(&any), 0)) {
        mt_settle_groups(frame, tile, s->base.number, x, y, doubts, group_count);
    }
}

MT_INLINE void prepare_large(const mt_frame *frame, mt_index triangle, large_setup *s)
{
    make_setup(frame, triangle, &s->base);
    double first = frame->sampling.first, last = frame->sampling.last;
    for (int i = 0; i < 3; i++) {
        double a = s->base.edges[i].a, b = s->base.edges[i].b;
        s->lowest[i] = a * (a > 0 ? first : last) + b * (b > 0 ? first : last);
        s->highest[i] = a * (a > 0 ? last : first) + b * (b > 0 ? last : first);
    }
}

/* Pixels of the row at `top` (in steps) that the edges leave between first and last; one that rounding adds is found
 * outside by the next test. */
MT_INLINE void narrow_row(const large_setup *s, double top, int32_t *first, int32_t *last)
{
    double low = *first, high = *last;
    for (int i = 0; i < 3; i++) {
        const edge *e = &s->base.edges[i];
        double at_zero = e->b * top + e->c + (s->highest[i] + e->doubt);
        double crossing = -at_zero / (e->a * MT_STEPS);
        if (e->a > 0) {
            low = crossing > low ? crossing : low;
        } else if (e->a < 0) {
            high = crossing < high ? crossing : high;
        }
    }
    if (low > high + 1) {
        *last = *first - 1;
    } else {
        *first = low > *first ? (int32_t)low : *first;
        *last = high < *last ? (int32_t)high + 1 : *last;
    }
}

MT_INLINE void draw_large(const mt_frame *frame, mt_tile *tile, const large_setup *s, pixel_box box)
{
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        int32_t first = box.first_x, last = box.last_x;
        narrow_row(s, (double)y * MT_STEPS, &first, &last);
        for (int32_t x = first; x <= last && x <= box.last_x; x++) {
            double e[3];
            bool touched = true, whole = true;
            for (int i = 0; i < 3; i++) {
                const edge *side = &s->base.edges[i];
                e[i] = side->a * ((double)x * MT_STEPS) + side->b * ((double)y * MT_STEPS) + side->c;
                touched &= e[i] + s->highest[i] >= -side->doubt;
                whole &= e[i] + s->lowest[i] > side->doubt;
            }
            float floor = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            if (touched && !is_behind(s->base.plane.nearest, floor)) {
                draw_large_pixel(frame, tile, s, e, whole, x, y);
            }
        }
    }
}

#endif
