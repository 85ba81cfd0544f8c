#include "lib/render/ground.h"

#include "lib/render/shadow.h"

#define VERTEX_BLOCK 65536

/* Where the floor begins to fade and where it ends, in radii of the mesh's bounds. */
#define FADE_BEGIN 1.1
#define FADE_END 3.2

typedef struct level_task {
    const mt_model *model;
    mt_vec3 up;
    double *lowest; /* per block; a least value does not depend on the order */
} level_task;

static void find_lowest(void *user, uint64_t begin, uint64_t end)
{
    const level_task *task = (const level_task *)user;
    double lowest = INFINITY;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        if (task->model->flags[vertex] & MT_VERTEX_DRAWN) {
            double height = mt_vec3_dot(mt_model_position(task->model, (mt_index)vertex), task->up);
            lowest = height < lowest ? height : lowest;
        }
    }
    task->lowest[begin / VERTEX_BLOCK] = lowest;
}

mt_status mt_ground_init(mt_context *context, const mt_model *model, mt_vec3 up, mt_ground *ground)
{
    size_t block_count = ((size_t)model->mesh->vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK;
    level_task task = {model, up, (double *)mt_allocate_array(context, block_count, sizeof(double))};
    if (!task.lowest) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, model->mesh->vertex_count, VERTEX_BLOCK, find_lowest, &task);
    *ground = (mt_ground){.is_drawn = true, .up = up, .level = task.lowest[0]};
    for (size_t block = 1; block < block_count; block++) {
        ground->level = fmin(ground->level, task.lowest[block]);
    }
    ground->radius = 0.5 * mt_vec3_length(mt_vec3_subtract(model->high, model->low));
    mt_free(context, task.lowest);
    return MT_OK;
}

/* The point of the floor that is seen at a place of the picture. */
static bool find_point(const mt_look *look, double x, double y, mt_vec3 *point)
{
    mt_camera_ray ray = mt_camera_ray_at(&look->frame->camera, x / MT_STEPS, y / MT_STEPS);
    double down = -mt_vec3_dot(ray.direction, look->ground.up);
    double t = (mt_vec3_dot(ray.origin, look->ground.up) - look->ground.level) / down;
    *point = mt_vec3_add(ray.origin, mt_vec3_scale(ray.direction, t));
    return down > 0 && t > 0;
}

static double fade_of(const mt_ground *ground, mt_vec3 point)
{
    mt_vec3 flat = mt_vec3_subtract(point, mt_vec3_scale(ground->up, mt_vec3_dot(point, ground->up)));
    double reach = ground->radius > 0 ? mt_vec3_length(flat) / ground->radius : FADE_END;
    double s = (FADE_END - reach) / (FADE_END - FADE_BEGIN);
    s = s > 0 ? (s < 1 ? s : 1.0) : 0.0;
    return s * s * (3.0 - 2.0 * s);
}

static bool is_lit(const void *user, const mt_look *look, double x, double y)
{
    mt_vec3 point;
    (void)user;
    return !find_point(look, x, y, &point) || !mt_is_shadowed(look, point, look->ground.up, MT_NONE);
}

double mt_ground_shade(const mt_look *look, const mt_sampling *sampling, uint64_t samples, uint32_t pixel_x,
                       uint32_t pixel_y, double x, double y, mt_vec3 *light)
{
    mt_vec3 point;
    if (!find_point(look, x, y, &point)) {
        return 0;
    }
    double fade = fade_of(&look->ground, point), lit = 1.0;
    if (fade > 0 && look->shadows) {
        lit = mt_lit_share(look, sampling, samples, pixel_x, pixel_y, is_lit, NULL);
    }
    mt_lighting lighting = look->lighting;
    lighting.gloss = 0; /* paper, not a mirror */
    mt_vec3 eye = mt_camera_toward_eye(&look->frame->camera, x / MT_STEPS, y / MT_STEPS);
    *light = mt_shade(&lighting, look->ground.up, eye, look->ground.color, lit);
    return fade;
}
