/* Planes, spheres and triangles by their formulas. */
#include <meshtool/shape.h>

static bool is_ray(const mt_ray *ray)
{
    bool finite = mt_vec3_is_finite(ray->origin) && mt_vec3_is_finite(ray->direction);
    return finite && mt_vec3_max_abs(ray->direction) > 0;
}

static bool is_within(const mt_ray *ray, double t)
{
    return t >= ray->t_minimum && t <= ray->t_maximum && isfinite(t);
}

bool mt_plane_hit(const mt_plane *plane, const mt_ray *ray, double *t)
{
    mt_vec3 normal = mt_vec3_normalize(plane->normal);
    double toward = mt_vec3_dot(normal, ray->direction);
    *t = mt_vec3_dot(normal, mt_vec3_subtract(plane->point, ray->origin)) / toward;
    return is_ray(ray) && toward != 0 && is_within(ray, *t);
}

mt_vec3 mt_plane_normal(const mt_plane *plane)
{
    return mt_vec3_normalize(plane->normal);
}

mt_bounds mt_plane_bounds(const mt_plane *plane)
{
    mt_vec3 n = plane->normal, p = plane->point;
    double at[3] = {p.x, p.y, p.z}, low[3], high[3];
    const bool is_across[3] = {n.y == 0 && n.z == 0, n.x == 0 && n.z == 0, n.x == 0 && n.y == 0};
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = is_across[axis] ? at[axis] : -INFINITY;
        high[axis] = is_across[axis] ? at[axis] : INFINITY;
    }
    mt_bounds bounds = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}, 0, 0};
    return bounds;
}

mt_vec3 mt_plane_closest(const mt_plane *plane, mt_vec3 point)
{
    mt_vec3 normal = mt_vec3_normalize(plane->normal);
    double above = mt_vec3_dot(normal, mt_vec3_subtract(point, plane->point));
    return mt_vec3_subtract(point, mt_vec3_scale(normal, above));
}

/* Unit vector along a and its length, without squaring what may be tiny or huge. */
static mt_vec3 unit_of(mt_vec3 a, double *length)
{
    double squared = mt_vec3_dot(a, a);
    if (squared > 1e-280 && squared < 1e280) {
        *length = sqrt(squared);
        return mt_vec3_scale(a, 1.0 / *length);
    }
    double scale = mt_power_of_two_scale(mt_vec3_max_abs(a));
    *length = mt_vec3_length(mt_vec3_scale(a, scale)) / scale;
    return mt_vec3_normalize(a);
}

/* A ray against a sphere, in units of the radius and of the direction's length. */
typedef struct chord {
    double middle;  /* where the line is nearest to the centre, from the origin */
    double half;    /* from there to the surface; negative: the line passes by */
    double outside; /* squared distance of the origin from the centre, less 1 */
    double t_factor;
} chord;

static chord chord_of(const mt_sphere *sphere, const mt_ray *ray)
{
    chord c = {0, -1, 0, 0};
    if (!is_ray(ray) || !(sphere->radius > 0) || !isfinite(sphere->radius)) {
        return c;
    }
    double length = 1;
    mt_vec3 direction = unit_of(ray->direction, &length);
    mt_vec3 from = mt_vec3_scale(mt_vec3_subtract(ray->origin, sphere->center), 1.0 / sphere->radius);
    c.middle = -mt_vec3_dot(from, direction);
    mt_vec3 aside = mt_vec3_add(from, mt_vec3_scale(direction, c.middle));
    double squared = 1.0 - mt_vec3_dot(aside, aside);
    c.half = squared >= 0 ? sqrt(squared) : -1.0;
    c.outside = mt_vec3_dot(from, from) - 1.0;
    c.t_factor = sphere->radius / length;
    return c;
}

bool mt_sphere_hit(const mt_sphere *sphere, const mt_ray *ray, double *t)
{
    chord c = chord_of(sphere, ray);
    if (!(c.half >= 0)) {
        return false;
    }
    /* The root that is farther from the origin is summed without cancellation; the other follows from the product. */
    double far = c.middle < 0 ? c.middle - c.half : c.middle + c.half;
    double near = far != 0 ? c.outside / far : 0.0;
    double enters = (near < far ? near : far) * c.t_factor, leaves = (near < far ? far : near) * c.t_factor;
    *t = is_within(ray, enters) ? enters : leaves;
    return is_within(ray, *t);
}

bool mt_sphere_hit_again(const mt_sphere *sphere, const mt_ray *ray, double *t)
{
    chord c = chord_of(sphere, ray);
    *t = 2.0 * c.middle * c.t_factor;
    return c.middle > 0 && is_within(ray, *t);
}

mt_vec3 mt_sphere_normal(const mt_sphere *sphere, mt_vec3 point)
{
    double length;
    return unit_of(mt_vec3_subtract(point, sphere->center), &length);
}

