#include "lib/render/changes.h"

#include <string.h>

/* Faces whose normals differ by less look as one surface: cosine of 10 degrees, squared. */
#define SAME_COSINE_SQUARED 0.97

static bool same_surface(const mt_picture *picture, mt_index a, mt_index b)
{
    const mt_triangulation *triangulation = &picture->frame->model->triangulation;
    if (a == b) {
        return true;
    }
    /* Strokes and nothing have larger numbers than triangles. */
    if (a >= triangulation->triangle_count || b >= triangulation->triangle_count) {
        return false;
    }
    mt_index face_a = mt_triangulation_face(triangulation, a), face_b = mt_triangulation_face(triangulation, b);
    if (face_a == face_b) {
        return true;
    }
    mt_vec3 n = mt_face_normal(picture->look->normals, face_a), m = mt_face_normal(picture->look->normals, face_b);
    double dot = mt_vec3_dot(n, m);
    bool bent = dot * dot < SAME_COSINE_SQUARED * mt_vec3_dot(n, n) * mt_vec3_dot(m, m);
    return !bent && !picture->look->has_colors;
}

static bool changes_within(const mt_picture *picture, const mt_tile *tile, size_t lane)
{
    for (unsigned i = 1; i < picture->frame->sampling.sample_count; i++) {
        if (!same_surface(picture, tile->numbers[lane], tile->numbers[lane + i]) ||
            (tile->marks && tile->marks[lane] != tile->marks[lane + i])) {
            return true;
        }
    }
    return false;
}

/* Against the pixel before or above: an edge may run between the samples of both. */
static bool changes_between(const mt_picture *picture, const mt_tile *tile, size_t lane, size_t other)
{
    return !same_surface(picture, tile->numbers[lane], tile->numbers[other]);
}

uint64_t mt_find_changes(const mt_picture *picture, const mt_tile *tile, unsigned char *wanted)
{
    memset(wanted, 0, (size_t)MT_TILE_SIZE * MT_TILE_SIZE);
    uint64_t count = 0;
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            size_t pixel = mt_tile_pixel(tile, x, y), lane = mt_tile_lane(tile, x, y);
            wanted[pixel] |= changes_within(picture, tile, lane);
            if (x > tile->x && changes_between(picture, tile, lane, mt_tile_lane(tile, x - 1, y))) {
                wanted[pixel] = wanted[pixel - 1] = 1;
            }
            if (y > tile->y && changes_between(picture, tile, lane, mt_tile_lane(tile, x, y - 1))) {
                wanted[pixel] = wanted[pixel - MT_TILE_SIZE] = 1;
            }
        }
    }
    for (size_t pixel = 0; pixel < (size_t)MT_TILE_SIZE * MT_TILE_SIZE; pixel++) {
        count += wanted[pixel];
    }
    return count;
}
