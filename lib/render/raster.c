/* Object-order visibility after Pineda, "A Parallel Algorithm for Polygon Rasterization" (1988): three edge functions,
 * linear over the picture, whose signs say whether a sample is inside.
 *
 * Invariant: the hit test (hit.h) decides, as it does for rays. Edge functions and planes of depth, in floats for
 * triangles of a few pixels and in doubles for larger ones, carry bounds on how far they and the hit test may be apart.
 * Where they are clear they are the hit test's answer; where they leave a doubt, about a sample near an edge or about
 * two layers that nearly touch, the hit test is asked itself, equal t goes to the lowest triangle. So a picture is the
 * same whichever order finds it, and neighbours leave no gap.
 *
 * Cost: per triangle a set-up, per pixel of its box three comparisons, and its samples where an edge passes; one sample
 * in a hundred or so of a fine mesh is asked about, and all of those where two surfaces coincide. */
#include "lib/render/raster.h"

#include "lib/render/triangle.h"
#include "lib/render/vectors.h"

#include <math.h>

#define MAXIMUM_GROUPS (MT_MAXIMUM_SAMPLES / MT_GROUP_SIZE)

/* Pixels along the box of a triangle that is drawn in floats: with more, their rounding would leave doubts. */
#define SMALL_SIZE 8

/* A plane of depth ready for the samples. */
typedef struct depth_setup {
    depth_plane plane;
    float slope_x, slope_y;
    mt_index number;
} depth_setup;

void mt_triangle_depths(const mt_frame *frame, mt_tile *tile, uint32_t x, uint32_t y)
{
    const mt_sampling *sampling = &frame->sampling;
    size_t first = mt_tile_lane(tile, x, y);
    triangle_setup s = {.number = MT_NONE};
    for (unsigned lane = 0; lane < sampling->lane_count; lane++) {
        mt_index triangle = tile->numbers[first + lane];
        if (triangle == MT_NONE) {
            continue;
        }
        if (triangle != s.number) {
            make_setup(frame, triangle, &s);
        }
        float slope = s.slope_x * sampling->x[lane] + s.slope_y * sampling->y[lane];
        tile->depths[first + lane] = depth_at(&s.plane, (int32_t)x, (int32_t)y) + slope;
    }
}

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

__attribute__((noinline)) static void settle_groups(const mt_frame *frame, mt_tile *tile, mt_index triangle, int32_t x,
                                                    int32_t y, const vector8i *groups, unsigned group_count)
{
    for (unsigned g = 0; g < group_count; g++) {
        for (unsigned lanes = mt_lane_bits(&groups[g]); lanes; lanes &= lanes - 1) {
            unsigned lane = MT_GROUP_SIZE * g + (unsigned)__builtin_ctz(lanes);
            settle(frame, tile, triangle, (uint32_t)x, (uint32_t)y, lane);
        }
    }
}

/* Stores the triangle in the samples of a group where it is clearly inside and nearest; *doubt receives those about
 * which the hit test is to be asked. */
MT_INLINE void store_group(const depth_setup *s, const vector8i *maybe, const vector8i *inside, const vector8f *near,
                           float *depths, mt_index *numbers, vector8i *doubt)
{
    vector8f *old = (vector8f *)depths;
    vector8i *old_number = (vector8i *)numbers;
    vector8f nearer = *near - *old, band = *old * DEPTH_BAND;
    vector8i wins = *inside & (nearer > band);
    *doubt = *maybe & ~wins & (nearer >= -band);
    *old = (vector8f)(((vector8i)*near & wins) | ((vector8i)*old & ~wins));
    *old_number = ((int32_t)s->number & wins) | (*old_number & ~wins);
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

/* Whether a triangle that comes as near as `nearest` is clearly behind all samples of which `floor` is the farthest. */
MT_INLINE bool is_behind(float nearest, float floor)
{
    return nearest < floor - floor * DEPTH_BAND;
}

/* A small triangle: edge functions in floats, from the top left corner of its box, with their doubt added. */
typedef struct small_setup {
    depth_setup depth;
    float a[3], b[3], c[3], doubt[3]; /* twice the doubt */
    float lowest[3];                  /* at a pixel's corner, from which a sample may be inside */
} small_setup;

MT_INLINE void prepare_depth(const mt_frame *frame, mt_index triangle, const corners *c, depth_setup *s)
{
    s->plane = make_plane(frame, c);
    s->slope_x = (float)s->plane.slope_x;
    s->slope_y = (float)s->plane.slope_y;
    s->number = triangle;
}

MT_INLINE void prepare_small(const mt_frame *frame, mt_index triangle, const corners *c, pixel_box whole,
                             small_setup *s)
{
    prepare_depth(frame, triangle, c, &s->depth);
    float x[3], y[3], first = (float)frame->sampling.first, last = (float)frame->sampling.last;
    for (int i = 0; i < 3; i++) {
        x[i] = (float)(c->v[i]->x - (double)whole.first_x * MT_STEPS);
        y[i] = (float)(c->v[i]->y - (double)whole.first_y * MT_STEPS);
    }
    int32_t width = whole.last_x - whole.first_x, height = whole.last_y - whole.first_y;
    float size = (float)((width > height ? width : height) + 2) * MT_STEPS, doubt = (float)doubt_of(frame, c);
    float sign = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) < 0 ? -1.0F : 1.0F;
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        float a = sign * (y[i] - y[next]), b = sign * (x[next] - x[i]);
        float own = (fabsf(a) + fabsf(b)) * doubt + size * size * FLOAT_ROUNDING;
        s->a[i] = a, s->b[i] = b;
        s->c[i] = own - (a * x[i] + b * y[i]);
        s->doubt[i] = 2.0F * own;
        s->lowest[i] = -(a * (a > 0 ? last : first) + b * (b > 0 ? last : first)) - own;
    }
}

