/* Object-order visibility after Pineda, "A Parallel Algorithm for Polygon Rasterization" (1988): three edge functions,
 * linear over the picture, whose signs say whether a sample is inside.
 *
 * Invariant: for coverage vertices are rounded to the picture's grid, and there edge functions are whole numbers
 * that are computed without rounding, in floats for triangles of a few pixels and in doubles for larger ones. So
 * neighbours that share an edge leave no gap, whatever their shapes. Depth is linear on the picture; its plane comes
 * from the vertices before rounding, in a canonical order, in doubles, and its coefficients are then rounded to
 * floats, so that a triangle given twice, or two triangles in one plane, are equally deep and the lowest wins
 * instead of a speckle.
 *
 * Cost: per triangle a set-up, per pixel of its box three comparisons, and its samples where an edge passes.
 * Known limit: a triangle seen edge-on, or thinner than 1/256 of a pixel, may cover nothing. */
#include "lib/render/raster.h"

#include "lib/render/triangle.h"
#include "lib/render/vectors.h"

#include <math.h>

#define MAXIMUM_GROUPS (MT_MAXIMUM_SAMPLES / MT_GROUP_SIZE)

/* Pixels along the box of a triangle whose edge functions, at most 2 * (9 * 256)^2, are exact in floats. */
#define SMALL_SIZE 8

/* A triangle ready to be tested. */
typedef struct setup {
    edge edges[3];
    depth_plane plane;
    float slope_x, slope_y; /* the plane's, rounded */
    mt_index number;
} setup;

MT_INLINE void prepare(mt_index triangle, const corners *c, setup *s)
{
    make_edges(c, s->edges);
    s->plane = make_plane(c);
    s->slope_x = (float)s->plane.slope_x;
    s->slope_y = (float)s->plane.slope_y;
    s->number = triangle;
}

MT_INLINE void hold(vector8f *value, float low, float high)
{
    vector8f lows = low - (vector8f){0}, highs = high - (vector8f){0};
    vector8i under = *value<lows, over = *value> highs;
    *value = (vector8f)(((vector8i)*value & ~(under | over)) | ((vector8i)lows & under) | ((vector8i)highs & over));
}

/* Stores the triangle in the samples of a group that it covers and where it is nearest. */
MT_INLINE void store_group(const setup *s, const vector8i *inside, vector8f *near, float *depths, mt_index *numbers)
{
    if (s->plane.steep) {
        hold(near, s->plane.farthest, s->plane.nearest);
    }
    vector8f *old = (vector8f *)depths;
    vector8i *old_number = (vector8i *)numbers;
    vector8i wins = *inside & (*near > *old);
    *old = (vector8f)(((vector8i)*near & wins) | ((vector8i)*old & ~wins));
    *old_number = ((int32_t)s->number & wins) | (*old_number & ~wins);
}

MT_INLINE float depth_at(const setup *s, int32_t x, int32_t y)
{
    double left = (double)x * MT_STEPS, top = (double)y * MT_STEPS;
    return (float)(s->plane.depth + (s->plane.slope_x * (left - s->plane.x) + s->plane.slope_y * (top - s->plane.y)));
}

/* The least depth of a pixel's samples: nothing farther can be seen there. */
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

/* Offsets of a small triangle's functions at the samples of a pixel. */
typedef struct offsets {
    vector8f edges[3][MAXIMUM_GROUPS], depths[MAXIMUM_GROUPS];
} offsets;

MT_INLINE void draw_small_pixel(mt_tile *tile, const setup *s, const offsets *at, const int32_t e[3],
                                unsigned group_count, int32_t x, int32_t y)
{
    size_t pixel = mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y), lane = pixel * tile->lane_count;
    float depth = depth_at(s, x, y);
    float e0 = (float)e[0], e1 = (float)e[1], e2 = (float)e[2];
    for (unsigned g = 0; g < group_count; g++) {
        /* No sum is -0, so the sign bits tell. */
        vector8i signs =
            (vector8i)(e0 + at->edges[0][g]) | (vector8i)(e1 + at->edges[1][g]) | (vector8i)(e2 + at->edges[2][g]);
        vector8i inside = signs >= 0;
        vector8f near = depth + at->depths[g];
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(s, &inside, &near, tile->depths + first, tile->numbers + first);
    }
    tile->floors[pixel] = floor_of(tile->depths + lane, group_count);
}

