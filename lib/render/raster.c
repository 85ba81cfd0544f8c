/* Object-order visibility after Pineda, "A Parallel Algorithm for Polygon Rasterization" (1988): three edge functions,
 * linear over the picture, whose signs say whether a sample is inside.
 *
 * Invariant: edge functions are computed without rounding (frame.c), so a sample inside a closed surface's outline
 * is covered whatever the triangles' shapes. Depth is linear on the picture; it is computed in doubles from the
 * vertices in a canonical order and rounded to float, so that the same triangle given twice, or two triangles in one
 * plane, are equally deep and the lowest wins instead of a speckle.
 *
 * Cost: per triangle a set-up, per pixel that its box touches three comparisons, and 16 samples where an edge passes.
 * Known limit: a triangle seen exactly edge-on, or thinner than 2^-14 of a pixel, covers nothing. */
#include "lib/render/raster.h"

#include "lib/render/vectors.h"

#include <math.h>

#define MAXIMUM_GROUPS (MT_MAXIMUM_SAMPLES / 4)

/* Slope of depth per step of the grid, relative to the triangle's range of depths, past which rounding may carry
 * a sample's depth out of that range; it is then held inside. */
#define STEEP 1e-3

typedef struct corners {
    mt_screen_vertex v[3];
} corners;

static inline corners load_corners(const mt_frame *frame, mt_index triangle)
{
    const mt_model *model = frame->model;
    const mt_index *vertices = model->mesh->corner_vertices;
    corners c;
    for (mt_index side = 0; side < 3; side++) {
        c.v[side] = frame->vertices[vertices[mt_triangulation_corner(&model->triangulation, triangle, side)]];
    }
    return c;
}

static inline double doubled_area(const corners *c)
{
    double ax = (double)c->v[1].x - c->v[0].x, ay = (double)c->v[1].y - c->v[0].y;
    double bx = (double)c->v[2].x - c->v[0].x, by = (double)c->v[2].y - c->v[0].y;
    return ax * by - ay * bx;
}

static inline int32_t least(int32_t a, int32_t b, int32_t c)
{
    int32_t m = a < b ? a : b;
    return m < c ? m : c;
}

static inline int32_t most(int32_t a, int32_t b, int32_t c)
{
    int32_t m = a > b ? a : b;
    return m > c ? m : c;
}

/* Pixels with a sample inside the box of the triangle; first > last where there is none. */
typedef struct pixel_box {
    int32_t first_x, first_y, last_x, last_y;
} pixel_box;

static inline pixel_box box_of(const mt_frame *frame, const corners *c)
{
    int32_t first = (int32_t)frame->sample_first, last = (int32_t)frame->sample_last;
    int32_t up = (1 << frame->unit_bits) - 1;
    pixel_box box;
    box.first_x = (least(c->v[0].x, c->v[1].x, c->v[2].x) - last + up) >> frame->unit_bits;
    box.first_y = (least(c->v[0].y, c->v[1].y, c->v[2].y) - last + up) >> frame->unit_bits;
    box.last_x = (most(c->v[0].x, c->v[1].x, c->v[2].x) - first) >> frame->unit_bits;
    box.last_y = (most(c->v[0].y, c->v[1].y, c->v[2].y) - first) >> frame->unit_bits;
    return box;
}

mt_tile_range mt_triangle_range(const mt_frame *frame, mt_index triangle)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    const mt_model *model = frame->model;
    if (model->skipped_faces && model->skipped_faces[mt_triangulation_face(&model->triangulation, triangle)]) {
        return empty;
    }
    corners c = load_corners(frame, triangle);
    if (!(c.v[0].depth > 0 && c.v[1].depth > 0 && c.v[2].depth > 0) || doubled_area(&c) == 0) {
        return empty;
    }
    pixel_box box = box_of(frame, &c);
    return mt_tile_range_of(box.first_x, box.first_y, box.last_x, box.last_y, frame->camera.width,
                            frame->camera.height);
}