/* Offsets of a small triangle's functions at the samples of a pixel. */
typedef struct offsets {
    vector8f edges[3][MAXIMUM_GROUPS], depths[MAXIMUM_GROUPS];
} offsets;

MT_INLINE void draw_small_pixel(const mt_frame *frame, mt_tile *tile, const small_setup *s, const offsets *at,
                                const float e[3], unsigned group_count, int32_t x, int32_t y)
{
    size_t pixel = mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y), lane = pixel * tile->lane_count;
    float depth = depth_at(&s->depth.plane, x, y);
    vector8i doubts[MAXIMUM_GROUPS], any = {0};
    for (unsigned g = 0; g < group_count; g++) {
        vector8f e0 = e[0] + at->edges[0][g], e1 = e[1] + at->edges[1][g], e2 = e[2] + at->edges[2][g];
        vector8i maybe = (e0 >= 0.0F) & (e1 >= 0.0F) & (e2 >= 0.0F);
        vector8i inside = (e0 > s->doubt[0]) & (e1 > s->doubt[1]) & (e2 > s->doubt[2]);
        inside &= s->depth.plane.vague ? 0 : -1;
        vector8f near = depth + at->depths[g];
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(&s->depth, &maybe, &inside, &near, tile->depths + first, tile->numbers + first, &doubts[g]);
        any |= doubts[g];
    }
    if (__builtin_expect(mt_any_lane(&any), 0)) {
        settle_groups(frame, tile, s->depth.number, x, y, doubts, group_count);
    }
    tile->floors[pixel] = floor_of(tile->depths + lane, group_count);
}

/* To the next pixel of the row. */
MT_INLINE void step_right(const small_setup *s, float e[3])
{
    for (int i = 0; i < 3; i++) {
        e[i] += s->a[i] * MT_STEPS;
    }
}

/* The box of a small triangle: everything in floats. */
MT_INLINE void draw_small(const mt_frame *frame, mt_tile *tile, const small_setup *s, pixel_box whole, pixel_box box,
                          unsigned group_count)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    offsets at;
    for (unsigned g = 0; g < group_count; g++) {
        for (int i = 0; i < 3; i++) {
            at.edges[i][g] = s->a[i] * xs[g] + s->b[i] * ys[g];
        }
        at.depths[g] = s->depth.slope_x * xs[g] + s->depth.slope_y * ys[g];
    }
    float left = (float)((box.first_x - whole.first_x) * MT_STEPS);
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        float top = (float)((y - whole.first_y) * MT_STEPS), e[3];
        for (int i = 0; i < 3; i++) {
            e[i] = s->a[i] * left + s->b[i] * top + s->c[i];
        }
        for (int32_t x = box.first_x; x <= box.last_x; x++, step_right(s, e)) {
            bool touched = e[0] >= s->lowest[0] && e[1] >= s->lowest[1] && e[2] >= s->lowest[2];
            float floor = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            if (touched && !is_behind(s->depth.plane.nearest, floor)) {
                draw_small_pixel(frame, tile, s, &at, e, group_count, x, y);
            }
        }
    }
}

/* A large triangle: edge functions in doubles. */
typedef struct large_setup {
    depth_setup depth;
    edge edges[3];
    double lowest[3], highest[3]; /* at a pixel's samples, above its corner */
} large_setup;

