/* A triangle on the picture's grid: its corners, its box in pixels, its edge functions, its plane of depth. */
#ifndef MESHTOOL_RENDER_TRIANGLE_H
#define MESHTOOL_RENDER_TRIANGLE_H

#include "lib/render/frame.h"

#include <math.h>

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

#endif
