/* With the direction fixed, "a point is inside the picture" is linear in the eye, so the nearest eye follows from a few
 * maxima over the vertices, exactly and in one pass. */
#include "lib/render/framing.h"

#include <meshtool/elementary.h>

#include <string.h>

#define VERTEX_BLOCK 65536

/* Part of the picture, from its middle to a side, that the mesh may fill. */
#define FILL 0.90

/* The nearest that the eye comes to the mesh, whose extent is about 1: a needle seen along its axis would
 * otherwise touch it. */
#define CLEARANCE 0.5

/* Half the angle of 75 degrees, as a tangent: the widest that an eye without an angle sees. Wider ones distort. */
#define WIDEST_TANGENT 0.76732698797896034

enum { TO_RIGHT, TO_LEFT, TO_TOP, TO_BOTTOM, TO_FRONT, STEEPEST_X, STEEPEST_Y, REACH_COUNT };

/* Per block of vertices, how far they reach; a largest value does not depend on the order. */
typedef struct reach_task {
    const mt_camera *camera;
    const mt_model *model;
    double slope_x, slope_y; /* how the picture widens with the distance */
    bool steepest;           /* asked for */
    double (*reaches)[REACH_COUNT];
} reach_task;

static void find_reach(void *user, uint64_t begin, uint64_t end)
{
    const reach_task *task = (const reach_task *)user;
    const mt_camera *camera = task->camera;
    double reach[REACH_COUNT];
    for (int i = 0; i < REACH_COUNT; i++) {
        reach[i] = -INFINITY;
    }
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        if (!(task->model->flags[vertex] & MT_VERTEX_DRAWN)) {
            continue;
        }
        mt_vec3 p = mt_vec3_subtract(mt_model_position(task->model, (mt_index)vertex), camera->eye);
        double x = mt_vec3_dot(p, camera->right), y = mt_vec3_dot(p, camera->up);
        double z = -mt_vec3_dot(p, camera->forward);
        x -= camera->shear_x * z;
        y -= camera->shear_y * z;
        double slope_x = task->slope_x * z, slope_y = task->slope_y * z;
        double steep_x = 0, steep_y = 0;
        if (task->steepest) {
            steep_x = z < 0 ? fabs(x / z) : INFINITY;
            steep_y = z < 0 ? fabs(y / z) : INFINITY;
        }
        const double values[REACH_COUNT] = {slope_x + x, slope_x - x, slope_y + y, slope_y - y, z, steep_x, steep_y};
        for (int i = 0; i < REACH_COUNT; i++) {
            reach[i] = values[i] > reach[i] ? values[i] : reach[i];
        }
    }
    memcpy(task->reaches[begin / VERTEX_BLOCK], reach, sizeof reach);
}

/* How far the vertices reach from the camera's present eye. */
static mt_status measure(mt_context *context, const mt_camera *camera, const mt_model *model, bool steepest,
                         double reach[REACH_COUNT])
{
    size_t block_count = ((size_t)model->mesh->vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK;
    reach_task task = {.camera = camera, .model = model, .steepest = steepest};
    if (!mt_camera_is_parallel(camera)) {
        task.slope_x = FILL * camera->half_width;
        task.slope_y = FILL * camera->half_height;
    }
    task.reaches = (double(*)[REACH_COUNT])mt_allocate_array(context, block_count, sizeof *task.reaches);
    if (!task.reaches) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, model->mesh->vertex_count, VERTEX_BLOCK, find_reach, &task);
    memcpy(reach, task.reaches[0], sizeof task.reaches[0]);
    for (size_t block = 1; block < block_count; block++) {
        for (int i = 0; i < REACH_COUNT; i++) {
            reach[i] = fmax(reach[i], task.reaches[block][i]);
        }
    }
    mt_free(context, task.reaches);
    return MT_OK;
}

static void set_extent(mt_camera *camera, double half_of_shorter)
{
    double shorter = camera->width < camera->height ? camera->width : camera->height;
    camera->half_width = half_of_shorter * camera->width / shorter;
    camera->half_height = half_of_shorter * camera->height / shorter;
}

/* Moves the eye in the camera's own axes. */
static void move_eye(mt_camera *camera, double right, double up, double forward)
{
    camera->eye = mt_vec3_add(camera->eye, mt_vec3_scale(camera->right, right));
    camera->eye = mt_vec3_add(camera->eye, mt_vec3_scale(camera->up, up));
    camera->eye = mt_vec3_add(camera->eye, mt_vec3_scale(camera->forward, forward));
}

