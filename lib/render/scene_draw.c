/* Tile by tile, in parallel. A tile in which a ray comes near a mesh that is not built yet is given up; when the others
 * are drawn, the meshes that were asked for are built, by all threads, and the tiles drawn again. So a mesh that no ray
 * comes near costs nothing, and one that is seen a few rays more. */
#include "lib/render/scene_draw.h"

#include "lib/render/scene_path.h"
#include "lib/render/scene_world.h"

#include <math.h>

/* Samples of a pixel, or a pixel and those beside it, that differ by more than this are drawn with more samples: as a
 * part of the range of a screen, whose brightness is about the root of the light. */
#define CONTRAST (1.0 / 24)

/* Tiles between two reports of progress. */
#define TILES_PER_REPORT 64

enum { TILE_WAITING, TILE_DRAWN };

typedef struct draw_task {
    const mt_scene_plan *plan;
    mt_image *image;
    mt_sampling sampling;
    unsigned char *tiles;        /* per tile of the picture: TILE_WAITING or TILE_DRAWN */
    unsigned char *varied;       /* per pixel not 0: its samples differ; NULL: nobody asks */
    const unsigned char *fine;   /* per pixel not 0: to be drawn; NULL: all are */
    const mt_scene_world *world; /* what samples see first; NULL: rays ask the plan */
    mt_tile *canvases;           /* for the world, one for each thread; NULL: no world */
    unsigned char *stacks;       /* one for each thread; NULL: no stack */
    unsigned char *taken;        /* per thread: its stack and canvas are in use; atomic */
    unsigned thread_count;
    size_t first_tile;
    mt_scene_report rays; /* atomic */
} draw_task;

static void count_rays(draw_task *task, const mt_scene_tracer *tracer, uint64_t primary)
{
    __atomic_fetch_add(&task->rays.primary_rays, primary, __ATOMIC_RELAXED);
    __atomic_fetch_add(&task->rays.shadow_rays, tracer->shadow_rays, __ATOMIC_RELAXED);
    __atomic_fetch_add(&task->rays.reflected_rays, tracer->reflected_rays, __ATOMIC_RELAXED);
    __atomic_fetch_add(&task->rays.refracted_rays, tracer->refracted_rays, __ATOMIC_RELAXED);
}

static mt_scene_ray primary_ray(const draw_task *task, uint32_t x, uint32_t y, unsigned sample)
{
    mt_camera_ray from = mt_camera_ray_at(&task->plan->camera, x + (double)task->sampling.x[sample] * (1.0 / MT_STEPS),
                                          y + (double)task->sampling.y[sample] * (1.0 / MT_STEPS));
    mt_scene_ray ray = {from.origin, from.direction, DBL_MIN, INFINITY, MT_NONE, MT_NONE};
    return ray;
}

static bool contrasts(mt_vec3 a, mt_vec3 b)
{
    double x = sqrt(fmax(a.x, 0)) - sqrt(fmax(b.x, 0)), y = sqrt(fmax(a.y, 0)) - sqrt(fmax(b.y, 0));
    double z = sqrt(fmax(a.z, 0)) - sqrt(fmax(b.z, 0));
    return fmax(fabs(x), fmax(fabs(y), fabs(z))) > CONTRAST;
}

static void store(const draw_task *task, uint32_t x, uint32_t y, mt_vec3 light, double alpha)
{
    float *pixel = mt_image_pixel(task->image, x, y);
    double scale = alpha > 0 ? 1.0 / alpha : 0.0;
    pixel[0] = (float)(light.x * scale);
    pixel[1] = (float)(light.y * scale);
    pixel[2] = (float)(light.z * scale);
    if (task->image->channel_count == 4) {
        pixel[3] = (float)(alpha / task->sampling.sample_count);
    }
}

/* What a thread draws with. */
typedef struct brush {
    mt_scene_tracer tracer;
    mt_tile tile; /* its numbers are those of the world's triangles, when there is a world */
} brush;

static mt_scene_hit first_hit(const draw_task *task, brush *own, const mt_scene_ray *ray, uint32_t x, uint32_t y,
                              unsigned sample)
{
    if (!task->world) {
        return mt_scene_nearest(&own->tracer, ray);
    }
    mt_scene_hit hit = mt_scene_nearest_formula(task->plan, ray);
    mt_index number = own->tile.numbers[mt_tile_lane(&own->tile, x, y) + sample];
    mt_scene_hit found = mt_scene_world_hit(task->world, &task->sampling, number, x, y, sample);
    return mt_scene_is_nearer(&found, &hit) ? found : hit;
}

