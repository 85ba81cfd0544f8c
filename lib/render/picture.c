/* Each tile is drawn whole, then shaded, and its samples are dropped: beside the picture, memory is one tile for
 * each thread. Shading is deferred, so that hidden triangles cost none; it runs once for each triangle in a pixel, at
 * the middle of the samples that it covers there, and the samples are averaged in linear light. */
#include "lib/render/picture.h"

#include "lib/render/changes.h"
#include "lib/render/raster.h"
#include "lib/render/resolve.h"

#include <meshtool/checked.h>

#include <string.h>

/* Tiles between two reports of progress. */
#define TILES_PER_REPORT 256

/* Tiles that a thread takes at a time. */
#define TILES_PER_BLOCK 4

static mt_tile_range triangle_range(const void *user, mt_index number)
{
    return mt_triangle_range((const mt_frame *)user, number);
}

static void triangle_narrow(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row)
{
    mt_triangle_narrow((const mt_frame *)user, number, tile_y, row);
}

static mt_tile_range stroke_range(const void *user, mt_index number)
{
    return mt_stroke_range((const mt_stroke_set *)user, number);
}

static void stroke_narrow(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row)
{
    mt_stroke_narrow((const mt_stroke_set *)user, number, tile_y, row);
}

/* frame: the one whose samples reach farthest to the sides of pixels. */
static mt_status sort(mt_context *context, mt_picture *picture, const mt_frame *frame)
{
    uint64_t count = (uint64_t)picture->frame->model->triangulation.triangle_count + picture->strokes.count;
    if (!mt_count_fits(count) || !mt_count_fits(2 * (uint64_t)picture->marks.count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "the mesh has too many faces and lines for one picture");
    }
    const mt_camera *camera = &picture->frame->camera;
    int part = mt_part_begin(context, "tile lists",
                             picture->rays ? "lines and dots sorted by 32 x 32 pixels"
                                           : "triangles, lines and dots sorted by 32 x 32 pixels");
    mt_index triangle_count = picture->rays ? 0 : picture->frame->model->triangulation.triangle_count;
    const mt_binned binned[] = {{frame, triangle_count, triangle_range, triangle_narrow},
                                {&picture->strokes, picture->strokes.count, stroke_range, stroke_narrow},
                                {&picture->marks, picture->marks.count, stroke_range, stroke_narrow}};
    mt_bins *bins[] = {&picture->triangle_bins, &picture->stroke_bins, &picture->mark_bins};
    mt_status status = MT_OK;
    for (int i = 0; status == MT_OK && i < 3; i++) {
        status = mt_bins_init(context, &binned[i], camera->width, camera->height, bins[i]);
    }
    mt_part_end(context, part);
    return status;
}

/* The numbers listed for one tile. */
typedef struct listed {
    mt_index *numbers;
    size_t count;
} listed;

static listed listed_in(const mt_bins *bins, size_t tile_number)
{
    size_t first = bins->firsts[tile_number];
    return (listed){bins->numbers + first, bins->firsts[tile_number + 1] - first};
}

static bool is_touched(const mt_bins *bins, size_t tile_number)
{
    return bins->large_count > 0 || listed_in(bins, tile_number).count > 0;
}

/* Lines and dots are compared with one depth for each triangle and sample, however it was found. */
static void settle_depths(const mt_picture *picture, mt_tile *tile)
{
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            mt_triangle_depths(picture->frame, tile, x, y);
        }
    }
}

