#include "lib/render/frame.h"

#include "lib/render/vectors.h"

#include <math.h>
#include <string.h>

#define VERTEX_BLOCK 32768

/* An n x n pattern sheared so that no two samples share a column or a row: edges close to an axis, which the eye
 * is keenest on, get n * n levels instead of n. */
static void place_samples(mt_frame *frame, unsigned sample_count)
{
    unsigned n = 1;
    while (n * n < sample_count) {
        n++;
    }
    double width = (double)MT_STEPS / (n * n);
    frame->sample_count = n * n;
    frame->lane_count = (n * n + MT_GROUP_SIZE - 1) / MT_GROUP_SIZE * MT_GROUP_SIZE;
    for (unsigned lane = 0; lane < frame->lane_count; lane++) {
        unsigned sample = lane < frame->sample_count ? lane : 0, column = sample % n, row = sample / n;
        frame->sample_x[lane] = (float)floor((n * column + row + 0.5) * width);
        frame->sample_y[lane] = (float)floor((n * row + column + 0.5) * width);
    }
    frame->sample_first = (int32_t)floor(0.5 * width);
    frame->sample_last = (int32_t)floor((n * n - 0.5) * width);
}

static void project(void *user, uint64_t begin, uint64_t end)
{
    const mt_frame *frame = (const mt_frame *)user;
    double limit = 2.0 * (frame->camera.width > frame->camera.height ? frame->camera.width : frame->camera.height);
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_screen_vertex *out = frame->vertices + vertex;
        *out = (mt_screen_vertex){0, 0, 0};
        if (!(frame->model->flags[vertex] & MT_VERTEX_DRAWN)) {
            continue;
        }
        mt_screen_point s = mt_camera_project(&frame->camera, mt_model_position(frame->model, (mt_index)vertex));
        /* A framed picture has no vertex behind the eye or far outside. */
        if (s.depth > 0 && fabs(s.x) < limit && fabs(s.y) < limit) {
            *out = (mt_screen_vertex){s.x * MT_STEPS, s.y * MT_STEPS, s.depth};
        }
    }
}

mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_frame *frame)
{
    memset(frame, 0, sizeof *frame);
    frame->model = model;
    frame->camera = *camera;
    place_samples(frame, sample_count);
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
