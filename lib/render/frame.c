/* Vertices are rounded to a grid so fine that it shows in no sample and so coarse that the products of edge
 * functions are exact in doubles: whether a sample is inside is then decided without rounding, neighbours that
 * share an edge leave no gap, and every compiler agrees. */
#include "lib/render/frame.h"

#include <math.h>
#include <string.h>

#define VERTEX_BLOCK 65536

/* With coordinates below 2^m pixels and 2^b steps a pixel an edge function stays below 2^(2(m+b)+3); it must not
 * reach 2^53. */
static unsigned grid_bits(uint32_t width, uint32_t height)
{
    uint32_t size = width > height ? width : height;
    unsigned m = 1;
    while (((uint64_t)1 << (m - 1)) < size) {
        m++;
    }
    unsigned bits = 25 - m;
    return bits < 16 ? bits : 16;
}

/* An n x n pattern sheared so that no two samples share a column or a row: edges close to an axis, which the eye
 * is keenest on, get n * n levels instead of n. */
static void place_samples(mt_frame *frame, unsigned sample_count)
{
    unsigned n = 1;
    while (n * n < sample_count) {
        n++;
    }
    frame->sample_count = n * n;
    frame->lane_count = (n * n + 3) / 4 * 4;
    for (unsigned lane = 0; lane < frame->lane_count; lane++) {
        unsigned column = lane % n, row = lane / n;
        bool used = lane < frame->sample_count;
        frame->sample_x[lane] = used ? floor((n * column + row + 0.5) / (n * n) * frame->unit) : NAN;
        frame->sample_y[lane] = used ? floor((n * row + column + 0.5) / (n * n) * frame->unit) : NAN;
    }
    frame->sample_first = floor(0.5 / (n * n) * frame->unit);
    frame->sample_last = floor((n * n - 0.5) / (n * n) * frame->unit);
}

static void project(void *user, uint64_t begin, uint64_t end)
{
    const mt_frame *frame = (const mt_frame *)user;
    double limit = 2.0 * (frame->camera.width > frame->camera.height ? frame->camera.width : frame->camera.height);
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_screen_vertex *out = frame->vertices + vertex;
        *out = (mt_screen_vertex){0, 0, 0.0};
        if (!(frame->model->flags[vertex] & MT_VERTEX_DRAWN)) {
            continue;
        }
        mt_screen_point s = mt_camera_project(&frame->camera, mt_model_position(frame->model, (mt_index)vertex));
        /* A framed picture has no vertex behind the eye or far outside. */
        if (s.depth > 0 && fabs(s.x) < limit && fabs(s.y) < limit) {
            out->x = (int32_t)floor(s.x * frame->unit + 0.5);
            out->y = (int32_t)floor(s.y * frame->unit + 0.5);
            out->depth = s.depth;
        }
    }
}

mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_frame *frame)
{
    memset(frame, 0, sizeof *frame);
    frame->model = model;
    frame->camera = *camera;
    frame->unit_bits = grid_bits(camera->width, camera->height);
    frame->unit = ldexp(1.0, (int)frame->unit_bits);
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