/* A pixel of a large triangle; whole: clearly all inside. */
MT_INLINE void draw_large_pixel(const mt_frame *frame, mt_tile *tile, const large_setup *s, const double e[3],
                                bool whole, int32_t x, int32_t y)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    size_t pixel = mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y), lane = pixel * tile->lane_count;
    unsigned group_count = frame->sampling.lane_count / MT_GROUP_SIZE;
    float depth = depth_at(&s->depth.plane, x, y);
    vector8i doubts[MAXIMUM_GROUPS], any = {0};
    for (unsigned g = 0; g < group_count; g++) {
        vector8i maybe = ~(vector8i){0}, inside = maybe;
        if (!whole) {
            vector8d dx = __builtin_convertvector(xs[g], vector8d), dy = __builtin_convertvector(ys[g], vector8d);
            for (int i = 0; i < 3; i++) {
                vector8d at = e[i] + (s->edges[i].a * dx + s->edges[i].b * dy);
                maybe &= __builtin_convertvector(at >= -s->edges[i].doubt, vector8i);
                inside &= __builtin_convertvector(at > s->edges[i].doubt, vector8i);
            }
        }
        inside &= s->depth.plane.vague ? 0 : -1;
        vector8f near = depth + (s->depth.slope_x * xs[g] + s->depth.slope_y * ys[g]);
        size_t first = lane + MT_GROUP_SIZE * g;
        store_group(&s->depth, &maybe, &inside, &near, tile->depths + first, tile->numbers + first, &doubts[g]);
        any |= doubts[g];
    }
    if (__builtin_expect(mt_any_lane(&any), 0)) {
        settle_groups(frame, tile, s->depth.number, x, y, doubts, group_count);
    }
    tile->floors[pixel] = floor_of(tile->depths + lane, group_count);
}

MT_INLINE void prepare_large(const mt_frame *frame, mt_index triangle, const corners *c, large_setup *s)
{
    if (is_placed(c)) {
        prepare_depth(frame, triangle, c, &s->depth);
        make_edges(frame, c, s->edges);
    } else {
        triangle_setup crossing;
        mt_crossing_setup(frame, triangle, &crossing);
        s->depth =
            (depth_setup){crossing.plane, (float)crossing.plane.slope_x, (float)crossing.plane.slope_y, triangle};
        s->edges[0] = crossing.edges[0], s->edges[1] = crossing.edges[1], s->edges[2] = crossing.edges[2];
    }
    double first = frame->sampling.first, last = frame->sampling.last;
    for (int i = 0; i < 3; i++) {
        double a = s->edges[i].a, b = s->edges[i].b;
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
        const edge *e = &s->edges[i];
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
                const edge *side = &s->edges[i];
                e[i] = side->a * ((double)x * MT_STEPS) + side->b * ((double)y * MT_STEPS) + side->c;
                touched &= e[i] + s->highest[i] >= -side->doubt;
                whole &= e[i] + s->lowest[i] > side->doubt;
            }
            float floor = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            if (touched && !is_behind(s->depth.plane.nearest, floor)) {
                draw_large_pixel(frame, tile, s, e, whole, x, y);
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
    float floor = INFINITY;
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        for (int32_t x = box.first_x; x <= box.last_x; x++) {
            float here = tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)];
            floor = here < floor ? here : floor;
        }
    }
    return is_behind((float)nearest_depth(c), floor);
}

MT_INLINE void draw_triangle(const mt_frame *frame, mt_tile *tile, mt_index triangle, unsigned group_count)
{
    corners c = load_corners(frame, triangle);
    bool placed = is_placed(&c);
    pixel_box whole = placed ? box_of(frame, &c) : mt_crossing_box(frame, triangle), box = clip(whole, tile);
    bool small = placed && whole.last_x - whole.first_x < SMALL_SIZE && whole.last_y - whole.first_y < SMALL_SIZE;
    if (box.first_x > box.last_x || box.first_y > box.last_y || (small && is_hidden(tile, &c, box))) {
        return;
    }
    if (!small) {
        large_setup s;
        prepare_large(frame, triangle, &c, &s);
        draw_large(frame, tile, &s, box);
        return;
    }
    small_setup s;
    prepare_small(frame, triangle, &c, whole, &s);
    if (group_count == 2) {
        draw_small(frame, tile, &s, whole, box, 2); /* the usual 16 samples, unrolled */
    } else {
        draw_small(frame, tile, &s, whole, box, group_count);
    }
}

MT_CLONES
static void draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        prefetch(frame, triangles, count, i);
        draw_triangle(frame, tile, triangles[i], frame->sampling.lane_count / MT_GROUP_SIZE);
    }
}

void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    draw_triangles(frame, tile, triangles, count);
}
