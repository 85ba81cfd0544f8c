/* A ray from the eye and all that follow it. */
#ifndef MESHTOOL_RENDER_SCENE_PATH_H
#define MESHTOOL_RENDER_SCENE_PATH_H

#include "lib/render/scene_point.h"

/* Bytes of the stack on which rays wait, for a depth limit. */
uint64_t mt_scene_stack_size(unsigned depth_limit);

/* What a sample shows; alpha 0: nothing, on a transparent background. first: what the ray hits. */
typedef struct mt_scene_sample {
    mt_vec3 light;
    double alpha;
} mt_scene_sample;
mt_scene_sample mt_scene_sample_of(mt_scene_tracer *tracer, const mt_scene_ray *ray, const mt_scene_hit *first);

#endif