/* The box of a small triangle: everything in floats. */
MT_INLINE void draw_small(const mt_frame *frame, mt_tile *tile, const setup *s, pixel_box box, unsigned group_count)
{
    const vector8f *xs = (const vector8f *)frame->sample_x, *ys = (const vector8f *)frame->sample_y;
    offsets at;
    for (unsigned g = 0; g < group_count; g++) {
        for (int i = 0; i < 3; i++) {
            at.edges[i][g] = (float)s->edges[i].a * xs[g] + (float)s->edges[i].b * ys[g];
        }
        at.depths[g] = s->slope_x * xs[g] + s->slope_y * ys[g];
    }
    int32_t row[3], highest[3], first = frame->sample_first, last = frame->sample_last;
    for (int i = 0; i < 3; i++) {
        const edge *e = &s->edges[i];
        row[i] = e->a * (box.first_x * MT_STEPS - e->x) + e->b * (box.first_y * MT_STEPS - e->y);
        highest[i] = e->a * (e->a > 0 ? last : first) + e->b * (e->b > 0 ? last : first);
    }
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        int32_t e[3] = {row[0], row[1], row[2]};
        for (int32_t x = box.first_x; x <= box.last_x; x++) {
            bool touched = ((e[0] + highest[0]) | (e[1] + highest[1]) | (e[2] + highest[2])) >= 0;
            if (touched && s->plane.nearest > tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)]) {
                draw_small_pixel(tile, s, &at, e, group_count, x, y);
            }
            for (int i = 0; i < 3; i++) {
                e[i] += s->edges[i].a * MT_STEPS;
            }
        }
        for (int i = 0; i < 3; i++) {
            row[i] += s->edges[i].b * MT_STEPS;
        }
    }
}

/* A pixel of a large triangle; whole: no edge passes through its samples. */
MT_INLINE void draw_large_pixel(const mt_frame *frame, mt_tile *tile, const setup *s, const int64_t e[3], bool whole,
                                int32_t x, int32_t y)
{
    const vector8f *xs = (const vector8f *)frame->sample_x, *ys = (const vector8f *)frame->sample_y;
    size_t pixel = mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y), lane = pixel * tile->lane_count;
    unsigned group_count = frame->lane_count / MT_GROUP_SIZE;
    float depth = depth_at(s, x, y);
    for (unsigned g = 0; g < group_count; g++) {
        vector8i inside = ~(vector8i){0};
        if (!whole) {
            vector8d dx = __builtin_convertvector(xs[g], vector8d), dy = __builtin_convertvector(ys[g], vector8d);
            for (int i = 0; i < 3; i++) {
                vector8d at = (double)e[i] + ((double)s->edges[i].a * dx + (double)s->edges[i].b * dy);
                inside &= __builtin_convertvector(at, vector8f) >= 0.0F;
            }
        }
        vector8f near = depth + (s->slope_x * xs[g] + s->slope_y * ys[g]);
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(s, &inside, &near, tile->depths + first, tile->numbers + first);
    }
    tile->floors[pixel] = floor_of(tile->depths + lane, group_count);
}

/* How the edge functions of a large triangle change: from a pixel's corner to its samples, and from pixel to pixel. */
typedef struct slopes {
    int64_t lowest[3], highest[3];
    double pixels_per_unit[3]; /* along a row; infinite for a level edge */
} slopes;

MT_INLINE slopes slopes_of(const mt_frame *frame, const setup *s)
{
    slopes change;
    int64_t first = frame->sample_first, last = frame->sample_last;
    for (int i = 0; i < 3; i++) {
        int64_t a = s->edges[i].a, b = s->edges[i].b;
        change.lowest[i] = a * (a > 0 ? first : last) + b * (b > 0 ? first : last);
        change.highest[i] = a * (a > 0 ? last : first) + b * (b > 0 ? last : first);
        change.pixels_per_unit[i] = 1.0 / ((double)a * MT_STEPS);
    }
    return change;
}

/* Pixels of the row at `top` (in steps) that the edges leave between first and last; one that rounding adds is found
 * outside by the exact test. */