/* What is seen: triangles, then the strokes among them, then the marks over them. */
static void draw_layers(const mt_picture *picture, mt_tile *tile, size_t tile_number)
{
    const mt_bins *triangles = &picture->triangle_bins, *strokes = &picture->stroke_bins, *marks = &picture->mark_bins;
    listed own = listed_in(triangles, tile_number);
    if (picture->rays) {
        mt_trace_triangles(picture->frame, picture->rays, tile);
    } else {
        mt_draw_triangles(picture->frame, tile, triangles->large, triangles->large_count);
        mt_draw_front_first(picture->frame, tile, own.numbers, own.count);
    }
    if (is_touched(strokes, tile_number) || is_touched(marks, tile_number)) {
        settle_depths(picture, tile);
        mt_index first = picture->frame->model->triangulation.triangle_count;
        own = listed_in(strokes, tile_number);
        mt_draw_strokes(&picture->strokes, tile, strokes->large, strokes->large_count, first);
        mt_draw_strokes(&picture->strokes, tile, own.numbers, own.count, first);
    }
    if (tile->marks) {
        own = listed_in(marks, tile_number);
        mt_draw_marks(&picture->marks, tile, own.numbers, own.count);
        mt_draw_marks(&picture->marks, tile, marks->large, marks->large_count);
    }
}

static bool is_blank(const mt_picture *picture, size_t tile_number)
{
    return !picture->rays && !picture->look->ground.is_drawn && !is_touched(&picture->triangle_bins, tile_number) &&
           !is_touched(&picture->stroke_bins, tile_number) && !is_touched(&picture->mark_bins, tile_number);
}

/* What a thread draws in; nothing in it outlives a tile but facets, which depend on the triangle alone. */
typedef struct canvas {
    mt_tile tile, fine;
    mt_facet_cache *cache;
    bool taken; /* atomic */
} canvas;

typedef struct draw_task {
    const mt_picture *picture;
    const mt_picture *fine; /* the same with more samples; NULL: none */
    size_t first_tile;
    uint64_t *covered, *refined; /* per tile of the picture */
    canvas *canvases;            /* one for each thread */
    unsigned canvas_count;
} draw_task;

static bool canvas_init(mt_context *context, const draw_task *task, canvas *out)
{
    bool marked = task->picture->marks.count > 0, fine = task->fine != NULL;
    out->cache = (mt_facet_cache *)mt_try_allocate(context, sizeof *out->cache);
    if (out->cache) {
        mt_facet_cache_clear(out->cache);
    }
    return out->cache && mt_tile_init(context, task->picture->frame, marked, &out->tile) &&
           (!fine ||
            (mt_tile_init(context, task->fine->frame, marked, &out->fine) && mt_tile_mask(context, &out->fine)));
}

static mt_status make_canvases(mt_context *context, draw_task *task)
{
    task->canvas_count = mt_context_thread_count(context);
    task->canvases = (canvas *)mt_allocate_array_zeroed(context, task->canvas_count, sizeof *task->canvases);
    bool ready = task->canvases != NULL;
    for (unsigned i = 0; ready && i < task->canvas_count; i++) {
        ready = canvas_init(context, task, &task->canvases[i]);
    }
    return ready ? MT_OK : mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory left for a tile of the picture");
}

static void release_canvases(mt_context *context, draw_task *task)
{
    for (unsigned i = 0; task->canvases && i < task->canvas_count; i++) {
        mt_tile_release(context, &task->canvases[i].tile);
        mt_tile_release(context, &task->canvases[i].fine);
        mt_free(context, task->canvases[i].cache);
    }
    mt_free(context, task->canvases);
}

/* There are as many as threads, so one is free. */
static canvas *take_canvas(const draw_task *task)
{
    for (unsigned i = 0;; i = i + 1 < task->canvas_count ? i + 1 : 0) {
        if (!__atomic_exchange_n(&task->canvases[i].taken, true, __ATOMIC_ACQUIRE)) {
            return &task->canvases[i];
        }
    }
}