/* A point with the values r, l of reach is inside when z t + x >= r and z t - x >= l, where the eye moves by x, y and
 * back by z. With a target the eye stays on its line. */
static void place_eye(mt_camera *camera, const double reach[REACH_COUNT], bool centered)
{
    double x = centered ? 0 : 0.5 * (reach[TO_RIGHT] - reach[TO_LEFT]);
    double y = centered ? 0 : 0.5 * (reach[TO_TOP] - reach[TO_BOTTOM]);
    double width = fmax(reach[TO_RIGHT] - x, reach[TO_LEFT] + x),
           height = fmax(reach[TO_TOP] - y, reach[TO_BOTTOM] + y);
    double z = fmax(width / (FILL * camera->half_width), height / (FILL * camera->half_height));
    double tangent = fmin(camera->half_width, camera->half_height);
    double clearance = CLEARANCE * fmin(1.0, MT_USUAL_TANGENT / tangent); /* wide angles come nearer */
    move_eye(camera, x, y, -fmax(z, reach[TO_FRONT] + clearance));
}

/* The extent that shows all from a given eye, unless that is too wide. */
static void widen(mt_camera *camera, const double reach[REACH_COUNT])
{
    double scale = fmax(reach[STEEPEST_X] / camera->half_width, reach[STEEPEST_Y] / camera->half_height) / FILL;
    double shorter = fmin(camera->half_width, camera->half_height) * scale;
    set_extent(camera, shorter > 0 && shorter < WIDEST_TANGENT ? shorter : shorter > 0 ? WIDEST_TANGENT : 1.0);
}

/* The picture plane goes in front of all: a parallel picture has no eye, and cuts nothing off. */
static void place_plane(mt_camera *camera, const double reach[REACH_COUNT], const mt_framing *framing, double extent)
{
    double x = framing->has_target ? 0 : 0.5 * (reach[TO_RIGHT] - reach[TO_LEFT]);
    double y = framing->has_target ? 0 : 0.5 * (reach[TO_TOP] - reach[TO_BOTTOM]);
    double width = fmax(reach[TO_RIGHT] - x, reach[TO_LEFT] + x),
           height = fmax(reach[TO_TOP] - y, reach[TO_BOTTOM] + y);
    if (!(extent > 0)) {
        set_extent(camera, 1.0);
        extent = fmax(width / camera->half_width, height / camera->half_height) / FILL;
        extent = extent > 0 ? extent : CLEARANCE;
    }
    set_extent(camera, extent);
    double back = reach[TO_FRONT] + CLEARANCE;
    move_eye(camera, x + camera->shear_x * back, y + camera->shear_y * back, -back);
}

static mt_status fit_parallel(mt_context *context, mt_camera *camera, const mt_model *model, const mt_framing *framing,
                              double tangent)
{
    double reach[REACH_COUNT], extent = 0;
    if (framing->has_eye && framing->fov_degrees > 0) {
        extent = tangent * mt_vec3_length(mt_vec3_subtract(framing->target, framing->eye));
    }
    camera->eye = framing->has_target ? framing->target : mt_vec3_make(0, 0, 0);
    mt_status status = measure(context, camera, model, false, reach);
    if (status == MT_OK) {
        place_plane(camera, reach, framing, extent);
    }
    return status;
}

mt_status mt_camera_fit(mt_context *context, mt_camera *camera, const mt_model *model, const mt_framing *framing)
{
    double half = framing->fov_degrees * (0.5 * MT_PI / 180.0);
    double tangent = framing->fov_degrees > 0 ? mt_tan(half) : MT_USUAL_TANGENT;
    if (mt_camera_is_parallel(camera)) {
        return fit_parallel(context, camera, model, framing, tangent);
    }
    set_extent(camera, tangent);
    camera->eye = framing->has_eye ? framing->eye : framing->has_target ? framing->target : mt_vec3_make(0, 0, 0);
    double reach[REACH_COUNT];
    if (framing->has_eye && framing->fov_degrees > 0) {
        return MT_OK;
    }
    mt_status status = measure(context, camera, model, framing->has_eye, reach);
    if (status == MT_OK && framing->has_eye) {
        widen(camera, reach);
    } else if (status == MT_OK) {
        place_eye(camera, reach, framing->has_target);
    }
    return status;
}
