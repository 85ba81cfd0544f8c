/* The one hit test of a picture: both orders of drawing, and shadows, ask it and nothing else where a ray meets a
 * triangle. It works in the model's coordinates, where only what is drawn sets the scale; rays are in these, and triangles as mt_ray_triangle_load would load them. */
#ifndef MESHTOOL_RENDER_HIT_H
#define MESHTOOL_RENDER_HIT_H

#include "lib/render/camera.h"

#include <meshtool/ray.h>

#include <float.h>

/* How far off a ray a triangle may lie that it hits, or not be hit by a ray so far inside, in units of the model. The
 * ray's setup bounds the displacement of corners by 8 units of 2^-24 for each unit of reach, and moves origins to
 * within a reach of 4. The fast test is wrong by more on badly shaped triangles. */
static inline double mt_hit_displacement(mt_ray_profile profile)
{
    static const double displacements[] = {0x1p-19, 0x1p-17, 0x1p-44};
    return displacements[profile];
}

static inline void mt_hit_load(const mt_model *model, mt_index triangle, mt_ray_profile profile, mt_ray_triangle *out)
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&model->triangulation, triangle, side);
        mt_vec3 p = mt_model_position(model, model->mesh->corner_vertices[corner]);
        p = mt_ray_space_point(&model->space, p);
        bool is_exact = profile == MT_RAY_EXACT;
        out->corners[side][0] = is_exact ? p.x : (double)(float)p.x;
        out->corners[side][1] = is_exact ? p.y : (double)(float)p.y;
        out->corners[side][2] = is_exact ? p.z : (double)(float)p.z;
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
