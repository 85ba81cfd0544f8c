/* How much of the main light arrives at the samples of a pixel. */
#ifndef MESHTOOL_RENDER_SHADOW_H
#define MESHTOOL_RENDER_SHADOW_H

#include "lib/render/look.h"

/* Whether light arrives at a place of the picture, in steps. */
typedef bool (*mt_lit_function)(const void *user, const mt_look *look, double x, double y);

/* The share of the samples (a bit each) to which light arrives. Four that agree speak for all: shadows have long edges.
 */
double mt_lit_share(const mt_look *look, const mt_sampling *sampling, uint64_t samples, uint32_t x, uint32_t y,
                    mt_lit_function is_lit, const void *user);

/* Whether the main light does not arrive at a point of the model. side: a normal of the surface there, either way;
 * skip: the triangle that it lies on. */
bool mt_is_shadowed(const mt_look *look, mt_vec3 point, mt_vec3 side, mt_index skip);

#endif
