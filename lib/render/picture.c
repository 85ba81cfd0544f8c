/* Each tile is drawn whole, then shaded, and its samples are dropped: beside the picture, memory is one tile for
 * each thread. Shading is deferred, so that hidden triangles cost none; it runs once for each triangle in a pixel, at
 * the middle of the samples that it covers there, and the samples are averaged in linear light. */
#include "lib/render/picture.h"

#include "lib/render/raster.h"
#include "lib/render/resolve.h"

#include <meshtool/checked.h>

/* Tiles between two reports of progress. */
#define TILES_PER_REPORT 256

/* Tiles that a thread takes at a time. */
#define TILES_PER_BLOCK 4

static mt_tile_range primitive_range(const void *user, mt_index number)
{
    const mt_picture *picture = (const mt_picture *)user;
    mt_index triangle_count = picture->frame->model->triangulation.triangle_count;
    return number < triangle_count ? mt_triangle_range(picture->frame, number)
                                   : mt_stroke_range(&picture->strokes, number - triangle_count);
}

static void primitive_narrow(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row)
{
    const mt_picture *picture = (const mt_picture *)user;
    mt_index triangle_count = picture->frame->model->triangulation.triangle_count;
    if (number < triangle_count) {
        mt_triangle_narrow(picture->frame, number, tile_y, row);
    } else {
        mt_stroke_narrow(&picture->strokes, number - triangle_count, tile_y, row);
    }
}

static mt_tile_range mark_range(const void *user, mt_index number)
{
    return mt_stroke_range((const mt_stroke_set *)user, number);
}

static void mark_narrow(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row)
{
    mt_stroke_narrow((const mt_stroke_set *)user, number, tile_y, row);
}

static mt_status sort(mt_context *context, mt_picture *picture)
{
    uint64_t count = (uint64_t)picture->frame->model->triangulation.triangle_count + picture->strokes.count;
    if (!mt_count_fits(count) || !mt_count_fits(2 * (uint64_t)picture->marks.count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "the mesh has too many faces and lines for one picture");
    }
    const mt_camera *camera = &picture->frame->camera;
    int part = mt_part_begin(context, "tile lists", "triangles, lines and dots sorted by 32 x 32 pixels");
    mt_binned binned = {picture, (mt_index)count, primitive_range, primitive_narrow};
    mt_status status = mt_bins_init(context, &binned, camera->width, camera->height, &picture->bins);
    if (status == MT_OK) {
        mt_binned marks = {&picture->marks, picture->marks.count, mark_range, mark_narrow};
        status = mt_bins_init(context, &marks, camera->width, camera->height, &picture->mark_bins);
    }
    mt_part_end(context, part);
    return status;
}

/* Draws primitives in ascending order: the triangles among them, then the strokes. */
static void draw_run(const mt_picture *picture, mt_tile *tile, const mt_index *numbers, size_t count)
{
    mt_index triangle_count = picture->frame->model->triangulation.triangle_count;
    size_t triangles = count;
    if (count > 0 && numbers[count - 1] >= triangle_count) {
        size_t low = 0;
        while (low < triangles) {
            size_t middle = low + (triangles - low) / 2;
            if (numbers[middle] < triangle_count) {
                low = middle + 1;
            } else {
                triangles = middle;
            }
        }
    }
    mt_draw_triangles(picture->frame, tile, numbers, triangles);
    mt_draw_strokes(&picture->strokes, tile, numbers + triangles, count - triangles, triangle_count);
}

/* Draws the tile's own primitives and those listed for all tiles, merged in ascending order. */
static void draw_primitives(const mt_picture *picture, mt_tile *tile, size_t tile_number)
{
    const mt_bins *bins = &picture->bins;
    const mt_index *numbers = bins->numbers + bins->firsts[tile_number];
    size_t count = bins->firsts[tile_number + 1] - bins->firsts[tile_number], at = 0;
    for (mt_index i = 0; i < bins->large_count; i++) {
        size_t begin = at;
        while (at < count && numbers[at] < bins->large[i]) {
            at++;
        }
        draw_run(picture, tile, numbers + begin, at - begin);
        draw_run(picture, tile, &bins->large[i], 1);
    }
    draw_run(picture, tile, numbers + at, count - at);
}

static void draw_marks(const mt_picture *picture, mt_tile *tile, size_t tile_number)
{
    const mt_bins *bins = &picture->mark_bins;
    size_t first = bins->firsts[tile_number];
    mt_draw_marks(&picture->marks, tile, bins->numbers + first, bins->firsts[tile_number + 1] - first);
    mt_draw_marks(&picture->marks, tile, bins->large, bins->large_count);
}

static bool is_blank(const mt_picture *picture, size_t tile_number)
{
    const mt_bins *bins = &picture->bins, *marks = &picture->mark_bins;
    return bins->large_count == 0 && bins->firsts[tile_number] == bins->firsts[tile_number + 1] &&
           marks->large_count == 0 && marks->firsts[tile_number] == marks->firsts[tile_number + 1];
}

