/* Averages the samples of each pixel in linear light. Samples that show the same triangle form a group, shaded once
 * at their middle; groups are taken in the order of their first sample, so the sum is always the same. */
#include "lib/render/resolve.h"

/* How much of a mark shines through what hides it. */
#define HIDDEN_MARK 0.3

/* Samples of a pixel that show the same thing. */
typedef struct group {
    mt_index number;
    unsigned sample_count;
    double weight; /* samples, less where a mark covers them */
    double x, y;   /* sums of the samples' offsets */
} group;

/* A sum of light; alpha counts what of the pixel is covered. */
typedef struct light_sum {
    mt_vec3 light;
    double alpha;
} light_sum;

void mt_facet_cache_clear(mt_facet_cache *cache)
{
    for (int i = 0; i < MT_FACET_CACHE_SIZE; i++) {
        cache->facets[i].triangle = MT_NONE;
    }
}

static void add(light_sum *sum, mt_vec3 light, double weight)
{
    sum->light = mt_vec3_add(sum->light, mt_vec3_scale(light, weight));
    sum->alpha += weight;
}

static mt_vec3 stroke_light(const mt_picture *picture, mt_index number, double x, double y)
{
    const mt_stroke *stroke = &picture->strokes.strokes[number];
    if (stroke->a != stroke->b) {
        return picture->look->wire_color;
    }
    return mt_dot_shade(picture->look, stroke->a, picture->strokes.dot_radius * picture->frame->unit, x, y);
}

static mt_vec3 light_of(const mt_picture *picture, mt_facet_cache *cache, mt_index number, double x, double y)
{
    mt_index triangle_count = picture->frame->model->triangulation.triangle_count;
    if (number >= triangle_count) {
        return stroke_light(picture, number - triangle_count, x, y);
    }
    mt_facet *facet = &cache->facets[number % MT_FACET_CACHE_SIZE];
    if (facet->triangle != number) {
        mt_facet_prepare(picture->look, number, facet);
    }
    return mt_facet_shade(picture->look, facet, x, y);
}

static double mark_opacity(mt_index mark)
{
    return mark == MT_NONE ? 0.0 : (mark & 1u) ? HIDDEN_MARK : 1.0;
}

static unsigned find_groups(const mt_frame *frame, const mt_index *numbers, const mt_index *marks, group *groups)
{
    unsigned count = 0, last = 0;
    for (unsigned sample = 0; sample < frame->sample_count; sample++) {
        mt_index number = numbers[sample];
        if (count == 0 || groups[last].number != number) {
            for (last = 0; last < count && groups[last].number != number; last++) {
            }
            if (last == count) {
                groups[count++] = (group){.number = number};
            }
        }
        groups[last].sample_count++;
        groups[last].weight += marks ? 1.0 - mark_opacity(marks[sample]) : 1.0;
        groups[last].x += frame->sample_x[sample];
        groups[last].y += frame->sample_y[sample];
    }
    return count;
}

static void add_marks(const mt_picture *picture, const mt_index *marks, light_sum *sum)
{
    const mt_look *look = picture->look;
    for (unsigned sample = 0; sample < picture->frame->sample_count; sample++) {
        if (marks[sample] != MT_NONE) {
            const mt_stroke *stroke = &picture->marks.strokes[marks[sample] / 2];
            mt_vec3 color = stroke->a == stroke->b ? look->dot_mark_color : look->line_mark_color;
            add(sum, color, mark_opacity(marks[sample]));
        }
    }
}

static mt_vec3 backdrop_at(const mt_picture *picture, uint32_t y)
{
    double t = (y + 0.5) / picture->frame->camera.height;
    return mt_vec3_add(mt_vec3_scale(picture->backdrop.top, 1.0 - t), mt_vec3_scale(picture->backdrop.bottom, t));
}

static void store(const mt_picture *picture, uint32_t x, uint32_t y, light_sum sum, mt_vec3 behind)
{
    float *pixel = mt_image_pixel(picture->image, x, y);
    double scale = 1.0 / picture->frame->sample_count;
    double alpha = sum.alpha * scale;
    if (picture->backdrop.transparent) {
        scale = sum.alpha > 0 ? 1.0 / sum.alpha : 0.0;
        pixel[3] = (float)alpha;
    } else {
        sum.light = mt_vec3_add(sum.light, mt_vec3_scale(behind, picture->frame->sample_count - sum.alpha));
    }
    pixel[0] = (float)(sum.light.x * scale);
    pixel[1] = (float)(sum.light.y * scale);
    pixel[2] = (float)(sum.light.z * scale);
}

/* Returns the number of samples that show the mesh. */
static unsigned resolve_pixel(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache, uint32_t x,
                              uint32_t y, light_sum *sum)
{
    const mt_frame *frame = picture->frame;
    size_t lane = mt_tile_lane(tile, x, y);
    const mt_index *marks = tile->marks ? tile->marks + lane : NULL;
    group groups[MT_MAXIMUM_SAMPLES];
    unsigned count = find_groups(frame, tile->numbers + lane, marks, groups), covered = 0;
    for (unsigned i = 0; i < count; i++) {
        if (groups[i].number == MT_NONE) {
            continue;
        }
        double per_sample = 1.0 / groups[i].sample_count;
        double at_x = x * frame->unit + groups[i].x * per_sample, at_y = y * frame->unit + groups[i].y * per_sample;
        add(sum, light_of(picture, cache, groups[i].number, at_x, at_y), groups[i].weight);
        covered += groups[i].sample_count;
    }
    if (marks) {
        add_marks(picture, marks, sum);
    }
    return covered;
}

uint64_t mt_resolve_tile(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache)
{
    uint64_t covered = 0;
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        mt_vec3 behind = backdrop_at(picture, y);
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            light_sum sum = {{0, 0, 0}, 0};
            covered += resolve_pixel(picture, tile, cache, x, y, &sum);
            store(picture, x, y, sum, behind);
        }
    }
    return covered;
}

void mt_resolve_blank(const mt_picture *picture, const mt_tile *tile)
{
    const light_sum nothing = {{0, 0, 0}, 0};
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        mt_vec3 behind = backdrop_at(picture, y);
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            store(picture, x, y, nothing, behind);
        }
    }
}
