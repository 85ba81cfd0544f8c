/* Planes, spheres and triangles by their formulas: where a ray meets them, their normals, bounds and nearest points.
 *
 * t counts in the ray's direction, of any length but zero, as in meshtool/ray.h; both ends of the ray's range count as
 * hits, and its `skip` is not looked at. A ray or a shape that is not finite hits nothing. All is in doubles. */
#ifndef MESHTOOL_SHAPE_H
#define MESHTOOL_SHAPE_H

#include <meshtool/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All points p with (p - point) . normal = 0. The normal has any length but zero, and points to the front. */
typedef struct mt_plane {
    mt_vec3 point, normal;
} mt_plane;

/* The radius is positive; the front is outside. */
typedef struct mt_sphere {
    mt_vec3 center;
    double radius;
} mt_sphere;

/* The front is where the corners turn counter-clockwise. */
typedef struct mt_triangle {
    mt_vec3 corners[3];
} mt_triangle;

/* Where the ray crosses the plane; false where it does not, and where it runs within the plane. */
bool mt_plane_hit(const mt_plane *plane, const mt_ray *ray, double *t);
/* The unit normal. */
mt_vec3 mt_plane_normal(const mt_plane *plane);
/* Infinite, but along an axis to which the plane is exactly at right angles: there it is one value. */
mt_bounds mt_plane_bounds(const mt_plane *plane);
mt_vec3 mt_plane_closest(const mt_plane *plane, mt_vec3 point);

/* The nearest point within the ray's range where it enters or leaves the sphere. The discriminant is taken from the
 * line's distance to the centre, which keeps its digits where the sphere is small and far (Haines, Guenther and
 * Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019). */
bool mt_sphere_hit(const mt_sphere *sphere, const mt_ray *ray, double *t);
/* The other point where a ray that starts on the sphere meets it again: false when it leads outwards. The start is
 * taken to lie on the sphere, by how little it may miss it, so that no small distance decides what is a hit. */
bool mt_sphere_hit_again(const mt_sphere *sphere, const mt_ray *ray, double *t);
/* The unit normal at a point of the sphere; its direction from the centre anywhere else. */
mt_vec3 mt_sphere_normal(const mt_sphere *sphere, mt_vec3 point);
mt_bounds mt_sphere_bounds(const mt_sphere *sphere);
/* On the sphere; from the centre, the point along +X. */
mt_vec3 mt_sphere_closest(const mt_sphere *sphere, mt_vec3 point);

/* As mt_ray_hit_triangle with MT_RAY_EXACT, in the triangle's own space. */
bool mt_triangle_hit(const mt_triangle *triangle, const mt_ray *ray, double *t);
/* The unit normal; zero when the triangle has no area. */
mt_vec3 mt_triangle_normal(const mt_triangle *triangle);
mt_bounds mt_triangle_bounds(const mt_triangle *triangle);
/* Ericson, "Real-Time Collision Detection" (2005), section 5.1.5. */
mt_vec3 mt_triangle_closest(const mt_triangle *triangle, mt_vec3 point);

#ifdef __cplusplus
}
#endif
#endif