/* An edge function A (x - x0) + B (y - y0), not negative inside. */
typedef struct edge {
    double a, b;
    double at_origin; /* at the top left corner of pixel (0, 0) of the picture; -0 is made +0 */
} edge;

static inline void make_edges(const corners *c, double area, edge edges[3])
{
    double sign = area < 0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        const mt_screen_vertex *from = &c->v[i], *to = &c->v[i == 2 ? 0 : i + 1];
        edges[i].a = sign * ((double)from->y - to->y);
        edges[i].b = sign * ((double)to->x - from->x);
        edges[i].at_origin = 0.0 - (edges[i].a * from->x + edges[i].b * from->y);
    }
}

bool mt_triangle_touches(const mt_frame *frame, mt_index triangle, uint32_t tile_x, uint32_t tile_y)
{
    corners c = load_corners(frame, triangle);
    edge edges[3];
    make_edges(&c, doubled_area(&c), edges);
    double size = MT_TILE_SIZE * frame->unit;
    for (int i = 0; i < 3; i++) {
        double x = edges[i].a > 0 ? tile_x + 1.0 : tile_x, y = edges[i].b > 0 ? tile_y + 1.0 : tile_y;
        if (edges[i].at_origin + edges[i].a * (x * size) + edges[i].b * (y * size) < 0) {
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

static inline bool comes_before(const mt_screen_vertex *a, const mt_screen_vertex *b)
{
    if (a->x != b->x) {
        return a->x < b->x;
    }
    return a->y != b->y ? a->y < b->y : a->depth < b->depth;
}

static inline void order(mt_screen_vertex *a, mt_screen_vertex *b)
{
    if (comes_before(b, a)) {
        mt_screen_vertex swap = *a;
        *a = *b;
        *b = swap;
    }
}

static inline depth_plane make_plane(corners c)
{
    order(&c.v[0], &c.v[1]);
    order(&c.v[1], &c.v[2]);
    order(&c.v[0], &c.v[1]);
    double x1 = (double)c.v[1].x - c.v[0].x, y1 = (double)c.v[1].y - c.v[0].y, d1 = c.v[1].depth - c.v[0].depth;
    double x2 = (double)c.v[2].x - c.v[0].x, y2 = (double)c.v[2].y - c.v[0].y, d2 = c.v[2].depth - c.v[0].depth;
    double scale = 1.0 / (x1 * y2 - x2 * y1);
    double low = c.v[0].depth < c.v[1].depth ? c.v[0].depth : c.v[1].depth;
    double high = c.v[0].depth < c.v[1].depth ? c.v[1].depth : c.v[0].depth;
    low = c.v[2].depth < low ? c.v[2].depth : low;
    high = c.v[2].depth > high ? c.v[2].depth : high;
    depth_plane plane = {.x = c.v[0].x, .y = c.v[0].y, .depth = c.v[0].depth};
    plane.slope_x = (d1 * y2 - d2 * y1) * scale;
    plane.slope_y = (d2 * x1 - d1 * x2) * scale;
    plane.farthest = (float)low;
    plane.nearest = (float)high;
    plane.steep = fabs(plane.slope_x) + fabs(plane.slope_y) > STEEP * (high - low);
    return plane;
}

/* A triangle ready to be tested: its edges and depth at every sample's offset from the pixel's corner. */
typedef struct setup {
    edge edges[3];
    depth_plane plane;
    double lowest[3], highest[3]; /* of the offsets of each edge */
    vector4d offsets[3][MAXIMUM_GROUPS];
    vector4d depth_offsets[MAXIMUM_GROUPS];
    unsigned group_count;
    mt_index number;
} setup;

static inline void prepare(const mt_frame *frame, mt_index triangle, const corners *c, setup *s)
{
    make_edges(c, doubled_area(c), s->edges);
    s->plane = make_plane(*c);
    s->number = triangle;
    s->group_count = frame->lane_count / 4;
    for (int i = 0; i < 3; i++) {
        double a = s->edges[i].a, b = s->edges[i].b, first = frame->sample_first, last = frame->sample_last;
        s->lowest[i] = a * (a > 0 ? first : last) + b * (b > 0 ? first : last);
        s->highest[i] = a * (a > 0 ? last : first) + b * (b > 0 ? last : first);
    }
    const vector4d *xs = (const vector4d *)frame->sample_x, *ys = (const vector4d *)frame->sample_y;
    for (unsigned g = 0; g < s->group_count; g++) {
        vector4d x = xs[g], y = ys[g];
        for (int i = 0; i < 3; i++) {
            s->offsets[i][g] = s->edges[i].a * x + s->edges[i].b * y;
        }
        s->depth_offsets[g] = s->plane.slope_x * x + s->plane.slope_y * y;
    }
}

static inline vector4f hold(vector4f value, float low, float high)
{
    vector4f lows = {low, low, low, low}, highs = {high, high, high, high};
    vector4i under = value<lows, over = value> highs;
    vector4i bits = ((vector4i)value & ~(under | over)) | ((vector4i)lows & under) | ((vector4i)highs & over);
    return (vector4f)bits;
}

/* Tests the samples of one pixel. e: the edge functions at its corner. */
static inline void draw_pixel(const setup *s, const double e[3], double depth, float *depths, mt_index *numbers)
{
    vector4i number = {(int32_t)s->number, (int32_t)s->number, (int32_t)s->number, (int32_t)s->number};
    for (unsigned g = 0; g < s->group_count; g++) {
        vector4l inside = ((e[0] + s->offsets[0][g]) >= 0.0) & ((e[1] + s->offsets[1][g]) >= 0.0) &
                          ((e[2] + s->offsets[2][g]) >= 0.0);
        vector4f near = __builtin_convertvector(depth + s->depth_offsets[g], vector4f);
        if (s->plane.steep) {
            near = hold(near, s->plane.farthest, s->plane.nearest);
        }
        vector4f *old = (vector4f *)(depths + 4 * g);
        vector4i *old_number = (vector4i *)(numbers + 4 * g);
        vector4i wins = __builtin_convertvector(inside, vector4i) & (near > *old);
        *old = (vector4f)(((vector4i)near & wins) | ((vector4i)*old & ~wins));
        *old_number = (number & wins) | (*old_number & ~wins);
    }
}

static inline void draw_box(const mt_frame *frame, mt_tile *tile, const setup *s, pixel_box box)
{
    double unit = frame->unit;
    for (int32_t y = box.first_y; y <= box.last_y; y++) {
        double top = y * unit, row_depth = s->plane.depth + s->plane.slope_y * (top - s->plane.y);
        for (int32_t x = box.first_x; x <= box.last_x; x++) {
            double left = x * unit, e[3];
            bool outside = false;
            for (int i = 0; i < 3; i++) {
                e[i] = s->edges[i].at_origin + (s->edges[i].a * left + s->edges[i].b * top);
                outside |= e[i] + s->highest[i] < 0;
            }
            if (outside) {
                continue;
            }
            size_t lane = mt_tile_lane(tile, (uint32_t)x, (uint32_t)y);
            double depth = row_depth + s->plane.slope_x * (left - s->plane.x);
            draw_pixel(s, e, depth, tile->depths + lane, tile->numbers + lane);
        }
    }
}

MT_CLONES
void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    int32_t left = (int32_t)tile->x, top = (int32_t)tile->y;
    int32_t right = left + (int32_t)tile->width - 1, bottom = top + (int32_t)tile->height - 1;
    for (size_t i = 0; i < count; i++) {
        corners c = load_corners(frame, triangles[i]);
        pixel_box box = box_of(frame, &c);
        box.first_x = box.first_x > left ? box.first_x : left;
        box.first_y = box.first_y > top ? box.first_y : top;
        box.last_x = box.last_x < right ? box.last_x : right;
        box.last_y = box.last_y < bottom ? box.last_y : bottom;
        if (box.first_x > box.last_x || box.first_y > box.last_y) {
            continue;
        }
        setup s;
        prepare(frame, triangles[i], &c, &s);
        draw_box(frame, tile, &s, box);
    }
}
