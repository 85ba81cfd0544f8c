/* Image-order visibility, a ray for every sample, and the structure that rays search. */
#ifndef MESHTOOL_RENDER_TRACE_H
#define MESHTOOL_RENDER_TRACE_H

#include "lib/render/tile.h"

#include <meshtool/ray_structure.h>

/* What rays can hit: the model's triangles, in its own coordinates. */
typedef struct mt_occluder {
    const mt_model *model;
    mt_ray_profile profile;
    mt_mesh mesh; /* the model's positions with the mesh's faces; the rest is not looked at */
    mt_ray_structure *structure;
} mt_occluder;

/* Builds the structure. */
mt_status mt_occluder_init(mt_context *context, const mt_model *model, mt_ray_profile profile,
                           mt_ray_structure_kind kind, mt_occluder *occluder);
void mt_occluder_release(mt_context *context, mt_occluder *occluder);

/* Whether anything lies on the ray. */
bool mt_occluder_hides(const mt_occluder *occluder, const mt_ray *ray);

/* Finds for every sample of the tile the nearest triangle that its ray hits, at equal t the lowest. Depths are left to
 * mt_triangle_depths. */
void mt_trace_triangles(const mt_frame *frame, const mt_occluder *occluder, mt_tile *tile);

#endif