static void draw_tile(const draw_task *task, canvas *own, size_t tile_number)
{
    const mt_picture *picture = task->picture;
    mt_tile_place(&own->tile, &picture->frame->camera, tile_number);
    if (is_blank(picture, tile_number)) {
        mt_resolve_blank(picture, &own->tile);
        return;
    }
    mt_tile_clear(&own->tile);
    draw_layers(picture, &own->tile, tile_number);
    task->covered[tile_number] = mt_resolve_tile(picture, &own->tile, own->cache);
    if (task->fine) {
        mt_tile_place(&own->fine, &picture->frame->camera, tile_number);
        task->refined[tile_number] = mt_find_changes(picture, &own->tile, own->fine.wanted);
        if (task->refined[tile_number] > 0) {
            mt_tile_clear(&own->fine);
            draw_layers(task->fine, &own->fine, tile_number);
            mt_resolve_tile(task->fine, &own->fine, own->cache);
        }
    }
}

static void draw_tiles(void *user, uint64_t begin, uint64_t end)
{
    const draw_task *task = (const draw_task *)user;
    canvas *own = take_canvas(task);
    for (uint64_t i = begin; i < end; i++) {
        draw_tile(task, own, task->first_tile + (size_t)i);
    }
    __atomic_store_n(&own->taken, false, __ATOMIC_RELEASE);
}

static mt_status draw_all(mt_context *context, draw_task *task, size_t tile_count)
{
    mt_status status = MT_OK;
    for (size_t first = 0; status == MT_OK && first < tile_count; first += TILES_PER_REPORT) {
        size_t count = tile_count - first < TILES_PER_REPORT ? tile_count - first : TILES_PER_REPORT;
        task->first_tile = first;
        mt_parallel_for(context, count, TILES_PER_BLOCK, draw_tiles, task);
        status = mt_progress(context, "drawing", (double)(first + count) / (double)tile_count);
    }
    return status;
}

static mt_status draw_task_run(mt_context *context, draw_task *task, mt_picture *picture, size_t tile_count)
{
    task->covered = (uint64_t *)mt_allocate_array_zeroed(context, tile_count, sizeof *task->covered);
    task->refined = (uint64_t *)mt_allocate_array_zeroed(context, tile_count, sizeof *task->refined);
    mt_status status =
        task->covered && task->refined ? make_canvases(context, task) : mt_context_error(context)->status;
    if (status == MT_OK) {
        status = draw_all(context, task, tile_count);
    }
    picture->covered_samples = picture->fine_pixels = 0;
    for (size_t tile = 0; status == MT_OK && tile < tile_count; tile++) {
        picture->covered_samples += task->covered[tile];
        picture->fine_pixels += task->refined[tile];
    }
    release_canvases(context, task);
    mt_free(context, task->covered);
    mt_free(context, task->refined);
    return status;
}

static mt_status draw(mt_context *context, mt_picture *picture, const mt_frame *fine_frame)
{
    draw_task task = {.picture = picture};
    mt_picture fine = *picture;
    fine.frame = fine.strokes.frame = fine.marks.frame = fine_frame;
    task.fine = picture->fine_samples > 0 ? &fine : NULL;
    int part = picture->rays ? mt_part_begin(context, "rays and shading", "a ray for each sample, asked for")
                             : mt_part_begin(context, "depth buffer and shading",
                                             "tile by tile, once for each triangle in a pixel");
    size_t tile_count = (size_t)picture->triangle_bins.tiles_x * picture->triangle_bins.tiles_y;
    mt_status status = draw_task_run(context, &task, picture, tile_count);
    mt_part_end(context, part);
    return status;
}

mt_status mt_picture_draw(mt_context *context, mt_picture *picture)
{
    mt_frame fine = *picture->frame;
    if (picture->fine_samples > 0) {
        fine.sampling = mt_sampling_make(picture->fine_samples);
    }
    mt_status status = sort(context, picture, &fine);
    if (status == MT_OK) {
        status = draw(context, picture, &fine);
    }
    mt_bins_release(context, &picture->triangle_bins);
    mt_bins_release(context, &picture->stroke_bins);
    mt_bins_release(context, &picture->mark_bins);
    return status;
}
