#include "tradeoff/ray_oracle.h"

#include "tradeoff/quad_triangle.h"

/* How far the ray passes by the line through two corners. */
static quad distance_to_line(const mt_ray *ray, mt_vec3 from, mt_vec3 to)
{
    quad3 a = quad3_from(from), across = quad3_cross(quad3_subtract(quad3_from(to), a), quad3_from(ray->direction));
    quad length = quad_sqrt(quad3_dot(across, across));
    return length > 0 ? quad_absolute(quad3_dot(quad3_subtract(a, quad3_from(ray->origin)), across)) / length : 0;
}

/* Of the ray's direction and the triangle's normal. */
static quad cosine(const mt_ray *ray, const mt_vec3 corners[3])
{
    quad3 a = quad3_from(corners[0]);
    quad3 normal = quad3_cross(quad3_subtract(quad3_from(corners[1]), a), quad3_subtract(quad3_from(corners[2]), a));
    return quad_absolute(quad3_dot(quad3_normalize(normal), quad3_from(ray->direction)));
}

double ray_oracle_limit(const mt_mesh *mesh, const mt_triangulation *triangulation, const mt_ray *ray, double margin)
{
    double limit = INFINITY;
    for (mt_index triangle = 0; triangle < triangulation->triangle_count; triangle++) {
        mt_vec3 corners[3];
        quad_load_corners(mesh, triangulation, triangle, corners);
        double t = quad_meet_triangle(corners, ray, margin);
        if (!(t < limit)) {
            continue;
        }
        bool is_inside = true;
        for (int side = 0; side < 3; side++) {
            is_inside = is_inside && distance_to_line(ray, corners[side], corners[(side + 1) % 3]) > margin;
        }
        if (is_inside) {
            limit = fmin(limit, (double)((quad)t + margin / cosine(ray, corners)));
        }
    }
    return limit;
}

bool ray_oracle_accepts(const mt_mesh *mesh, const mt_triangulation *triangulation, const mt_ray *ray,
                        const mt_ray_hit *hit, double limit, double margin)
{
    if (hit->triangle == MT_NONE) {
        return isinf(limit);
    }
    mt_vec3 corners[3];
    quad_load_corners(mesh, triangulation, hit->triangle, corners);
    return hit->t <= limit && quad_distance_to_triangle(corners, mt_ray_at(ray, hit->t)) <= 2 * margin;
}
