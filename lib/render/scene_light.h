/* The light of lamps and surroundings that a point of a scene sends to the eye. */
#ifndef MESHTOOL_RENDER_SCENE_LIGHT_H
#define MESHTOOL_RENDER_SCENE_LIGHT_H

#include "lib/render/scene_point.h"

/* Ambient, Lambert and Blinn-Phong, summed over the lights in their order. media: on the side from which it is seen. */
mt_vec3 mt_scene_light_of(mt_scene_tracer *tracer, const mt_scene_point *point, const mt_media *media);

/* What is seen along a ray that hits nothing. */
mt_vec3 mt_scene_background_light(const mt_scene_plan *plan, mt_vec3 direction);

#endif
