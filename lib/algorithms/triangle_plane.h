/* The plane of a triangle, made once for many points: a quick and certain answer for most of them. */
#ifndef MT_ALGORITHMS_TRIANGLE_PLANE_H
#define MT_ALGORITHMS_TRIANGLE_PLANE_H

#include "lib/algorithms/triangle_triangle.h"

typedef struct triangle_plane {
    mt_vec3 origin; /* the first corner */
    mt_vec3 normal;
    double bound; /* on the error of the determinant below */
} triangle_plane;

/* For points that differ from the triangle's by at most `reach` in each coordinate. The determinant is that of
 * mt_orient3d, expanded by the point's row, and so is the bound on its error, but for the reach in the place of the
 * point's own differences. */
static inline triangle_plane triangle_plane_make(const mt_vec3 points[3], double reach)
{
    mt_vec3 e = mt_vec3_subtract(points[1], points[0]), f = mt_vec3_subtract(points[2], points[0]);
    mt_vec3 plus = {e.y * f.z, e.z * f.x, e.x * f.y};
    mt_vec3 minus = {e.z * f.y, e.x * f.z, e.y * f.x};
    double size = fabs(plus.x) + fabs(minus.x) + fabs(plus.y) + fabs(minus.y) + fabs(plus.z) + fabs(minus.z);
    triangle_plane plane = {points[0], mt_vec3_subtract(plus, minus),
                            0x1p-49 * reach * size + 0x1p-1000 * (4 * reach + 1)};
    return plane;
}

/* Whether the corners of `other` that are not the triangle's own lie strictly on one side of its plane, for certain:
 * then the two do not intersect, however many vertices they share. */
static inline bool triangle_plane_parts(const triangle_plane *plane, const indexed_triangle *triangle,
                                        const indexed_triangle *other)
{
    bool above = true, below = true;
    for (int i = 0; i < 3; i++) {
        mt_index vertex = other->vertices[i];
        bool is_own =
            (vertex == triangle->vertices[0]) | (vertex == triangle->vertices[1]) | (vertex == triangle->vertices[2]);
        double side = mt_vec3_dot(mt_vec3_subtract(other->points[i], plane->origin), plane->normal);
        above &= (side > plane->bound) | is_own;
        below &= (side < -plane->bound) | is_own;
    }
    return above | below;
}

#endif
