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
 * in a hundred or so of a fine mesh is asked about, and all of those where two surfaces coincide. What faces away from
 * the eye comes last, as on a closed surface it is hidden: that is found from floors, the depths behind which nothing
 * of a pixel, or of a whole tile, can be seen any more. */
#include "lib/render/raster.h"

#include "lib/render/large_triangle.h"
#include "lib/render/small_triangle.h"

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
    if (placed && is_behind((float)nearest_depth(&c), tile->floor)) {
        return;
    }
    pixel_box whole = placed ? box_of(frame, &c) : mt_crossing_box(frame, triangle), box = clip(whole, tile);
    bool small = placed && whole.last_x - whole.first_x < SMALL_SIZE && whole.last_y - whole.first_y < SMALL_SIZE;
    if (box.first_x > box.last_x || box.first_y > box.last_y || (small && is_hidden(tile, &c, box))) {
        return;
    }
    tile->drawn_pixels += (uint32_t)((box.last_x - box.first_x + 1) * (box.last_y - box.first_y + 1));
    if (!small) {
        large_setup s;
        prepare_large(frame, triangle, &s);
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

/* One after the other, in any order: what a sample shows does not depend on it. */
MT_INLINE void draw_next(const mt_frame *frame, mt_tile *tile, mt_index triangle)
{
    unsigned group_count = tile->lane_count / MT_GROUP_SIZE;
    draw_triangle(frame, tile, triangle, group_count);
    if (tile->drawn_pixels > PIXELS_PER_RENEWAL) {
        renew_floors(tile, group_count);
    }
}

MT_CLONES
static void draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        prefetch(frame, triangles, count, i);
        draw_next(frame, tile, triangles[i]);
    }
}

void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count)
{
    draw_triangles(frame, tile, triangles, count);
}

/* Whether it is wound against the clock in the picture, where y runs down. */
MT_INLINE bool turns_to_eye(const mt_frame *frame, mt_index triangle)
{
    corners c = load_corners(frame, triangle);
    double x1 = c.v[1]->x - c.v[0]->x, y1 = c.v[1]->y - c.v[0]->y;
    double x2 = c.v[2]->x - c.v[0]->x, y2 = c.v[2]->y - c.v[0]->y;
    return x1 * y2 - x2 * y1 < 0;
}

MT_CLONES
static size_t draw_front(const mt_frame *frame, mt_tile *tile, mt_index *triangles, size_t count)
{
    size_t later = 0;
    for (size_t i = 0; i < count; i++) {
        prefetch(frame, triangles, count, i);
        mt_index triangle = triangles[i];
        if (turns_to_eye(frame, triangle)) {
            draw_next(frame, tile, triangle);
        } else {
            triangles[i] = triangles[later];
            triangles[later++] = triangle;
        }
    }
    return later;
}

MT_CLONES
static void find_floors(mt_tile *tile)
{
    renew_floors(tile, tile->lane_count / MT_GROUP_SIZE);
}

void mt_draw_front_first(const mt_frame *frame, mt_tile *tile, mt_index *triangles, size_t count)
{
    size_t later = draw_front(frame, tile, triangles, count);
    if (later > 0) {
        find_floors(tile);
    }
    draw_triangles(frame, tile, triangles, later);
}
