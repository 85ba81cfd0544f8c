/* A sample belongs to a stroke when it is within the radius of its segment, so lines have round ends and a segment
 * of no length is a dot. Depth is that of the nearest point of the segment, linear on the picture. */
#include "lib/render/stroke.h"

#include "lib/render/vectors.h"

#include <math.h>

/* Lines that run past the eye end at this distance from its plane; the extent of the mesh is about 1. */
#define CUT_DISTANCE 1e-4

/* A segment in steps of the grid. */
typedef struct segment {
    double x, y, along_x, along_y;
    double per_length_squared; /* 0 for a dot */
    double radius;
    double depth, depth_along; /* with the set's nearness */
} segment;

/* The place where a line from a vertex in front comes closest to the plane of the eye, if the other end is behind. */
__attribute__((noinline)) static mt_screen_vertex cut(const mt_frame *frame, mt_index front, mt_index behind)
{
    const mt_camera *camera = &frame->camera;
    mt_vec3 p = mt_model_position(frame->model, front), q = mt_model_position(frame->model, behind);
    double from = mt_vec3_dot(mt_vec3_subtract(p, camera->eye), camera->forward);
    double to = mt_vec3_dot(mt_vec3_subtract(q, camera->eye), camera->forward);
    double share = (from - fmin(CUT_DISTANCE, 0.5 * from)) / (from - to);
    mt_vec3 along = mt_vec3_scale(mt_vec3_subtract(q, p), share);
    mt_screen_point s = mt_camera_project(camera, mt_vec3_add(p, along));
    return (mt_screen_vertex){s.x * MT_STEPS, s.y * MT_STEPS, s.depth};
}

MT_INLINE segment segment_of(const mt_stroke_set *set, mt_index number)
{
    const mt_stroke *stroke = &set->strokes[number];
    const mt_screen_vertex *a = &set->frame->vertices[stroke->a], *b = &set->frame->vertices[stroke->b];
    mt_screen_vertex cut_end;
    if (__builtin_expect(a->depth < 0 || b->depth < 0, 0)) {
        cut_end = a->depth < 0 ? cut(set->frame, stroke->b, stroke->a) : cut(set->frame, stroke->a, stroke->b);
        *(a->depth < 0 ? &a : &b) = &cut_end;
    }
    segment s = {.x = a->x, .y = a->y, .along_x = (double)b->x - a->x, .along_y = (double)b->y - a->y};
    double length_squared = s.along_x * s.along_x + s.along_y * s.along_y;
    s.per_length_squared = length_squared > 0 ? 1.0 / length_squared : 0.0;
    bool is_dot = length_squared == 0;
    double line_radius = number >= set->thin_first ? set->thin_radius : set->line_radius;
    s.radius = (is_dot ? set->dot_radius : line_radius) * MT_STEPS;
    s.depth = a->depth * set->nearness;
    s.depth_along = (b->depth - a->depth) * set->nearness;
    return s;
}

/* The pixels of a segment's box. */
typedef struct pixel_box {
    int64_t first_x, first_y, last_x, last_y;
} pixel_box;

/* Far beyond every picture on both sides. */
MT_INLINE int64_t pixel_of(double steps)
{
    double pixel = floor(steps / MT_STEPS);
    return (int64_t)fmin(fmax(pixel, -1e6), 1e6);
}

MT_INLINE pixel_box box_of(const segment *s)
{
    pixel_box box;
    box.first_x = pixel_of(s->x + fmin(s->along_x, 0.0) - s->radius);
    box.first_y = pixel_of(s->y + fmin(s->along_y, 0.0) - s->radius);
    box.last_x = pixel_of(s->x + fmax(s->along_x, 0.0) + s->radius);
    box.last_y = pixel_of(s->y + fmax(s->along_y, 0.0) + s->radius);
    return box;
}

mt_tile_range mt_stroke_range(const mt_stroke_set *set, mt_index stroke)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    const mt_screen_vertex *vertices = set->frame->vertices;
    double first = vertices[set->strokes[stroke].a].depth, second = vertices[set->strokes[stroke].b].depth;
    if (first == 0 || second == 0 || !(first > 0 || second > 0)) {
        return empty;
    }
    segment s = segment_of(set, stroke);
    pixel_box box = box_of(&s);
    return mt_tile_range_of((int32_t)box.first_x, (int32_t)box.first_y, (int32_t)box.last_x, (int32_t)box.last_y,
                            set->frame->camera.width, set->frame->camera.height);
}

MT_INLINE double distance_squared(const segment *s, double x, double y)
{
    double t = ((x - s->x) * s->along_x + (y - s->y) * s->along_y) * s->per_length_squared;
    t = t > 0 ? (t < 1 ? t : 1.0) : 0.0;
    double dx = s->x + t * s->along_x - x, dy = s->y + t * s->along_y - y;
    return dx * dx + dy * dy;
}

/* Whether a square around (x, y) may reach into the stroke. */
MT_INLINE bool is_near(const segment *s, double x, double y, double side)
{
    double reach = s->radius + 0.7072 * side;
    return distance_squared(s, x, y) <= reach * reach;
}

/* The part of a segment that runs within a row of tiles, widened by its radius on all sides. */
void mt_stroke_narrow(const mt_stroke_set *set, mt_index stroke, uint32_t tile_y, mt_tile_range *row)
{
    segment s = segment_of(set, stroke);
    double size = MT_TILE_SIZE * (double)MT_STEPS, top = tile_y * size - s.radius;
    double bottom = top + size + 2.0 * s.radius, from = 0, to = 1;
    if (fabs(s.along_y) > s.radius) {
        double a = (top - s.y) / s.along_y, b = (bottom - s.y) / s.along_y;
        from = fmax(0.0, fmin(a, b));
        to = fmin(1.0, fmax(a, b));
    }
    double a = s.x + from * s.along_x, b = s.x + to * s.along_x;
    double low = (fmin(a, b) - s.radius) / size, high = (fmax(a, b) + s.radius) / size;
    if (from > to || high < row->first_x || low > row->last_x + 1.0) {
        *row = (mt_tile_range){1, 1, 0, 0};
        return;
    }
    row->first_x = low > row->first_x ? (uint16_t)low : row->first_x;
    row->last_x = high < row->last_x ? (uint16_t)high : row->last_x;
}

