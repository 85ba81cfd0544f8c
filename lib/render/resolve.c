/* Averages the samples of each pixel in linear light. Samples that show the same triangle form a group, shaded once
 * at their middle; groups are taken in the order of their first sample, so the sum is always the same. */
#include "lib/render/resolve.h"

#include "lib/render/ground.h"
#include "lib/render/vectors.h"

/* How much of a mark shines through what hides it. */
#define HIDDEN_MARK 0.4

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

MT_INLINE void add(light_sum *sum, mt_vec3 light, double weight)
{
    sum->light.x += light.x * weight;
    sum->light.y += light.y * weight;
    sum->light.z += light.z * weight;
    sum->alpha += weight;
}

/* The middle of some of a pixel's samples, in steps. */
typedef struct middle {
    double x, y;
} middle;

static middle middle_of(const mt_frame *frame, uint64_t samples, uint32_t x, uint32_t y)
{
    double sum_x = 0, sum_y = 0, count = 0;
    for (; samples; samples &= samples - 1) {
        int sample = __builtin_ctzll(samples);
        sum_x += (double)frame->sampling.x[sample];
        sum_y += (double)frame->sampling.y[sample];
        count++;
    }
    return (middle){(double)x * MT_STEPS + sum_x / count, (double)y * MT_STEPS + sum_y / count};
}

static mt_vec3 stroke_light(const mt_picture *picture, mt_index number, middle at)
{
    const mt_stroke *stroke = &picture->strokes.strokes[number];
    if (stroke->a != stroke->b) {
        return picture->look->wire_color;
    }
    return mt_dot_shade(picture->look, stroke->a, picture->strokes.dot_radius * MT_STEPS, at.x, at.y);
}

/* The light of what `number` stands for, seen through some samples of a pixel. */
MT_INLINE mt_vec3 light_of(const mt_picture *picture, mt_facet_cache *cache, mt_index number, uint64_t samples,
                           uint32_t x, uint32_t y)
{
    mt_index triangle_count = picture->frame->model->triangulation.triangle_count;
    if (number >= triangle_count) {
        return stroke_light(picture, number - triangle_count, middle_of(picture->frame, samples, x, y));
    }
    mt_facet *facet = &cache->facets[number % MT_FACET_CACHE_SIZE];
    if (facet->triangle != number) {
        mt_facet_prepare(picture->look, number, facet);
    }
    if (facet->is_small) {
        return facet->light;
    }
    middle at = middle_of(picture->frame, samples, x, y);
    double lit = 1.0;
    if (picture->look->shadows) {
        lit = mt_facet_lit(picture->look, facet, &picture->frame->sampling, samples, x, y);
    }
    return mt_facet_shade(picture->look, facet, at.x, at.y, lit);
}

MT_INLINE double mark_opacity(const mt_picture *picture, mt_index mark)
{
    bool faint = mark != MT_NONE && mark / 2 >= picture->faint_mark;
    if (mark == MT_NONE || (faint && (mark & 1u))) {
        return 0.0;
    }
    return faint ? picture->faint_opacity : (mark & 1u) ? HIDDEN_MARK : 1.0;
}

/* Samples, each less the part of it that a mark covers. */
static double weight_of(const mt_picture *picture, const mt_index *marks, uint64_t samples)
{
    double weight = 0;
    for (; samples; samples &= samples - 1) {
        weight += 1.0 - mark_opacity(picture, marks[__builtin_ctzll(samples)]);
    }
    return weight;
}

/* A bit for each sample that shows `number`. */
MT_INLINE uint64_t samples_of(const mt_index *numbers, unsigned group_count, mt_index number)
{
    uint64_t samples = 0;
    for (unsigned g = 0; g < group_count; g++) {
        vector8i here = *(const vector8i *)(numbers + MT_GROUP_SIZE * g) == (int32_t)number;
        samples |= (uint64_t)mt_lane_bits(&here) << (MT_GROUP_SIZE * g);
    }
    return samples;
}

