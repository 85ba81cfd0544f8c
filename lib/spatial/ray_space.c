/* The space of a mesh in which its rays and triangles meet, and where secondary rays start in it. */
#include <meshtool/ray.h>

/* A hit's point is off by the rounding of the vertices (half a unit), of the ray's origin when it sets out again (half)
 * and of its shear (a few); with less than this a surface shadows itself at grazing angles, with much more a ray jumps
 * through walls close behind. */
#define OFFSET_UNITS 8.0

/* Of floats just below 1, about the reach of space. */
#define UNIT_IN_THE_LAST_PLACE 0x1p-24

mt_ray_space mt_ray_space_of(const mt_mesh *mesh)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    mt_ray_space space = {{0, 0, 0}, 1};
    if (!bounds.finite_count) {
        return space;
    }
    double largest = fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum));
    double coarse = mt_power_of_two_scale(largest);
    mt_vec3 low = mt_vec3_scale(bounds.minimum, coarse), high = mt_vec3_scale(bounds.maximum, coarse);
    mt_vec3 middle = mt_vec3_scale(mt_vec3_add(low, high), 0.5);
    double fine = mt_power_of_two_scale(mt_vec3_max_abs(mt_vec3_subtract(high, low)));
    bool fits = isfinite(coarse * fine);
    space.scale = fits ? coarse * fine : coarse;
    space.center = fits ? mt_vec3_scale(middle, fine) : middle;
    return space;
}

/* In space, all of which is within 1 of the middle, the error of a hit does not shrink near an axis' zero: origins and
 * shears are rounded relative to the whole. So one length serves all places. */
mt_vec3 mt_ray_offset(const mt_ray_space *space, mt_vec3 point, mt_vec3 side)
{
    mt_vec3 unit = mt_vec3_normalize(side);
    mt_vec3 reached = mt_vec3_scale(mt_ray_space_point(space, point), UNIT_IN_THE_LAST_PLACE);
    double length = OFFSET_UNITS * (UNIT_IN_THE_LAST_PLACE + mt_vec3_max_abs(reached));
    return mt_vec3_add(point, mt_vec3_scale(unit, length / space->scale));
}
