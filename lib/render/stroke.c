/* A sample belongs to a stroke when it is within the radius of its segment, so lines have round ends and a segment
 * of no length is a dot. Depth is that of the nearest point of the segment, linear on the picture. */
#include "lib/render/stroke.h"

#include "lib/render/vectors.h"

#include <math.h>

/* A segment in steps of the grid. */
typedef struct segment {
    double x, y, along_x, along_y;
    double per_length_squared; /* 0 for a dot */
    double radius;
    double depth, depth_along; /* with the set's nearness */
} segment;

static inline segment segment_of(const mt_stroke_set *set, mt_index number)
{
    const mt_screen_vertex *a = &set->frame->vertices[set->strokes[number].a];
    const mt_screen_vertex *b = &set->frame->vertices[set->strokes[number].b];
    segment s = {.x = a->x, .y = a->y, .along_x = (double)b->x - a->x, .along_y = (double)b->y - a->y};
    double length_squared = s.along_x * s.along_x + s.along_y * s.along_y;
    s.per_length_squared = length_squared > 0 ? 1.0 / length_squared : 0.0;
    bool is_dot = set->strokes[number].a == set->strokes[number].b;
    s.radius = (is_dot ? set->dot_radius : set->line_radius) * set->frame->unit;
    s.depth = a->depth * set->nearness;
    s.depth_along = (b->depth - a->depth) * set->nearness;
    return s;
}

/* The pixels of a segment's box. */
typedef struct pixel_box {
    int64_t first_x, first_y, last_x, last_y;
} pixel_box;

static inline pixel_box box_of(const mt_stroke_set *set, const segment *s)
{
    double unit = set->frame->unit;
    pixel_box box;
    box.first_x = (int64_t)floor((s->x + fmin(s->along_x, 0.0) - s->radius) / unit);
    box.first_y = (int64_t)floor((s->y + fmin(s->along_y, 0.0) - s->radius) / unit);
    box.last_x = (int64_t)floor((s->x + fmax(s->along_x, 0.0) + s->radius) / unit);
    box.last_y = (int64_t)floor((s->y + fmax(s->along_y, 0.0) + s->radius) / unit);
    return box;
}

mt_tile_range mt_stroke_range(const mt_stroke_set *set, mt_index stroke)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    const mt_screen_vertex *vertices = set->frame->vertices;
    if (!(vertices[set->strokes[stroke].a].depth > 0 && vertices[set->strokes[stroke].b].depth > 0)) {
        return empty;
    }
    segment s = segment_of(set, stroke);
    pixel_box box = box_of(set, &s);
    return mt_tile_range_of(box.first_x, box.first_y, box.last_x, box.last_y, set->frame->camera.width,
                            set->frame->camera.height);
}

static inline double distance_squared(const segment *s, double x, double y)
{
    double t = ((x - s->x) * s->along_x + (y - s->y) * s->along_y) * s->per_length_squared;
    t = t > 0 ? (t < 1 ? t : 1.0) : 0.0;
    double dx = s->x + t * s->along_x - x, dy = s->y + t * s->along_y - y;
    return dx * dx + dy * dy;
}

/* Whether a square around (x, y) may reach into the stroke. */
static inline bool is_near(const segment *s, double x, double y, double side)
{
    double reach = s->radius + 0.7072 * side;
    return distance_squared(s, x, y) <= reach * reach;
}

bool mt_stroke_touches(const mt_stroke_set *set, mt_index stroke, uint32_t tile_x, uint32_t tile_y)
{
    segment s = segment_of(set, stroke);
    double size = MT_TILE_SIZE * set->frame->unit;
    return is_near(&s, (tile_x + 0.5) * size, (tile_y + 0.5) * size, size);
}

