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

#include "lib/render/vectors.h"

#include <math.h>

#define MAXIMUM_GROUPS (MT_MAXIMUM_SAMPLES / MT_GROUP_SIZE)

/* Pixels along the box of a triangle whose edge functions, at most 2 * (9 * 256)^2, are exact in floats. */
#define SMALL_SIZE 8

/* Triangles ahead whose vertices are asked for. */
#define PREFETCH_DISTANCE 8

/* Rounding to the grid moves an edge by less than a step. Where depth changes over its whole range within this many
 * steps, a sample's depth may leave the triangle's range and is held inside. */
#define STEEP_STEPS 4.0

/* A triangle's corners on the grid. */
typedef struct corners {
    const mt_screen_vertex *v[3];
    int32_t x[3], y[3];
} corners;

/* To nearest; coordinates stay above -2^25, and the sum keeps truncation among positive numbers. */
static inline int32_t on_grid(double steps)
{
    return (int32_t)(steps + (33554432.0 + 0.5)) - 33554432;
}

static inline corners load_corners(const mt_frame *frame, mt_index triangle)
{
    const mt_model *model = frame->model;
    const mt_index *vertices = model->mesh->corner_vertices;
    corners c;
    for (mt_index side = 0; side < 3; side++) {
        c.v[side] = &frame->vertices[vertices[mt_triangulation_corner(&model->triangulation, triangle, side)]];
        c.x[side] = on_grid(c.v[side]->x);
        c.y[side] = on_grid(c.v[side]->y);
    }
    return c;
}

/* Neighbours in the picture need not be neighbours in memory: vertices of triangles to come are fetched in time. */
static inline void prefetch_vertices(const mt_frame *frame, mt_index triangle)
{
    const mt_model *model = frame->model;
    const mt_index *vertices = model->mesh->corner_vertices;
    for (mt_index side = 0; side < 3; side++) {
        __builtin_prefetch(&frame->vertices[vertices[mt_triangulation_corner(&model->triangulation, triangle, side)]]);
    }
}

static inline int64_t doubled_area(const corners *c)
{
    int64_t ax = c->x[1] - c->x[0], ay = c->y[1] - c->y[0];
    int64_t bx = c->x[2] - c->x[0], by = c->y[2] - c->y[0];
    return ax * by - ay * bx;
}

static inline int32_t least(const int32_t v[3])
{
    int32_t m = v[0] < v[1] ? v[0] : v[1];
    return m < v[2] ? m : v[2];
}

static inline int32_t most(const int32_t v[3])
{
    int32_t m = v[0] > v[1] ? v[0] : v[1];
    return m > v[2] ? m : v[2];
}

/* Pixels with a sample inside the box of the triangle; first > last where there is none. */
typedef struct pixel_box {
    int32_t first_x, first_y, last_x, last_y;
} pixel_box;

static inline pixel_box box_of(const mt_frame *frame, const corners *c)
{
    int32_t up = MT_STEPS - 1 - frame->sample_last;
    pixel_box box;
    box.first_x = (least(c->x) + up) >> MT_STEP_BITS;
    box.first_y = (least(c->y) + up) >> MT_STEP_BITS;
    box.last_x = (most(c->x) - frame->sample_first) >> MT_STEP_BITS;
    box.last_y = (most(c->y) - frame->sample_first) >> MT_STEP_BITS;
    return box;
}

mt_tile_range mt_triangle_range(const mt_frame *frame, mt_index triangle)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    const mt_model *model = frame->model;
    if (model->skipped_faces && model->skipped_faces[mt_triangulation_face(&model->triangulation, triangle)]) {
        return empty;
    }
    if (triangle + PREFETCH_DISTANCE < model->triangulation.triangle_count) {
        prefetch_vertices(frame, triangle + PREFETCH_DISTANCE);
    }
    corners c = load_corners(frame, triangle);
    if (!(c.v[0]->depth > 0 && c.v[1]->depth > 0 && c.v[2]->depth > 0) || doubled_area(&c) == 0) {
        return empty;
    }
    pixel_box box = box_of(frame, &c);
    return mt_tile_range_of(box.first_x, box.first_y, box.last_x, box.last_y, frame->camera.width,
                            frame->camera.height);
}

