#include "lib/render/frame.h"

#include "lib/render/vectors.h"

#include <math.h>
#include <string.h>

#define VERTEX_BLOCK 32768

/* An n x n pattern sheared so that no two samples share a column or a row: edges close to an axis, which the eye
 * is keenest on, get n * n levels instead of n. One sample is in the middle. */
mt_sampling mt_sampling_make(unsigned sample_count)
{
    mt_sampling sampling;
    memset(&sampling, 0, sizeof sampling);
    unsigned n = 1;
    while (n * n < sample_count) {
        n++;
    }
    double width = (double)MT_STEPS / (n * n);
    sampling.sample_count = n * n;
    sampling.lane_count = (n * n + MT_GROUP_SIZE - 1) / MT_GROUP_SIZE * MT_GROUP_SIZE;
    for (unsigned lane = 0; lane < sampling.lane_count; lane++) {
        unsigned sample = lane < sampling.sample_count ? lane : 0, column = sample % n, row = sample / n;
        sampling.x[lane] = (float)floor((n * column + row + 0.5) * width);
        sampling.y[lane] = (float)floor((n * row + column + 0.5) * width);
    }
    sampling.first = (int32_t)floor(0.5 * width);
    sampling.last = (int32_t)floor((n * n - 0.5) * width);
    return sampling;
}

static void project(void *user, uint64_t begin, uint64_t end)
{
    const mt_frame *frame = (const mt_frame *)user;
    const mt_screen_vertex behind = {0, 0, -1};
    double nearest = mt_camera_depth(&frame->camera, MT_NEAREST_DISTANCE);
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_screen_vertex *out = frame->vertices + vertex;
        *out = (mt_screen_vertex){0, 0, 0};
        if (frame->model->flags[vertex] & MT_VERTEX_DRAWN) {
            mt_screen_point s = mt_camera_project(&frame->camera, mt_model_position(frame->model, (mt_index)vertex));
            bool placed = s.depth > 0 && s.depth <= nearest;
            *out = placed ? (mt_screen_vertex){s.x * MT_STEPS, s.y * MT_STEPS, s.depth} : behind;
        }
    }
}

mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_ray_profile profile, mt_frame *frame)
{
    memset(frame, 0, sizeof *frame);
    frame->model = model;
    frame->camera = *camera;
    frame->profile = profile;
    frame->sampling = mt_sampling_make(sample_count);
    frame->precision = mt_hit_precision_of(profile);
    frame->steps_per_unit =
        0.5 * MT_STEPS * fmax(camera->width / camera->half_width, camera->height / camera->half_height);
    mt_index vertex_count = model->mesh->vertex_count;
    frame->vertices = (mt_screen_vertex *)mt_allocate_array(context, vertex_count, sizeof *frame->vertices);
    if (!frame->vertices) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, vertex_count, VERTEX_BLOCK, project, frame);
    return MT_OK;
}

void mt_frame_release(mt_context *context, mt_frame *frame)
{
    mt_free(context, frame->vertices);
    frame->vertices = NULL;
}
