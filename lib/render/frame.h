/* The mesh's vertices on the picture, and the places where a pixel is sampled. */
#ifndef MESHTOOL_RENDER_FRAME_H
#define MESHTOOL_RENDER_FRAME_H

#include "lib/render/camera.h"

#define MT_MAXIMUM_SAMPLES 64

/* Steps of the picture's grid in a pixel. Coverage is decided on the grid, where it is exact; 256 steps show in no
 * sample, and keep the edge functions of the widest picture within the whole numbers of a double. */
#define MT_STEP_BITS 8
#define MT_STEPS (1 << MT_STEP_BITS)

/* A vertex in steps from the top left corner, not rounded. depth: as in mt_screen_point; 0: it cannot be drawn. */
typedef struct mt_screen_vertex {
    double x, y, depth;
} mt_screen_vertex;

typedef struct mt_frame {
    const mt_model *model;
    mt_camera camera;
    mt_screen_vertex *vertices;
    unsigned sample_count;
    unsigned lane_count; /* sample_count rounded up to whole groups; the lanes beyond it repeat the first sample */
    /* Offsets from a pixel's top left corner, whole steps. */
    _Alignas(64) float sample_x[MT_MAXIMUM_SAMPLES];
    _Alignas(64) float sample_y[MT_MAXIMUM_SAMPLES];
    int32_t sample_first, sample_last; /* the least and the largest of both */
} mt_frame;

/* Projects the drawn vertices. sample_count is a square number up to MT_MAXIMUM_SAMPLES. */
mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_frame *frame);
void mt_frame_release(mt_context *context, mt_frame *frame);

#endif