/* An edge function A (x - x0) + B (y - y0), not negative inside. */
typedef struct edge {
    int32_t a, b, x, y;
} edge;

static inline void make_edges(const corners *c, edge edges[3])
{
    int32_t sign = doubled_area(c) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        edges[i] = (edge){sign * (c->y[i] - c->y[next]), sign * (c->x[next] - c->x[i]), c->x[i], c->y[i]};
    }
}

static inline int64_t edge_at(const edge *e, int64_t x, int64_t y)
{
    return e->a * (x - e->x) + e->b * (y - e->y);
}

bool mt_triangle_touches(const mt_frame *frame, mt_index triangle, uint32_t tile_x, uint32_t tile_y)
{
    corners c = load_corners(frame, triangle);
    edge edges[3];
    make_edges(&c, edges);
    for (int i = 0; i < 3; i++) {
        int64_t x = tile_x + (edges[i].a > 0), y = tile_y + (edges[i].b > 0);
        if (edge_at(&edges[i], x * MT_TILE_SIZE * MT_STEPS, y * MT_TILE_SIZE * MT_STEPS) < 0) {
            return false;
        }
    }
    return true;
}

/* Depth as a plane over the picture. */
typedef struct depth_plane {
    double x, y, depth, slope_x, slope_y;
    float nearest, farthest;
    bool steep;
} depth_plane;

/* Without branches: which corner comes first is anyone's guess. */
static inline bool comes_before(const mt_screen_vertex *a, const mt_screen_vertex *b)
{
    return (a->x < b->x) | ((a->x == b->x) & ((a->y < b->y) | ((a->y == b->y) & (a->depth < b->depth))));
}

/* The plane seen from a corner that does not depend on the order of the corners; exchanging the other two changes the
 * sign of every product's numerator and denominator and nothing else. */
static inline depth_plane make_plane(const corners *c)
{
    int first = comes_before(c->v[1], c->v[0]);
    first = comes_before(c->v[2], c->v[first]) ? 2 : first;
    const mt_screen_vertex *p = c->v[first], *q = c->v[first == 2 ? 0 : first + 1],
                           *r = c->v[first == 0 ? 2 : first - 1];
    double x1 = q->x - p->x, y1 = q->y - p->y, d1 = q->depth - p->depth;
    double x2 = r->x - p->x, y2 = r->y - p->y, d2 = r->depth - p->depth;
    double area = x1 * y2 - x2 * y1, scale = 1.0 / area;
    double low = d1 < d2 ? d1 : d2, high = d1 < d2 ? d2 : d1;
    low = low < 0 ? low : 0.0;
    high = high > 0 ? high : 0.0;
    depth_plane plane = {.x = p->x, .y = p->y, .depth = p->depth};
    plane.slope_x = (d1 * y2 - d2 * y1) * scale;
    plane.slope_y = (d2 * x1 - d1 * x2) * scale;
    plane.farthest = (float)(p->depth + low);
    plane.nearest = (float)(p->depth + high);
    /* Also when the triangle has an area on the grid alone, and the slopes are not numbers. */
    plane.steep = !((fabs(plane.slope_x) + fabs(plane.slope_y)) * STEEP_STEPS <= high - low);
    if (!(fabs(plane.slope_x) < 1.0 && fabs(plane.slope_y) < 1.0)) {
        plane.slope_x = plane.slope_y = 0;
    }
    return plane;
}

/* A triangle ready to be tested. */
typedef struct setup {
    edge edges[3];
    depth_plane plane;
    float slope_x, slope_y; /* the plane's, rounded */
    mt_index number;
} setup;

static inline void prepare(mt_index triangle, const corners *c, setup *s)
{
    make_edges(c, s->edges);
    s->plane = make_plane(c);
    s->slope_x = (float)s->plane.slope_x;
    s->slope_y = (float)s->plane.slope_y;
    s->number = triangle;
}

