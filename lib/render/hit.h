/* The one hit test of a picture: both orders of drawing, and shadows, ask it and nothing else where a ray meets a
 * triangle. It works in the model's coordinates, where only what is drawn sets the scale; rays are in these, and
 * triangles as mt_ray_triangle_load would load them. */
#ifndef MESHTOOL_RENDER_HIT_H
#define MESHTOOL_RENDER_HIT_H

#include "lib/render/camera.h"

#include <meshtool/ray.h>

#include <float.h>

/* What the hit test knows of a triangle, in units of the model. */
typedef struct mt_hit_precision {
    double edges;  /* how far off a ray a triangle may lie that it hits, or not be hit by a ray so far inside */
    double plane;  /* how far its plane may lie from where t is found */
    bool by_shape; /* both grow with the ratio of a triangle's longest side to its height */
} mt_hit_precision;

/* The watertight test rounds corners to floats; its decision shears them in floats, which a ray's setup bounds by 8
 * units of 2^-24 for each unit of reach, at most 3. */
static inline mt_hit_precision mt_hit_precision_of(mt_ray_profile profile)
{
    static const mt_hit_precision precisions[] = {
        [MT_RAY_WATERTIGHT] = {0x1.8p-20, 0x1p-24, false},
        [MT_RAY_FAST] = {0x1p-18, 0x1p-18, true},
        [MT_RAY_EXACT] = {0x1p-44, 0x1p-44, false},
    };
    return precisions[profile];
}

static inline void mt_hit_load(const mt_model *model, mt_index triangle, mt_ray_profile profile, mt_ray_triangle *out)
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&model->triangulation, triangle, side);
        mt_vec3 p = mt_model_position(model, model->mesh->corner_vertices[corner]);
        p = mt_ray_space_point(&model->space, p);
        bool is_exact = profile == MT_RAY_EXACT;
        out->corners[side][0] = is_exact ? p.x : mt_ray_round(p.x);
        out->corners[side][1] = is_exact ? p.y : mt_ray_round(p.y);
        out->corners[side][2] = is_exact ? p.z : mt_ray_round(p.z);
    }
}

/* A ray from the eye, which is not seen itself. */
static inline mt_ray mt_hit_ray(mt_camera_ray from)
{
    mt_ray ray = mt_ray_make(from.origin, from.direction);
    ray.t_minimum = DBL_MIN;
    return ray;
}

static inline bool mt_hit(const mt_model *model, const mt_ray_setup *setup, mt_index triangle, mt_ray_hit *hit)
{
    mt_ray_triangle corners;
    mt_hit_load(model, triangle, setup->profile, &corners);
    return mt_ray_hit_triangle(setup, &corners, triangle, hit);
}

#endif