/* The samples of a group that the segment covers, and its depth at each. */
static inline vector4i cover(const segment *s, vector4d x, vector4d y, vector4f *depth)
{
    vector4d t = ((x - s->x) * s->along_x + (y - s->y) * s->along_y) * s->per_length_squared;
    const vector4d one = {1.0, 1.0, 1.0, 1.0};
    vector4l under = t > 0.0, over = t > 1.0;
    t = (vector4d)((((vector4l)t & ~over) | ((vector4l)one & over)) & under);
    vector4d dx = s->x + t * s->along_x - x, dy = s->y + t * s->along_y - y;
    *depth = __builtin_convertvector(s->depth + t * s->depth_along, vector4f);
    return __builtin_convertvector(dx * dx + dy * dy <= s->radius * s->radius, vector4i);
}

static inline void draw_pixel(const mt_frame *frame, const segment *s, double left, double top, int32_t number,
                              float *depths, mt_index *numbers)
{
    const vector4d *xs = (const vector4d *)frame->sample_x, *ys = (const vector4d *)frame->sample_y;
    for (unsigned g = 0; g < frame->lane_count / 4; g++) {
        vector4f near;
        vector4i inside = cover(s, left + xs[g], top + ys[g], &near);
        vector4f *old = (vector4f *)(depths + 4 * g);
        vector4i *old_number = (vector4i *)(numbers + 4 * g);
        vector4i wins = inside & (near > *old);
        *old = (vector4f)(((vector4i)near & wins) | ((vector4i)*old & ~wins));
        *old_number = (number & wins) | (*old_number & ~wins);
    }
}

static inline void mark_pixel(const mt_frame *frame, const segment *s, double left, double top, int32_t number,
                              const float *depths, mt_index *marks)
{
    const vector4d *xs = (const vector4d *)frame->sample_x, *ys = (const vector4d *)frame->sample_y;
    for (unsigned g = 0; g < frame->lane_count / 4; g++) {
        vector4f near;
        vector4i inside = cover(s, left + xs[g], top + ys[g], &near);
        vector4i visible = near >= *(const vector4f *)(depths + 4 * g);
        vector4i *old = (vector4i *)(marks + 4 * g);
        /* The low bit is set for a hidden mark and, MT_NONE being all ones, for none. */
        vector4i open = ((*old & 1) == 1) & (visible | (*old == -1));
        vector4i wins = inside & open;
        vector4i value = 2 * number + (1 & ~visible);
        *old = (value & wins) | (*old & ~wins);
    }
}

/* The part of a stroke's box that lies in the tile. */
static inline pixel_box clip(pixel_box box, const mt_tile *tile)
{
    int64_t right = (int64_t)tile->x + tile->width - 1, bottom = (int64_t)tile->y + tile->height - 1;
    box.first_x = box.first_x > tile->x ? box.first_x : tile->x;
    box.first_y = box.first_y > tile->y ? box.first_y : tile->y;
    box.last_x = box.last_x < right ? box.last_x : right;
    box.last_y = box.last_y < bottom ? box.last_y : bottom;
    return box;
}

static inline void draw_stroke(const mt_stroke_set *set, mt_tile *tile, mt_index stroke, int32_t number, bool mark)
{
    const mt_frame *frame = set->frame;
    segment s = segment_of(set, stroke);
    pixel_box box = clip(box_of(set, &s), tile);
    for (int64_t y = box.first_y; y <= box.last_y; y++) {
        for (int64_t x = box.first_x; x <= box.last_x; x++) {
            double left = (double)x * frame->unit, top = (double)y * frame->unit;
            if (!is_near(&s, left + 0.5 * frame->unit, top + 0.5 * frame->unit, frame->unit)) {
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
void mt_draw_strokes(const mt_stroke_set *set, mt_tile *tile, const mt_index *strokes, size_t count,
                     mt_index first_number)
{
    for (size_t i = 0; i < count; i++) {
        draw_stroke(set, tile, strokes[i], (int32_t)(first_number + strokes[i]), false);
    }
}

MT_CLONES
void mt_draw_marks(const mt_stroke_set *set, mt_tile *tile, const mt_index *strokes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        draw_stroke(set, tile, strokes[i], (int32_t)strokes[i], true);
    }
}