/* Samples are summed in their order. False: a mesh is missing. */
static bool draw_pixel(draw_task *task, brush *own, uint32_t x, uint32_t y)
{
    mt_vec3 sum = mt_vec3_make(0, 0, 0), first = sum;
    double alpha = 0;
    bool varies = false;
    for (unsigned i = 0; i < task->sampling.sample_count; i++) {
        mt_scene_ray ray = primary_ray(task, x, y, i);
        mt_scene_hit hit = first_hit(task, own, &ray, x, y, i);
        mt_scene_sample sample = {{0, 0, 0}, 0};
        if (!own->tracer.is_blocked) {
            sample = mt_scene_sample_of(&own->tracer, &ray, &hit);
        }
        if (own->tracer.is_blocked) {
            return false;
        }
        first = i == 0 ? sample.light : first;
        varies = varies || contrasts(first, sample.light) || alpha != i * sample.alpha;
        sum = mt_vec3_add(sum, sample.light);
        alpha += sample.alpha;
    }
    store(task, x, y, sum, alpha);
    if (task->varied) {
        task->varied[(size_t)y * task->image->width + x] = varies;
    }
    return true;
}

static bool is_asked(const draw_task *task, uint32_t x, uint32_t y)
{
    return !task->fine || task->fine[(size_t)y * task->image->width + x];
}

static bool is_tile_asked(const draw_task *task, const mt_tile *tile)
{
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            if (is_asked(task, x, y)) {
                return true;
            }
        }
    }
    return false;
}

static void draw_tile(draw_task *task, brush *own, size_t tile_number)
{
    uint64_t pixels = 0;
    mt_tile *tile = &own->tile;
    mt_tile_place(tile, &task->plan->camera, tile_number);
    if (task->world && is_tile_asked(task, tile)) {
        mt_scene_world_draw(task->world, &task->sampling, tile);
    }
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            if (!is_asked(task, x, y)) {
                continue;
            }
            if (!draw_pixel(task, own, x, y)) {
                return;
            }
            pixels++;
        }
    }
    task->tiles[tile_number] = TILE_DRAWN;
    count_rays(task, &own->tracer, pixels * task->sampling.sample_count);
}

/* There is one for each thread, so one is free. */
static unsigned take(draw_task *task)
{
    for (unsigned i = 0;; i = i + 1 < task->thread_count ? i + 1 : 0) {
        if (!__atomic_exchange_n(&task->taken[i], 1, __ATOMIC_ACQUIRE)) {
            return i;
        }
    }
}

static void draw_tiles(void *user, uint64_t begin, uint64_t end)
{
    draw_task *task = (draw_task *)user;
    unsigned number = take(task);
    for (uint64_t i = begin; i < end; i++) {
        size_t tile_number = task->first_tile + (size_t)i;
        brush own = {.tracer = {.plan = task->plan}};
        if (task->stacks) {
            own.tracer.stack = (void *)(task->stacks + number * mt_scene_stack_size(task->plan->depth_limit));
        }
        if (task->canvases) {
            own.tile = task->canvases[number];
        }
        if (task->tiles[tile_number] == TILE_WAITING) {
            draw_tile(task, &own, tile_number);
        }
    }
    __atomic_store_n(&task->taken[number], 0, __ATOMIC_RELEASE);
}

static size_t tile_count_of(const mt_camera *camera)
{
    return ((size_t)(camera->width - 1) / MT_TILE_SIZE + 1) * ((size_t)(camera->height - 1) / MT_TILE_SIZE + 1);
}

static mt_status draw_waiting(mt_context *context, draw_task *task, size_t tile_count)
{
    mt_status status = MT_OK;
    for (size_t first = 0; status == MT_OK && first < tile_count; first += TILES_PER_REPORT) {
        size_t count = tile_count - first < TILES_PER_REPORT ? tile_count - first : TILES_PER_REPORT;
        task->first_tile = first;
        mt_parallel_for(context, count, 1, draw_tiles, task);
        status = mt_progress(context, "drawing", (double)(first + count) / (double)tile_count);
    }
    return status;
}

typedef struct pass_name {
    const char *name, *why;
} pass_name;

static pass_name name_pass(const draw_task *task, bool is_first)
{
    static const pass_name names[2][2] = {
        {{"tiles drawn again", "those that asked for a mesh"},
         {"rays and shading", "tile by tile, each until it asks for a mesh that is not built"}},
        {{"more samples again", "tiles that asked for a mesh"}, {"more samples", "where the picture changes"}}};
    return names[task->fine != NULL][is_first];
}

/* Draws all tiles, and builds what they ask for, until none waits. */
static mt_status draw_all(mt_context *context, mt_scene_plan *plan, draw_task *task, size_t tile_count)
{
    bool any = true, is_first = true;
    mt_status status = MT_OK;
    while (status == MT_OK && any) {
        pass_name pass = name_pass(task, is_first);
        int part = mt_part_begin(context, pass.name, pass.why);
        is_first = false;
        status = draw_waiting(context, task, tile_count);
        mt_part_end(context, part);
        if (status == MT_OK) {
            status = mt_scene_plan_build_wanted(context, plan, &any);
        }
    }
    return status;
}

static mt_vec3 light_of(const mt_image *image, uint32_t x, uint32_t y)
{
    const float *pixel = mt_image_pixel(image, x, y);
    double alpha = image->channel_count == 4 ? (double)pixel[3] : 1.0;
    return mt_vec3_make((double)pixel[0] * alpha, (double)pixel[1] * alpha, (double)pixel[2] * alpha);
}

