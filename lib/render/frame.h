/* The mesh's vertices on the picture, and the places where a pixel is sampled. */
#ifndef MESHTOOL_RENDER_FRAME_H
#define MESHTOOL_RENDER_FRAME_H

#include "lib/render/hit.h"

#define MT_MAXIMUM_SAMPLES 64

/* Samples lie on a grid of so many steps along a pixel: 256 show in no sample, and are exact in floats. */
#define MT_STEP_BITS 8
#define MT_STEPS (1 << MT_STEP_BITS)

/* Nearer to the eye's plane than this a vertex has no place in the picture that could be trusted; the extent of the
 * mesh is about 1. */
#define MT_NEAREST_DISTANCE 0x1p-40

/* A vertex in steps from the top left corner, not rounded. depth: as in mt_screen_point; 0: it is not drawn; negative:
 * it is beside or behind the eye, and has no place. */
typedef struct mt_screen_vertex {
    double x, y, depth;
} mt_screen_vertex;

/* Where samples lie in a pixel. */
typedef struct mt_sampling {
    unsigned sample_count;
    unsigned lane_count; /* sample_count rounded up to whole groups; the lanes beyond it repeat the first sample */
    /* Offsets from a pixel's top left corner, whole steps. */
    _Alignas(64) float x[MT_MAXIMUM_SAMPLES];
    _Alignas(64) float y[MT_MAXIMUM_SAMPLES];
    int32_t first, last; /* the least and the largest of both */
} mt_sampling;

typedef struct mt_frame {
    const mt_model *model;
    mt_camera camera;
    mt_screen_vertex *vertices;
    mt_sampling sampling;
    mt_ray_profile profile; /* of the hit test */
    mt_hit_precision precision;
    double steps_per_unit; /* of a unit at right angles to the view, in perspective at distance 1 */
} mt_frame;

/* sample_count is a square number up to MT_MAXIMUM_SAMPLES. */
mt_sampling mt_sampling_make(unsigned sample_count);

/* Projects the drawn vertices. */
mt_status mt_frame_init(mt_context *context, const mt_model *model, const mt_camera *camera, unsigned sample_count,
                        mt_ray_profile profile, mt_frame *frame);
void mt_frame_release(mt_context *context, mt_frame *frame);

/* The ray through a sample of a pixel. */
static inline mt_camera_ray mt_frame_ray(const mt_frame *frame, uint32_t x, uint32_t y, unsigned lane)
{
    return mt_camera_ray_at(&frame->camera, x + (double)frame->sampling.x[lane] * (1.0 / MT_STEPS),
                            y + (double)frame->sampling.y[lane] * (1.0 / MT_STEPS));
}

#endif