static inline void hold(vector8f *value, float low, float high)
{
    vector8f lows = low - (vector8f){0}, highs = high - (vector8f){0};
    vector8i under = *value<lows, over = *value> highs;
    *value = (vector8f)(((vector8i)*value & ~(under | over)) | ((vector8i)lows & under) | ((vector8i)highs & over));
}

/* Stores the triangle in the samples of a group that it covers and where it is nearest. */
static inline void store_group(const setup *s, const vector8i *inside, vector8f *near, float *depths, mt_index *numbers)
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

static inline float depth_at(const setup *s, int32_t x, int32_t y)
{
    double left = (double)x * MT_STEPS, top = (double)y * MT_STEPS;
    return (float)(s->plane.depth + (s->plane.slope_x * (left - s->plane.x) + s->plane.slope_y * (top - s->plane.y)));
}

/* The least depth of a pixel's samples: nothing farther can be seen there. */
static inline float floor_of(const float *depths, unsigned group_count)
{
    vector8f least = *(const vector8f *)depths;
    for (unsigned g = 1; g < group_count; g++) {
        const vector8f other = *(const vector8f *)(depths + MT_GROUP_SIZE * g);
        vector8i less = other < least;
        least = (vector8f)(((vector8i)other & less) | ((vector8i)least & ~less));
    }
    float floor = least[0];
    for (int i = 1; i < MT_GROUP_SIZE; i++) {
        floor = least[i] < floor ? least[i] : floor;
    }
    return floor;
}

/* Offsets of a small triangle's functions at the samples of a pixel. */
typedef struct offsets {
    vector8f edges[3][MAXIMUM_GROUPS], depths[MAXIMUM_GROUPS];
} offsets;

static inline void draw_small_pixel(mt_tile *tile, const setup *s, const offsets *at, const int32_t e[3],
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
static inline void draw_small(const mt_frame *frame, mt_tile *tile, const setup *s, pixel_box box, unsigned group_count)
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
static inline void draw_large_pixel(const mt_frame *frame, mt_tile *tile, const setup *s, const int64_t e[3],
                                    bool whole, int32_t x, int32_t y)
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

static inline void draw_large(const mt_frame *frame, mt_tile *tile, const setup *s, pixel_box box)
{
    int64_t lowest[3], highest[3], first = frame->sample_first, last = frame->sample_last;
    for (int i = 0; i < 3; i++) {
        int64_t a = s->edges[i].a, b = s->edges[i].b;
        lowest[i] = a * (a > 0 ? first : last) + b * (b > 0 ? first : last);
        highest[i] = a * (a > 0 ? last : first) + b * (b > 0 ? last : first);
    }
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        for (int32_t x = box.first_x; x <= box.last_x; x++) {
            int64_t e[3], outside = 0, crossed = 0;
            for (int i = 0; i < 3; i++) {
                e[i] = edge_at(&s->edges[i], (int64_t)x * MT_STEPS, (int64_t)y * MT_STEPS);
                outside |= e[i] + highest[i];
                crossed |= e[i] + lowest[i];
            }
            if (outside >= 0 && s->plane.nearest > tile->floors[mt_tile_pixel(tile, (uint32_t)x, (uint32_t)y)]) {
                draw_large_pixel(frame, tile, s, e, crossed >= 0, x, y);
            }
        }
    }
}

static inline pixel_box clip(pixel_box box, const mt_tile *tile)
{
    int32_t left = (int32_t)tile->x, top = (int32_t)tile->y;
    int32_t right = left + (int32_t)tile->width - 1, bottom = top + (int32_t)tile->height - 1;
    box.first_x = box.first_x > left ? box.first_x : left;
    box.first_y = box.first_y > top ? box.first_y : top;
    box.last_x = box.last_x < right ? box.last_x : right;
    box.last_y = box.last_y < bottom ? box.last_y : bottom;
    return box;
}

static inline void prefetch(const mt_frame *frame, const mt_index *triangles, size_t count, size_t i)
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
static inline bool is_hidden(const mt_tile *tile, const corners *c, pixel_box box)
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
void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
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
