/* A triangle on the picture: its box in pixels, its edge functions, its plane of depth, and how far each can be
 * trusted. */
#ifndef MESHTOOL_RENDER_TRIANGLE_H
#define MESHTOOL_RENDER_TRIANGLE_H

#include "lib/render/frame.h"

#include <float.h>
#include <math.h>

/* Triangles ahead whose vertices are asked for. */
#define PREFETCH_DISTANCE 8

/* Two depths are told apart without the hit test when they differ by more than this part of themselves. A plane that
 * may be wrong by an eighth of it, or by half of it where the hit test sees an edge elsewhere, leaves depth to the hit
 * test altogether. Smaller: more of these; larger: more pairs of layers are asked about. */
#define DEPTH_BAND 0x1p-13F
#define PLANE_ERROR 0x1p-16
#define EDGE_ERROR 0x1p-14

/* Rounding, as parts of the largest term: of a sum of three products in double, and of a float one
 * that is then stepped along eight pixels. */
#define DOUBLE_ROUNDING 0x1p-49
#define FLOAT_ROUNDING 0x1p-19F

/* The same of a depth in floats that is stepped along eight pixels, as parts of what it changes along one. */
#define DEPTH_ROUNDING 0x1p-17F

/* A triangle's corners in the picture. */
typedef struct corners {
    const mt_screen_vertex *v[3];
} corners;

