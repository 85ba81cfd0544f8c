#include "tradeoff/quad_triangle.h"

/* By Cramer's rule. */
double quad_meet_triangle(const mt_vec3 corners[3], const mt_ray *ray, double margin)
{
    triangle_box box = triangle_box_around(corners);
    if (!triangle_box_may_meet(&box, ray, margin)) {
        return INFINITY;
    }
    quad3 a = quad3_from(corners[0]), d = quad3_from(ray->direction);
    quad3 ab = quad3_subtract(quad3_from(corners[1]), a), ac = quad3_subtract(quad3_from(corners[2]), a);
    quad3 ao = quad3_subtract(quad3_from(ray->origin), a), across = quad3_cross(d, ac), along = quad3_cross(ao, ab);
    quad determinant = quad3_dot(ab, across);
    if (determinant == 0) {
        return INFINITY;
    }
    quad v = quad3_dot(ao, across) / determinant, w = quad3_dot(d, along) / determinant;
    quad t = quad3_dot(ac, along) / determinant;
    return v >= 0 && w >= 0 && v + w <= 1 && t >= 0 ? (double)t : INFINITY;
}

/* The point of a segment nearest to p. */
static quad3 nearest_on_segment(quad3 p, quad3 a, quad3 b)
{
    quad3 ab = quad3_subtract(b, a);
    quad squared = quad3_dot(ab, ab), along = quad3_dot(quad3_subtract(p, a), ab);
    quad t = squared > 0 ? along / squared : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return quad3_add(a, quad3_scale(ab, t));
}

static quad squared_distance(quad3 a, quad3 b)
{
    quad3 d = quad3_subtract(a, b);
    return quad3_dot(d, d);
}

/* How far, at least, a number lies from those between the least and the greatest of three. */
static double gap(double at, double a, double b, double c)
{
    return fmax(fmin(a, fmin(b, c)) - at, at - fmax(a, fmax(b, c)));
}

/* In shares of the distance, whose squares overflow only far away; a share that is no number leaves nothing out. */
bool quad_may_be_nearer(const mt_vec3 p[3], mt_vec3 point, double distance)
{
    double x = fmax(gap(point.x, p[0].x, p[1].x, p[2].x), 0) / distance;
    double y = fmax(gap(point.y, p[0].y, p[1].y, p[2].y), 0) / distance;
    double z = fmax(gap(point.z, p[0].z, p[1].z, p[2].z), 0) / distance;
    return !(x * x + y * y + z * z > 1 + 0x1p-40);
}

/* The foot of the perpendicular where it falls inside, else the nearest of the three sides. */
double quad_distance_to_triangle(const mt_vec3 corners[3], mt_vec3 point)
{
    quad3 p = quad3_from(point), a = quad3_from(corners[0]), b = quad3_from(corners[1]), c = quad3_from(corners[2]);
    quad3 ab = quad3_subtract(b, a), ac = quad3_subtract(c, a), ap = quad3_subtract(p, a), n = quad3_cross(ab, ac);
    quad area = quad3_dot(n, n);
    if (area > 0) {
        quad v = quad3_dot(quad3_cross(ap, ac), n) / area, w = quad3_dot(quad3_cross(ab, ap), n) / area;
        if (v >= 0 && w >= 0 && v + w <= 1) {
            return (double)(quad_absolute(quad3_dot(ap, n)) / quad_sqrt(area));
        }
    }
    quad best = squared_distance(p, nearest_on_segment(p, a, b));
    quad other = squared_distance(p, nearest_on_segment(p, b, c));
    best = other < best ? other : best;
    other = squared_distance(p, nearest_on_segment(p, c, a));
    return (double)quad_sqrt(other < best ? other : best);
}

static quad3 area_vector(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    quad3 first = quad3_from(mt_mesh_position(mesh, mesh->corner_vertices[begin])), sum = {0, 0, 0};
    for (mt_index corner = begin + 1; corner + 1 < end; corner++) {
        quad3 a = quad3_from(mt_mesh_position(mesh, mesh->corner_vertices[corner]));
        quad3 b = quad3_from(mt_mesh_position(mesh, mesh->corner_vertices[corner + 1]));
        sum = quad3_add(sum, quad3_cross(quad3_subtract(a, first), quad3_subtract(b, first)));
    }
    return sum;
}

void quad_vertex_normals(const mt_mesh *mesh, mt_index step, quad3 *normals)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        quad3 area = {0, 0, 0};
        bool is_known = false;
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            mt_index vertex = mesh->corner_vertices[corner];
            if (vertex % step == 0) {
                area = is_known ? area : area_vector(mesh, face);
                is_known = true;
                normals[vertex] = quad3_add(normals[vertex], area);
            }
        }
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex += step) {
        normals[vertex] = quad3_normalize(normals[vertex]);
    }
}

void quad_load_corners(const mt_mesh *mesh, const mt_triangulation *triangulation, mt_index triangle,
                       mt_vec3 corners[3])
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, side);
        corners[side] = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
    }
}