typedef struct change_task {
    const mt_image *image;
    const unsigned char *varied;
    unsigned char *fine;
} change_task;

/* A pixel is drawn again when its samples differ, or when it differs from one beside it. */
static void find_changes(void *user, uint64_t begin, uint64_t end)
{
    const change_task *task = (const change_task *)user;
    const mt_image *image = task->image;
    for (uint64_t row = begin; row < end; row++) {
        uint32_t y = (uint32_t)row;
        for (uint32_t x = 0; x < image->width; x++) {
            size_t at = (size_t)y * image->width + x;
            mt_vec3 here = light_of(image, x, y);
            bool changes = task->varied[at] || (x > 0 && contrasts(here, light_of(image, x - 1, y))) ||
                           (x + 1 < image->width && contrasts(here, light_of(image, x + 1, y))) ||
                           (y > 0 && contrasts(here, light_of(image, x, y - 1))) ||
                           (y + 1 < image->height && contrasts(here, light_of(image, x, y + 1)));
            task->fine[at] = changes;
        }
    }
}

static void release_canvases(mt_context *context, draw_task *task)
{
    for (unsigned i = 0; task->canvases && i < task->thread_count; i++) {
        mt_tile_release(context, &task->canvases[i]);
    }
    mt_free(context, task->canvases);
    task->canvases = NULL;
}

static mt_status make_canvases(mt_context *context, draw_task *task)
{
    release_canvases(context, task);
    task->canvases = (mt_tile *)mt_allocate_array_zeroed(context, task->thread_count, sizeof *task->canvases);
    bool ready = task->canvases != NULL;
    const mt_frame frame = {.sampling = task->sampling};
    for (unsigned i = 0; ready && i < task->thread_count; i++) {
        ready = mt_tile_init(context, &frame, false, &task->canvases[i]);
    }
    return ready ? MT_OK : mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory left for a tile of the picture");
}

static mt_status refine(mt_context *context, mt_scene_plan *plan, draw_task *task, size_t tile_count)
{
    size_t pixels = (size_t)task->image->width * task->image->height;
    unsigned char *fine = (unsigned char *)mt_allocate_array(context, pixels, 1);
    if (!fine) {
        return mt_context_error(context)->status;
    }
    change_task changes = {task->image, task->varied, fine};
    mt_parallel_for(context, task->image->height, 16, find_changes, &changes);
    for (size_t i = 0; i < tile_count; i++) {
        task->tiles[i] = TILE_WAITING;
    }
    task->sampling = mt_sampling_make(plan->fine_samples);
    task->fine = fine;
    unsigned char *varied = task->varied;
    task->varied = NULL;
    mt_status status = task->world ? make_canvases(context, task) : MT_OK;
    if (status == MT_OK) {
        status = draw_all(context, plan, task, tile_count);
    }
    task->varied = varied;
    mt_free(context, fine);
    return status;
}

static mt_status make_stacks(mt_context *context, const mt_scene_plan *plan, draw_task *task)
{
    int part = mt_part_begin(context, "stack of rays", "mirrors or glass: so many rays wait in each thread at most");
    task->stacks =
        (unsigned char *)mt_allocate_array(context, task->thread_count, mt_scene_stack_size(plan->depth_limit));
    mt_part_end(context, part);
    return task->stacks ? MT_OK : mt_context_error(context)->status;
}

static mt_status make_room(mt_context *context, const mt_scene_plan *plan, draw_task *task, size_t tile_count)
{
    task->tiles = (unsigned char *)mt_allocate_zeroed(context, tile_count);
    task->taken = (unsigned char *)mt_allocate_zeroed(context, task->thread_count);
    bool ready = task->tiles && task->taken;
    if (ready && plan->fine_samples > 0) {
        task->varied = (unsigned char *)mt_allocate_array(context, task->image->width, task->image->height);
        ready = task->varied != NULL;
    }
    mt_status status = ready ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK && plan->has_followers) {
        status = make_stacks(context, plan, task);
    }
    return status == MT_OK && task->world ? make_canvases(context, task) : status;
}

mt_status mt_scene_draw(mt_context *context, mt_scene_plan *plan, const mt_scene_world *world, mt_image *image,
                        mt_scene_report *report)
{
    draw_task task = {.plan = plan,
                      .image = image,
                      .world = world,
                      .sampling = mt_sampling_make(plan->samples),
                      .thread_count = mt_context_thread_count(context)};
    size_t tile_count = tile_count_of(&plan->camera);
    mt_status status = make_room(context, plan, &task, tile_count);
    if (status == MT_OK) {
        status = draw_all(context, plan, &task, tile_count);
    }
    if (status == MT_OK && plan->fine_samples > 0) {
        status = refine(context, plan, &task, tile_count);
    }
    release_canvases(context, &task);
    mt_free(context, task.tiles);
    mt_free(context, task.varied);
    mt_free(context, task.stacks);
    mt_free(context, task.taken);
    *report = task.rays;
    return status;
}