mt_bounds mt_sphere_bounds(const mt_sphere *sphere)
{
    mt_vec3 reach = mt_vec3_make(sphere->radius, sphere->radius, sphere->radius);
    mt_bounds bounds = {mt_vec3_subtract(sphere->center, reach), mt_vec3_add(sphere->center, reach), 0, 0};
    return bounds;
}

mt_vec3 mt_sphere_closest(const mt_sphere *sphere, mt_vec3 point)
{
    mt_vec3 normal = mt_sphere_normal(sphere, point);
    if (mt_vec3_max_abs(normal) == 0) {
        normal = mt_vec3_make(1, 0, 0);
    }
    return mt_vec3_add(sphere->center, mt_vec3_scale(normal, sphere->radius));
}

bool mt_triangle_hit(const mt_triangle *triangle, const mt_ray *ray, double *t)
{
    const mt_vec3 *c = triangle->corners;
    double positions[9] = {c[0].x, c[0].y, c[0].z, c[1].x, c[1].y, c[1].z, c[2].x, c[2].y, c[2].z};
    mt_index corners[3] = {0, 1, 2};
    const mt_mesh mesh = {.vertex_count = 3,
                          .position_type = MT_F64,
                          .positions = positions,
                          .face_count = 1,
                          .corner_count = 3,
                          .face_size = 3,
                          .corner_vertices = corners};
    const mt_triangulation triangulation = {1, NULL, NULL};
    mt_ray_space space = mt_ray_space_of(&mesh);
    mt_ray_setup setup;
    mt_ray_triangle loaded;
    mt_ray_hit hit;
    mt_ray_setup_init(&space, ray, MT_RAY_EXACT, &setup);
    mt_ray_triangle_load(&space, &mesh, &triangulation, 0, MT_RAY_EXACT, &loaded);
    setup.skip = MT_NONE;
    if (!mt_ray_hit_triangle(&setup, &loaded, 0, &hit)) {
        return false;
    }
    *t = hit.t;
    return true;
}

mt_vec3 mt_triangle_normal(const mt_triangle *triangle)
{
    const mt_vec3 *c = triangle->corners;
    mt_vec3 u = mt_vec3_subtract(c[1], c[0]), v = mt_vec3_subtract(c[2], c[0]);
    double largest = fmax(mt_vec3_max_abs(u), mt_vec3_max_abs(v)), scale = mt_power_of_two_scale(largest);
    return mt_vec3_normalize(mt_vec3_cross(mt_vec3_scale(u, scale), mt_vec3_scale(v, scale)));
}

mt_bounds mt_triangle_bounds(const mt_triangle *triangle)
{
    const mt_vec3 *c = triangle->corners;
    mt_bounds bounds = {c[0], c[0], 0, 0};
    for (int i = 1; i < 3; i++) {
        bounds.minimum = mt_vec3_make(fmin(bounds.minimum.x, c[i].x), fmin(bounds.minimum.y, c[i].y),
                                      fmin(bounds.minimum.z, c[i].z));
        bounds.maximum = mt_vec3_make(fmax(bounds.maximum.x, c[i].x), fmax(bounds.maximum.y, c[i].y),
                                      fmax(bounds.maximum.z, c[i].z));
    }
    return bounds;
}

static mt_vec3 between(mt_vec3 from, mt_vec3 along, double share)
{
    return mt_vec3_add(from, mt_vec3_scale(along, share));
}

mt_vec3 mt_triangle_closest(const mt_triangle *triangle, mt_vec3 point)
{
    mt_vec3 a = triangle->corners[0], b = triangle->corners[1], c = triangle->corners[2];
    mt_vec3 ab = mt_vec3_subtract(b, a), ac = mt_vec3_subtract(c, a), ap = mt_vec3_subtract(point, a);
    double d1 = mt_vec3_dot(ab, ap), d2 = mt_vec3_dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    mt_vec3 bp = mt_vec3_subtract(point, b), cp = mt_vec3_subtract(point, c);
    double d3 = mt_vec3_dot(ab, bp), d4 = mt_vec3_dot(ac, bp), d5 = mt_vec3_dot(ab, cp), d6 = mt_vec3_dot(ac, cp);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    double beyond_c = d1 * d4 - d3 * d2, beyond_b = d5 * d2 - d1 * d6, beyond_a = d3 * d6 - d5 * d4;
    if (beyond_c <= 0 && d1 >= 0 && d3 <= 0) {
        return between(a, ab, d1 / (d1 - d3));
    }
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    if (beyond_b <= 0 && d2 >= 0 && d6 <= 0) {
        return between(a, ac, d2 / (d2 - d6));
    }
    if (beyond_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return between(b, mt_vec3_subtract(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    double sum = beyond_a + beyond_b + beyond_c;
    return mt_vec3_add(a, mt_vec3_add(mt_vec3_scale(ab, beyond_b / sum), mt_vec3_scale(ac, beyond_c / sum)));
}
