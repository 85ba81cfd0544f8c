/* Rays through a compiled scene: what is nearest, and how much light passes. */
#ifndef MESHTOOL_RENDER_SCENE_TRACE_H
#define MESHTOOL_RENDER_SCENE_TRACE_H

#include "lib/render/scene_plan.h"

/* From a point of the surface of an object, or from the eye (skip_object MT_NONE). */
typedef struct mt_scene_ray {
    mt_vec3 origin, direction;
    double t_minimum, t_maximum;
    mt_index skip_object; /* the ray starts on it: its triangle skip_triangle is not hit; a plane is not hit again, a
                             sphere only on its far side */
    mt_index skip_triangle;
} mt_scene_ray;

typedef struct mt_scene_hit {
    double t;
    mt_index object;   /* MT_NONE: nothing was hit */
    mt_index triangle; /* of the object's part */
    double weights[3];
} mt_scene_hit;

static inline mt_scene_hit mt_scene_no_hit(void)
{
    mt_scene_hit hit = {INFINITY, MT_NONE, MT_NONE, {0, 0, 0}};
    return hit;
}

/* Nearest t wins, equal t goes to the object that comes first. */
static inline bool mt_scene_is_nearer(const mt_scene_hit *a, const mt_scene_hit *b)
{
    return a->t < b->t || (a->t == b->t && a->object < b->object);
}

/* What one thread counts and finds out while it traces. */
typedef struct mt_scene_tracer {
    const mt_scene_plan *plan;
    bool is_blocked; /* a part was wanted that is not built: what was traced since is worthless */
    uint64_t shadow_rays, reflected_rays, refracted_rays;
    struct mt_scene_pending *stack; /* NULL where rays do not follow one another */
} mt_scene_tracer;

/* Planes and spheres nearer than *best replace it; with meshes too in mt_scene_nearest. */
void mt_scene_nearest_plane(const mt_scene_plan *plan, const mt_scene_ray *ray, mt_scene_hit *best);
mt_scene_hit mt_scene_nearest(mt_scene_tracer *tracer, const mt_scene_ray *ray);
/* The same without meshes. */
mt_scene_hit mt_scene_nearest_formula(const mt_scene_plan *plan, const mt_scene_ray *ray);

/* Glass around the origin of a ray, the last entered on top. */
#define MT_MEDIA_ROOM 8
typedef struct mt_media {
    mt_index count;
    mt_index objects[MT_MEDIA_ROOM];
} mt_media;

/* The share of light that comes along the ray from its end: 0 behind what is opaque. media: around the origin. */
mt_vec3 mt_scene_light_through(mt_scene_tracer *tracer, mt_scene_ray ray, const mt_media *media);

/* What is left of light after a way through the material of an object. */
mt_vec3 mt_scene_attenuation(const mt_scene_plan *plan, mt_index object, double way);

#endif
