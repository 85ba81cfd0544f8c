/* The frame of a camera, and framing: with the direction fixed, "a point is inside the picture" is linear in the
 * eye, so the nearest eye follows from five maxima over the vertices, exactly and in one pass. */
#include "lib/render/camera.h"

#include <string.h>

#define VERTEX_BLOCK 65536

/* Part of the picture, from its middle to a side, that the mesh may fill. */
#define FILL 0.90

/* The nearest that the eye comes to the mesh, whose extent is about 1: a needle seen along its axis would
 * otherwise touch it. */
#define CLEARANCE 0.5

void mt_camera_frame(mt_camera *camera, mt_vec3 toward_eye, mt_vec3 up)
{
    camera->forward = mt_vec3_scale(mt_vec3_normalize(toward_eye), -1.0);
    mt_vec3 right = mt_vec3_cross(camera->forward, mt_vec3_normalize(up));
    if (!(mt_vec3_dot(right, right) > 1e-20)) {
        mt_vec3 f = camera->forward;
        bool x_is_least = fabs(f.x) <= fabs(f.y) && fabs(f.x) <= fabs(f.z);
        bool y_is_least = fabs(f.y) <= fabs(f.z);
        mt_vec3 axis = x_is_least ? mt_vec3_make(1, 0, 0) : y_is_least ? mt_vec3_make(0, 1, 0) : mt_vec3_make(0, 0, 1);
        right = mt_vec3_cross(f, axis);
    }
    camera->right = mt_vec3_normalize(right);
    camera->up = mt_vec3_cross(camera->right, camera->forward);
}

enum { TO_RIGHT, TO_LEFT, TO_TOP, TO_BOTTOM, TO_FRONT, REACH_COUNT };

/* Per block of vertices, how far they reach; a largest value does not depend on the order. */
typedef struct reach_task {
    const mt_camera *camera;
    const mt_model *model;
    double (*reaches)[REACH_COUNT];
} reach_task;

static void find_reach(void *user, uint64_t begin, uint64_t end)
{
    const reach_task *task = (const reach_task *)user;
    const mt_camera *camera = task->camera;
    double reach[REACH_COUNT] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        if (!(task->model->flags[vertex] & MT_VERTEX_DRAWN)) {
            continue;
        }
        mt_vec3 p = mt_model_position(task->model, (mt_index)vertex);
        double x = mt_vec3_dot(p, camera->right), y = mt_vec3_dot(p, camera->up);
        double z = -mt_vec3_dot(p, camera->forward);
        double slope_x = FILL * camera->tangent_x * z, slope_y = FILL * camera->tangent_y * z;
        const double values[REACH_COUNT] = {slope_x + x, slope_x - x, slope_y + y, slope_y - y, z};
        for (int i = 0; i < REACH_COUNT; i++) {
            reach[i] = values[i] > reach[i] ? values[i] : reach[i];
        }
    }
    memcpy(task->reaches[begin / VERTEX_BLOCK], reach, sizeof reach);
}

/* A point with the values r, l of reach is inside when eye_z * t + eye_x >= r and eye_z * t - eye_x >= l. */
static void place_eye(mt_camera *camera, const double reach[REACH_COUNT])
{
    double x = 0.5 * (reach[TO_RIGHT] - reach[TO_LEFT]), y = 0.5 * (reach[TO_TOP] - reach[TO_BOTTOM]);
    double z = fmax(0.5 * (reach[TO_RIGHT] + reach[TO_LEFT]) / (FILL * camera->tangent_x),
                    0.5 * (reach[TO_TOP] + reach[TO_BOTTOM]) / (FILL * camera->tangent_y));
    z = fmax(z, reach[TO_FRONT] + CLEARANCE);
    camera->eye = mt_vec3_add(mt_vec3_add(mt_vec3_scale(camera->right, x), mt_vec3_scale(camera->up, y)),
                              mt_vec3_scale(camera->forward, -z));
}

mt_status mt_camera_fit(mt_context *context, mt_camera *camera, const mt_model *model)
{
    size_t block_count = ((size_t)model->mesh->vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK;
    reach_task task = {camera, model, NULL};
    task.reaches = (double(*)[REACH_COUNT])mt_allocate_array(context, block_count, sizeof *task.reaches);
    if (!task.reaches) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, model->mesh->vertex_count, VERTEX_BLOCK, find_reach, &task);
    for (size_t block = 1; block < block_count; block++) {
        for (int i = 0; i < REACH_COUNT; i++) {
            task.reaches[0][i] = fmax(task.reaches[0][i], task.reaches[block][i]);
        }
    }
    place_eye(camera, task.reaches[0]);
    mt_free(context, task.reaches);
    return MT_OK;
}