static void clear(mt_tile *tile)
{
    size_t count = (size_t)tile->height * MT_TILE_SIZE * tile->lane_count;
    for (size_t lane = 0; lane < count; lane++) {
        tile->depths[lane] = 0;
        tile->numbers[lane] = MT_NONE;
    }
    for (size_t pixel = 0; pixel < (size_t)tile->height * MT_TILE_SIZE; pixel++) {
        tile->floors[pixel] = 0;
    }
    for (size_t lane = 0; tile->marks && lane < count; lane++) {
        tile->marks[lane] = MT_NONE;
    }
}

typedef struct draw_task {
    mt_context *context;
    const mt_picture *picture;
    size_t first_tile;
    uint64_t *covered; /* per tile of the picture */
    bool *failed;      /* per tile: memory was missing */
} draw_task;

static uint64_t draw_tile(const mt_picture *picture, mt_tile *tile, mt_facet_cache *cache, size_t tile_number)
{
    const mt_camera *camera = &picture->frame->camera;
    tile->x = (uint32_t)(tile_number % picture->bins.tiles_x) * MT_TILE_SIZE;
    tile->y = (uint32_t)(tile_number / picture->bins.tiles_x) * MT_TILE_SIZE;
    tile->width = camera->width - tile->x < MT_TILE_SIZE ? camera->width - tile->x : MT_TILE_SIZE;
    tile->height = camera->height - tile->y < MT_TILE_SIZE ? camera->height - tile->y : MT_TILE_SIZE;
    if (is_blank(picture, tile_number)) {
        mt_resolve_blank(picture, tile);
        return 0;
    }
    clear(tile);
    draw_primitives(picture, tile, tile_number);
    if (tile->marks) {
        draw_marks(picture, tile, tile_number);
    }
    return mt_resolve_tile(picture, tile, cache);
}

static void draw_tiles(void *user, uint64_t begin, uint64_t end)
{
    const draw_task *task = (const draw_task *)user;
    const mt_picture *picture = task->picture;
    unsigned lane_count = picture->frame->sampling.lane_count;
    size_t lanes = mt_tile_lane_count(lane_count);
    uint64_t layers = picture->marks.count > 0 ? 3 : 2;
    mt_tile tile = {.lane_count = lane_count};
    tile.depths = (float *)mt_try_allocate(task->context, (layers * lanes + MT_TILE_SIZE * MT_TILE_SIZE) * 4);
    mt_facet_cache *cache = (mt_facet_cache *)mt_try_allocate(task->context, sizeof *cache);
    if (tile.depths && cache) {
        tile.numbers = (mt_index *)(void *)(tile.depths + lanes);
        tile.marks = layers == 3 ? tile.numbers + lanes : NULL;
        tile.floors = tile.depths + layers * lanes;
        mt_facet_cache_clear(cache);
    }
    for (uint64_t i = begin; i < end; i++) {
        size_t number = task->first_tile + (size_t)i;
        task->failed[number] = !tile.depths || !cache;
        task->covered[number] = task->failed[number] ? 0 : draw_tile(picture, &tile, cache, number);
    }
    mt_free(task->context, tile.depths);
    mt_free(task->context, cache);
}

static mt_status draw_all(mt_context *context, draw_task *task, size_t tile_count)
{
    for (size_t first = 0; first < tile_count; first += TILES_PER_REPORT) {
        size_t count = tile_count - first < TILES_PER_REPORT ? tile_count - first : TILES_PER_REPORT;
        task->first_tile = first;
        mt_parallel_for(context, count, TILES_PER_BLOCK, draw_tiles, task);
        for (size_t tile = first; tile < first + count; tile++) {
            if (task->failed[tile]) {
                return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory left for a tile of the picture");
            }
        }
        mt_status status = mt_progress(context, "drawing", (double)(first + count) / (double)tile_count);
        if (status != MT_OK) {
            return status;
        }
    }
    return MT_OK;
}

static mt_status draw(mt_context *context, mt_picture *picture)
{
    size_t tile_count = (size_t)picture->bins.tiles_x * picture->bins.tiles_y;
    draw_task task = {.context = context, .picture = picture};
    task.covered = (uint64_t *)mt_allocate_array(context, tile_count, sizeof *task.covered);
    task.failed = (bool *)mt_allocate_array(context, tile_count, sizeof *task.failed);
    mt_status status = task.covered && task.failed ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        int part =
            mt_part_begin(context, "depth buffer and shading", "tile by tile, once for each triangle in a pixel");
        status = draw_all(context, &task, tile_count);
        mt_part_end(context, part);
    }
    picture->covered_samples = 0;
    for (size_t tile = 0; status == MT_OK && tile < tile_count; tile++) {
        picture->covered_samples += task.covered[tile];
    }
    mt_free(context, task.covered);
    mt_free(context, task.failed);
    return status;
}

mt_status mt_picture_draw(mt_context *context, mt_picture *picture)
{
    mt_status status = sort(context, picture);
    if (status == MT_OK) {
        status = draw(context, picture);
    }
    mt_bins_release(context, &picture->bins);
    mt_bins_release(context, &picture->mark_bins);
    return status;
}