MT_INLINE void narrow_row(const setup *s, const slopes *change, int64_t top, int32_t *first, int32_t *last)
{
    double low = *first, high = *last;
    for (int i = 0; i < 3; i++) {
        double at_zero = (double)(edge_at(&s->edges[i], 0, top) + change->highest[i]);
        double crossing = -at_zero * change->pixels_per_unit[i];
        if (s->edges[i].a > 0) {
            low = crossing > low ? crossing : low;
        } else if (s->edges[i].a < 0) {
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

MT_INLINE void draw_large(const mt_frame *frame, mt_tile *tile, const setup *s, pixel_box box)
{
    slopes change = slopes_of(frame, s);
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        int32_t first = box.first_x, last = box.last_x;
        narrow_row(s, &change, (int64_t)y * MT_STEPS, &first, &last);
        for (int32_t x = first; x <= last && x <= box.last_x; x++) {
            int64_t e[3], outside = 0, crossed = 0;
            for (int i = 0; i < 3; i++) {
                e[i] = edge_at(&s->edges[i], (int64_t)x * MT_STEPS, (int64_t)y * MT_STEPS);
                outside |= e[i] + change.highest[i];
                crossed |= e[i] + change.lowest[i];
            }
            if (outside >= 0 && s->plane.nearest > tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)]) {
                draw_large_pixel(frame, tile, s, e, crossed >= 0, x, y);
            }
        }
    }
}

MT_INLINE pixel_box clip(pixel_box box, const mt_tile *tile)
{
    int32_t left = (int32_t)tile->x, top = (int32_t)tile->y;
    int32_t right = left + (int32_t)tile->width - 1, bottom = top + (int32_t)tile->height - 1;
    box.first_x = box.first_x > left ? box.first_x : left;
    box.first_y = box.first_y > top ? box.first_y : top;
    box.last_x = box.last_x < right ? box.last_x : right;
    box.last_y = box.last_y < bottom ? box.last_y : bottom;
    return box;
}

MT_INLINE void prefetch(const mt_frame *frame, const mt_index *triangles, size_t count, size_t i)
{
    const mt_triangulation *triangulation = &frame->model->triangulation;
    const mt_index *vertices = frame->model->mesh->corner_vertices;
    if (i + 2 * PREFETCH_DISTANCE < count) {
        mt_index triangle = triangles[i + 2 * PREFETCH_DISTANCE];
        __builtin_prefetch(&vertices[mt_triangulation_corner(triangulation, triangle, 0)]);
    }
    if (i + PREFETCH_DISTANCE < count) {
        prefetch_vertices(frame, triangles[i + PREFETCH_DISTANCE]);
    }
}

/* Whether everything drawn so far hides the triangle. */
MT_INLINE bool is_hidden(const mt_tile *tile, const corners *c, pixel_box box)
{
    double near = c->v[0]->depth > c->v[1]->depth ? c->v[0]->depth : c->v[1]->depth;
    float nearest = (float)(c->v[2]->depth > near ? c->v[2]->depth : near);
    float floor = INFINITY;
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        for (int32_t x = box.first_x; x <= box.last_x; x++) {
            float here = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            floor = here < floor ? here : floor;
        }
    }
    return nearest <= floor;
}

MT_CLONES
static void draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    unsigned group_count = frame->lane_count / MT_GROUP_SIZE;
    for (size_t i = 0; i < count; i++) {
        prefetch(frame, triangles, count, i);
        corners c = load_corners(frame, triangles[i]);
        pixel_box whole = box_of(frame, &c), box = clip(whole, tile);
        bool small = whole.last_x - whole.first_x < SMALL_SIZE && whole.last_y - whole.first_y < SMALL_SIZE;
        if (box.first_x > box.last_x || box.first_y > box.last_y || (small && is_hidden(tile, &c, box))) {
            continue;
        }
        setup s;
        prepare(triangles[i], &c, &s);
        if (!small) {
            draw_large(frame, tile, &s, box);
        } else if (group_count == 2) {
            draw_small(frame, tile, &s, box, 2); /* the usual 16 samples, unrolled */
        } else {
            draw_small(frame, tile, &s, box, group_count);
        }
    }
}

void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    draw_triangles(frame, tile, triangles, count);
}