/* The samples of a group that the segment covers, and its depth at each. */
MT_INLINE void cover(const segment *s, double left, double top, const vector8f *xs, const vector8f *ys,
                     vector8i *inside, vector8f *depth)
{
    vector8d x = left + __builtin_convertvector(*xs, vector8d), y = top + __builtin_convertvector(*ys, vector8d);
    vector8d t = ((x - s->x) * s->along_x + (y - s->y) * s->along_y) * s->per_length_squared;
    const vector8d one = 1.0 - (vector8d){0};
    vector8l positive = t > 0.0, over = t > 1.0;
    t = (vector8d)((((vector8l)t & ~over) | ((vector8l)one & over)) & positive);
    vector8d dx = s->x + t * s->along_x - x, dy = s->y + t * s->along_y - y;
    *depth = __builtin_convertvector(s->depth + t * s->depth_along, vector8f);
    *inside = __builtin_convertvector(dx * dx + dy * dy <= s->radius * s->radius, vector8i);
}

MT_INLINE void draw_pixel(const mt_frame *frame, const segment *s, double left, double top, int32_t number,
                          float *depths, mt_index *numbers)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    for (unsigned g = 0; g < frame->sampling.lane_count / MT_GROUP_SIZE; g++) {
        vector8f near;
        vector8i inside;
        cover(s, left, top, &xs[g], &ys[g], &inside, &near);
        vector8f *old = (vector8f *)(depths + MT_GROUP_SIZE * g);
        vector8i *old_number = (vector8i *)(numbers + MT_GROUP_SIZE * g);
        vector8i wins = inside & (near > *old);
        *old = (vector8f)(((vector8i)near & wins) | ((vector8i)*old & ~wins));
        *old_number = (number & wins) | (*old_number & ~wins);
    }
}

MT_INLINE void mark_pixel(const mt_frame *frame, const segment *s, double left, double top, int32_t number,
                          const float *depths, mt_index *marks)
{
    const vector8f *xs = (const vector8f *)frame->sampling.x, *ys = (const vector8f *)frame->sampling.y;
    for (unsigned g = 0; g < frame->sampling.lane_count / MT_GROUP_SIZE; g++) {
        vector8f near;
        vector8i inside;
        cover(s, left, top, &xs[g], &ys[g], &inside, &near);
        vector8i visible = near >= *(const vector8f *)(depths + MT_GROUP_SIZE * g);
        vector8i *old = (vector8i *)(marks + MT_GROUP_SIZE * g);
        /* The low bit is set for a hidden mark and, MT_NONE being all ones, for none. */
        vector8i open = ((*old & 1) == 1) & (visible | (*old == -1));
        vector8i wins = inside & open;
        vector8i value = 2 * number + (1 & ~visible);
        *old = (value & wins) | (*old & ~wins);
    }
}

/* The part of a stroke's box that lies in the tile. */
MT_INLINE pixel_box clip(pixel_box box, const mt_tile *tile)
{
    int64_t right = (int64_t)tile->x + tile->width - 1, bottom = (int64_t)tile->y + tile->height - 1;
    box.first_x = box.first_x > tile->x ? box.first_x : tile->x;
    box.first_y = box.first_y > tile->y ? box.first_y : tile->y;
    box.last_x = box.last_x < right ? box.last_x : right;
    box.last_y = box.last_y < bottom ? box.last_y : bottom;
    return box;
}

MT_INLINE void draw_stroke(const mt_stroke_set *set, mt_tile *tile, mt_index stroke, int32_t number, bool mark)
{
    const mt_frame *frame = set->frame;
    segment s = segment_of(set, stroke);
    pixel_box box = clip(box_of(&s), tile);
    for (int64_t y = box.first_y; y <= box.last_y; y++) {
        for (int64_t x = box.first_x; x <= box.last_x; x++) {
            double left = (double)x * MT_STEPS, top = (double)y * MT_STEPS;
            if (!is_near(&s, left + 0.5 * MT_STEPS, top + 0.5 * MT_STEPS, MT_STEPS)) {
                continue;
            }
            size_t lane = mt_tile_lane(tile, (uint32_t)x, (uint32_t)y);
            if (mark) {
                mark_pixel(frame, &s, left, top, number, tile->depths + lane, tile->marks + lane);
            } else {
                draw_pixel(frame, &s, left, top, number, tile->depths + lane, tile->numbers + lane);
            }
        }
    }
}

MT_CLONES
static void draw_strokes(const mt_stroke_set *set, mt_tile *tile, const mt_index *numbers, size_t count,
                         mt_index first_number, bool mark)
{
    for (size_t i = 0; i < count; i++) {
        draw_stroke(set, tile, numbers[i], (int32_t)(first_number + numbers[i]), mark);
    }
}

void mt_draw_strokes(const mt_stroke_set *set, mt_tile *tile, const mt_index *numbers, size_t count,
                     mt_index first_number)
{
    draw_strokes(set, tile, numbers, count, first_number, false);
}

void mt_draw_marks(const mt_stroke_set *set, mt_tile *tile, const mt_index *strokes, size_t count)
{
    draw_strokes(set, tile, strokes, count, 0, true);
}
