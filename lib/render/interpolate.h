/* Values at the corners of a triangle, weighed. */
#ifndef MESHTOOL_RENDER_INTERPOLATE_H
#define MESHTOOL_RENDER_INTERPOLATE_H

#include <meshtool/vector.h>

static inline mt_vec3 mt_facing(mt_vec3 normal, mt_vec3 side)
{
    return mt_vec3_dot(normal, side) < 0 ? mt_vec3_scale(normal, -1.0) : normal;
}

static inline mt_vec3 mt_unit_or(mt_vec3 a, mt_vec3 otherwise)
{
    double length = mt_vec3_length(a);
    return length > 0 ? mt_vec3_scale(a, 1.0 / length) : otherwise;
}

/* Unit vector along a, quickly where squares neither overflow nor vanish. */
static inline mt_vec3 mt_unit(mt_vec3 a)
{
    double squared = mt_vec3_dot(a, a);
    return squared > 1e-280 && squared < 1e280 ? mt_vec3_scale(a, 1.0 / sqrt(squared)) : mt_vec3_normalize(a);
}

static inline mt_vec3 mt_weigh(const mt_vec3 values[3], const double weights[3])
{
    return mt_vec3_make(values[0].x * weights[0] + values[1].x * weights[1] + values[2].x * weights[2],
                        values[0].y * weights[0] + values[1].y * weights[1] + values[2].y * weights[2],
                        values[0].z * weights[0] + values[1].z * weights[1] + values[2].z * weights[2]);
}

/* Where shadow rays start: on the surface that the unit normals at the corners make believe, above the flat triangle,
 * so that it does not shade itself in steps (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021).
 * `point` is the corners' positions, weighed. */
static inline mt_vec3 mt_lifted_position(mt_vec3 point, const mt_vec3 positions[3], const mt_vec3 normals[3],
                                         const double weights[3])
{
    mt_vec3 raised[3];
    for (int i = 0; i < 3; i++) {
        double below = mt_vec3_dot(mt_vec3_subtract(point, positions[i]), normals[i]);
        raised[i] = mt_vec3_subtract(point, mt_vec3_scale(normals[i], below < 0 ? below : 0.0));
    }
    return mt_weigh(raised, weights);
}

#endif
