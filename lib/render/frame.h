/* The mesh's vertices on the picture's grid, and the places where a pixel is sampled. */
#ifndef MESHTOOL_RENDER_FRAME_H
#define MESHTOOL_RENDER_FRAME_H

#include "lib/render/camera.h"

#define MT_MAXIMUM_SAMPLES 64

/* A vertex on a grid of `unit` steps a pixel. depth: as in mt_screen_point; 0: it cannot be drawn. */
typedef struct mt_screen_vertex {
    int32_t x, y;
    double depth;
} mt_screen_vertex;

typedef struct mt_frame {
    const mt_model *model;
    mt_camera camera;
    mt_screen_vertex *vertices;
    unsigned unit_bits;
    double unit; /* steps of the grid in a pixel: 2^unit_bits */
    unsigned sample_count;
    unsigned lane_count; /* sample_count rounded up to vectors of 4 */
    /* Offsets from a pixel's top left corner, in steps; NaN in the lanes beyond sample_count: never covered. */
    _Alignas(64) double sample_x[MT_MAXIMUM_SAMPLES];
    _Alignas(64) double sample_y[MT_MAXIMUM_SAMPLES];
    double sample_first, sample_last; /* the least and the largest of both */
} mt_frame;

/* Projects the drawn vertices. sample_count is a square number up to MT_MAXIMUM_SAMPLES. */
mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_frame *frame);
void mt_frame_release(mt_context *context, mt_frame *frame);

#endif
