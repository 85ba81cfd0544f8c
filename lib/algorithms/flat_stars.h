/* Vertices whose triangles lie around them like the sectors of a disc: no two of them meet elsewhere. */
#ifndef MT_ALGORITHMS_FLAT_STARS_H
#define MT_ALGORITHMS_FLAT_STARS_H

#include <meshtool/mesh.h>
#include <meshtool/triangulate.h>

/* To which sides of the three coordinate planes a triangle certainly turns: bit `axis` when it is counterclockwise seen
 * from the positive end of that axis, bit 3 + `axis` when clockwise; no bit where rounding leaves that open. */
static inline uint8_t triangle_facing(const mt_vec3 points[3])
{
    mt_vec3 e = mt_vec3_subtract(points[1], points[0]), f = mt_vec3_subtract(points[2], points[0]);
    const double plus[3] = {e.y * f.z, e.z * f.x, e.x * f.y};
    const double minus[3] = {e.z * f.y, e.x * f.z, e.y * f.x};
    unsigned facing = 0;
    for (unsigned axis = 0; axis < 3; axis++) {
        /* Three roundings of each product and one of the difference, with room; the constant is for underflow. */
        double bound = 0x1p-50 * (fabs(plus[axis]) + fabs(minus[axis])) + 0x1p-1000;
        double twice_area = plus[axis] - minus[axis];
        facing |= (unsigned)(twice_area > bound) << axis | (unsigned)(twice_area < -bound) << (axis + 3);
    }
    return (uint8_t)facing;
}

/* Sets flat[v] to 1 where it is certain that no two triangles that have v in common intersect (by the rule of
 * self_intersection.h), else to 0. `facings` holds triangle_facing of every triangle. O(triangles + vertices) time; 24
 * bytes a triangle and 4 a vertex meanwhile. MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_find_flat_stars(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                             const mt_vec3 *points, const uint8_t *facings, uint8_t *flat);

#endif