static inline corners load_corners(const mt_frame *frame, mt_index triangle)
{
    const mt_model *model = frame->model;
    const mt_index *vertices = model->mesh->corner_vertices;
    corners c;
    for (mt_index side = 0; side < 3; side++) {
        c.v[side] = &frame->vertices[vertices[mt_triangulation_corner(&model->triangulation, triangle, side)]];
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

static inline double least(double a, double b, double c)
{
    double m = a < b ? a : b;
    return m < c ? m : c;
}

static inline double most(double a, double b, double c)
{
    double m = a > b ? a : b;
    return m > c ? m : c;
}

static inline double nearest_depth(const corners *c)
{
    return most(c->v[0]->depth, c->v[1]->depth, c->v[2]->depth);
}

static inline double farthest_depth(const corners *c)
{
    return least(c->v[0]->depth, c->v[1]->depth, c->v[2]->depth);
}

/* Whether all corners have a place in the picture. */
static inline bool is_placed(const corners *c)
{
    return farthest_depth(c) > 0;
}

/* A displacement at the triangle's nearest corner, in steps. */
static inline double in_steps(const mt_frame *frame, const corners *c, double displacement)
{
    double scale = mt_camera_is_parallel(&frame->camera) ? 1.0 : nearest_depth(c);
    return frame->steps_per_unit * scale * displacement;
}

/* How much more the hit test may be wrong than about a triangle of good shape. */
static inline double shape_factor(const mt_frame *frame, const corners *c)
{
    if (!frame->precision.by_shape) {
        return 1.0;
    }
    double x1 = c->v[1]->x - c->v[0]->x, y1 = c->v[1]->y - c->v[0]->y;
    double x2 = c->v[2]->x - c->v[0]->x, y2 = c->v[2]->y - c->v[0]->y;
    double first = x1 * x1 + y1 * y1, second = x2 * x2 + y2 * y2;
    double squared = (first > second ? first : second) / fabs(x1 * y2 - x2 * y1);
    return squared < 1e6 ? 1.0 + squared : 1e6;
}

/* How far, in steps, the hit test may see the triangle from where it is drawn. */
static inline double doubt_of(const mt_frame *frame, const corners *c)
{
    return in_steps(frame, c, frame->precision.edges) * shape_factor(frame, c);
}

/* Pixels with a sample inside the box of the triangle; first > last where there is none. */
typedef struct pixel_box {
    int32_t first_x, first_y, last_x, last_y;
} pixel_box;

/* Wider than any picture on both sides. */
#define PIXEL_LIMIT 1048576.0

static inline int32_t pixel_of(double steps)
{
    double pixel = steps * (1.0 / MT_STEPS);
    pixel = pixel > -PIXEL_LIMIT ? (pixel < PIXEL_LIMIT ? pixel : PIXEL_LIMIT) : -PIXEL_LIMIT;
    return (int32_t)(pixel + 2 * PIXEL_LIMIT) - (int32_t)(2 * PIXEL_LIMIT);
}

static inline pixel_box box_of(const mt_frame *frame, const corners *c)
{
    double doubt = doubt_of(frame, c);
    double before = frame->sampling.last + doubt, after = doubt - frame->sampling.first;
    pixel_box box;
    box.first_x = -pixel_of(before - least(c->v[0]->x, c->v[1]->x, c->v[2]->x));
    box.first_y = -pixel_of(before - least(c->v[0]->y, c->v[1]->y, c->v[2]->y));
    box.last_x = pixel_of(most(c->v[0]->x, c->v[1]->x, c->v[2]->x) + after);
    box.last_y = pixel_of(most(c->v[0]->y, c->v[1]->y, c->v[2]->y) + after);
    return box;
}

/* An edge function a x + b y + c in steps, positive inside; nearer to zero than its doubt it says nothing. */
typedef struct edge {
    double a, b, c, doubt;
} edge;

/* Depth as a plane over the picture. */
typedef struct depth_plane {
    double x, y, depth, slope_x, slope_y;
    float nearest;
    bool vague; /* only the hit test knows the depth; the plane then is `nearest` everywhere */
} depth_plane;

static inline depth_plane vague_plane(double nearest)
{
    depth_plane plane = {.depth = nearest < (double)FLT_MAX ? nearest : (double)FLT_MAX, .vague = true};
    plane.nearest = (float)plane.depth;
    return plane;
}

static inline depth_plane make_plane(const mt_frame *frame, const corners *c)
{
    const mt_screen_vertex *p = c->v[0], *q = c->v[1], *r = c->v[2];
    double x1 = q->x - p->x, y1 = q->y - p->y, d1 = q->depth - p->depth;
    double x2 = r->x - p->x, y2 = r->y - p->y, d2 = r->depth - p->depth;
    double scale = 1.0 / (x1 * y2 - x2 * y1), nearest = nearest_depth(c), farthest = farthest_depth(c);
    depth_plane plane = {.x = p->x, .y = p->y, .depth = p->depth, .nearest = (float)nearest};
    plane.slope_x = (d1 * y2 - d2 * y1) * scale;
    plane.slope_y = (d2 * x1 - d1 * x2) * scale;
    double slope = fabs(plane.slope_x) + fabs(plane.slope_y), factor = shape_factor(frame, c);
    double reach = fabs(p->x) + fabs(p->y) + 2.0 * MT_STEPS * MT_PREVIEW_MAXIMUM_SIZE;
    double steps = in_steps(frame, c, frame->precision.plane) * factor + MT_STEPS * (double)DEPTH_ROUNDING;
    double moved = frame->precision.plane * factor * (mt_camera_is_parallel(&frame->camera) ? 1.0 : nearest * nearest);
    double error = slope * (steps + reach * DOUBLE_ROUNDING) + moved;
    double at_edges = slope * in_steps(frame, c, frame->precision.edges) * factor;
    /* Also when the slopes are not numbers. */
    bool clear = error <= PLANE_ERROR * farthest && at_edges <= EDGE_ERROR * farthest;
    return clear ? plane : vague_plane(nearest);
}

/* Depth at the top left corner of a pixel. */
static inline float depth_at(const depth_plane *plane, int32_t x, int32_t y)
{
    double left = (double)x * MT_STEPS, top = (double)y * MT_STEPS;
    return (float)(plane->depth + (plane->slope_x * (left - plane->x) + plane->slope_y * (top - plane->y)));
}

/* A triangle ready to be tested in doubles. */
typedef struct triangle_setup {
    edge edges[3];
    depth_plane plane;
    float slope_x, slope_y; /* the plane's, rounded */
    mt_index number;
} triangle_setup;

/* Of a triangle some of whose corners are beside or behind the eye (crossing.c). */
pixel_box mt_crossing_box(const mt_frame *frame, mt_index triangle);
void mt_crossing_setup(const mt_frame *frame, mt_index triangle, triangle_setup *setup);

static inline void make_edges(const mt_frame *frame, const corners *c, edge edges[3])
{
    double doubt = doubt_of(frame, c), reach = (double)MT_STEPS * MT_PREVIEW_MAXIMUM_SIZE;
    const mt_screen_vertex *p = c->v[0], *q = c->v[1], *r = c->v[2];
    double area = (q->x - p->x) * (r->y - p->y) - (r->x - p->x) * (q->y - p->y), sign = area < 0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        const mt_screen_vertex *from = c->v[i], *to = c->v[i == 2 ? 0 : i + 1];
        double a = sign * (from->y - to->y), b = sign * (to->x - from->x);
        double terms = fabs(a) * (fabs(from->x) + reach) + fabs(b) * (fabs(from->y) + reach);
        edges[i] = (edge){a, b, -(a * from->x + b * from->y), (fabs(a) + fabs(b)) * doubt + terms * DOUBLE_ROUNDING};
    }
}

static inline void make_setup(const mt_frame *frame, mt_index triangle, triangle_setup *setup)
{
    corners c = load_corners(frame, triangle);
    if (is_placed(&c)) {
        make_edges(frame, &c, setup->edges);
        setup->plane = make_plane(frame, &c);
    } else {
        mt_crossing_setup(frame, triangle, setup);
    }
    setup->slope_x = (float)setup->plane.slope_x;
    setup->slope_y = (float)setup->plane.slope_y;
    setup->number = triangle;
}

#endif
