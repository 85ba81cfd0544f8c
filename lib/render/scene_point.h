/* A point of the surface of a scene, ready to be shaded and to send rays on. */
#ifndef MESHTOOL_RENDER_SCENE_POINT_H
#define MESHTOOL_RENDER_SCENE_POINT_H

#include "lib/render/scene_trace.h"

typedef struct mt_scene_point {
    const mt_material *material;
    mt_index object, triangle;
    mt_vec3 position;
    mt_vec3 lifted;      /* where shadow rays start */
    mt_vec3 face_normal; /* unit, against the ray that came */
    mt_vec3 normal;      /* unit, shading; on the same side */
    mt_vec3 toward_eye;  /* unit, against the ray that came */
    mt_vec3 color;
    bool is_front; /* the ray came from the front, for glass from outside */
} mt_scene_point;

mt_scene_point mt_scene_point_make(const mt_scene_plan *plan, const mt_scene_ray *ray, const mt_scene_hit *hit);

/* A ray from the point, or from near it on the surface, that does not meet where it starts. */
mt_scene_ray mt_scene_ray_from(const mt_scene_plan *plan, const mt_scene_point *point, mt_vec3 position,
                               mt_vec3 direction);

#endif