static void add_marks(const mt_picture *picture, const mt_index *marks, light_sum *sum)
{
    const mt_look *look = picture->look;
    for (unsigned sample = 0; sample < picture->frame->sampling.sample_count; sample++) {
        if (marks[sample] != MT_NONE) {
            const unsigned char *rgb = picture->mark_colors + 3 * (size_t)(marks[sample] / 2);
            mt_vec3 color = mt_linear_color(&look->surface, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
            add(sum, color, mark_opacity(picture, marks[sample]));
        }
    }
}

/* The floor, where a pixel shows nothing else. */
static void add_ground(const mt_picture *picture, uint64_t samples, const mt_index *marks, uint32_t x, uint32_t y,
                       light_sum *sum)
{
    if (!samples) {
        return;
    }
    middle at = middle_of(picture->frame, samples, x, y);
    mt_vec3 light;
    double cover = mt_ground_shade(picture->look, &picture->frame->sampling, samples, x, y, at.x, at.y, &light);
    double weight = marks ? weight_of(picture, marks, samples) : (double)__builtin_popcountll(samples);
    if (cover > 0) {
        add(sum, light, weight * cover);
    }
}

static void store(const mt_picture *picture, uint32_t x, uint32_t y, light_sum sum, mt_vec3 behind)
{
    float *pixel = mt_image_pixel(picture->image, x, y);
    double scale = 1.0 / picture->frame->sampling.sample_count;
    double alpha = sum.alpha * scale;
    if (picture->backdrop.transparent) {
        scale = sum.alpha > 0 ? 1.0 / sum.alpha : 0.0;
        pixel[3] = (float)alpha;
    } else {
        sum.light = mt_vec3_add(sum.light, mt_vec3_scale(behind, picture->frame->sampling.sample_count - sum.alpha));
    }
    pixel[0] = (float)(sum.light.x * scale);
    pixel[1] = (float)(sum.light.y * scale);
    pixel[2] = (float)(sum.light.z * scale);
}

/* Returns the number of samples that show the mesh. */
MT_INLINE unsigned resolve_pixel(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache, uint32_t x,
                                 uint32_t y, light_sum *sum)
{
    unsigned count = picture->frame->sampling.sample_count, group_count = tile->lane_count / MT_GROUP_SIZE, covered = 0;
    size_t lane = mt_tile_lane(tile, x, y);
    const mt_index *numbers = tile->numbers + lane, *marks = tile->marks ? tile->marks + lane : NULL;
    uint64_t left = UINT64_MAX >> (64 - count);
    while (left) {
        mt_index number = numbers[__builtin_ctzll(left)];
        uint64_t samples = samples_of(numbers, group_count, number) & left;
        left &= ~samples;
        if (number != MT_NONE) {
            unsigned sample_count = (unsigned)__builtin_popcountll(samples);
            double weight = marks ? weight_of(picture, marks, samples) : sample_count;
            add(sum, light_of(picture, cache, number, samples, x, y), weight);
            covered += sample_count;
        }
    }
    if (picture->look->ground.is_drawn) {
        add_ground(picture, samples_of(numbers, group_count, MT_NONE) & (UINT64_MAX >> (64 - count)), marks, x, y, sum);
    }
    if (marks) {
        add_marks(picture, marks, sum);
    }
    return covered;
}

MT_CLONES
static uint64_t resolve_tile(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache)
{
    uint64_t covered = 0;
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        mt_vec3 behind = mt_backdrop_at(&picture->backdrop, y, picture->frame->camera.height);
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            light_sum sum = {{0, 0, 0}, 0};
            if (tile->wanted && !tile->wanted[mt_tile_pixel(tile, x, y)]) {
                continue;
            }
            covered += resolve_pixel(picture, tile, cache, x, y, &sum);
            store(picture, x, y, sum, behind);
        }
    }
    return covered;
}

uint64_t mt_resolve_tile(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache)
{
    return resolve_tile(picture, tile, cache);
}

void mt_resolve_blank(const mt_picture *picture, const mt_tile *tile)
{
    const light_sum nothing = {{0, 0, 0}, 0};
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        mt_vec3 behind = mt_backdrop_at(&picture->backdrop, y, picture->frame->camera.height);
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            store(picture, x, y, nothing, behind);
        }
    }
}
