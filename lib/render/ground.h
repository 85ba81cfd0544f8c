/* A floor under the mesh, which fades out around it. */
#ifndef MESHTOOL_RENDER_GROUND_H
#define MESHTOOL_RENDER_GROUND_H

#include "lib/render/look.h"

/* At the lowest of the drawn vertices. */
mt_status mt_ground_init(mt_context *context, const mt_model *model, mt_vec3 up, mt_ground *ground);

/* The floor's light at the places of a pixel's samples (a bit each), seen at their middle (x, y), in steps; returns how
 * much of what is behind it hides, 0 to 1. */
double mt_ground_shade(const mt_look *look, const mt_sampling *sampling, uint64_t samples, uint32_t pixel_x,
                       uint32_t pixel_y, double x, double y, mt_vec3 *light);

#endif
