/* Where a ray meets a triangle.
 *
 * Watertight: the corners, floats, are sheared in float so that the ray becomes an axis; two triangles shear a shared
 * corner to the same bits. Products of two floats are exact in double, so the sign of their difference is that of the
 * exact edge function, and a point on the plane lies in or on at least one of the triangles around it. Exact: the same
 * decision by exact predicates in space. Both then solve t and weights in double; where the ray misses the unrounded
 * triangle, or is too nearly in its plane for that, at the nearest point of its sides, so that the hit lies in the
 * triangle's box and boxes can be culled by t.
 *
 * Known failure: a triangle whose sheared corners lie on a line is missed, also where a ray in its plane crosses it. */
#include <meshtool/predicates.h>
#include <meshtool/ray.h>

#include "lib/spatial/ray_formulas.h"

#include <string.h>

/* In float units of 2^-24: what rounding moves a sheared corner, at most, for coordinates relative to the origin up to
 * `reach`. Subtraction, shear, product and second subtraction round by half a unit each on both axes, origin and
 * vertices as well: 6 in all; with less, boxes would be culled that hold a hit. */
#define SLACK_UNITS 8.0

/* Rays from farther away start nearer, so that rounding the origin does not move them. */
#define FARTHEST_ORIGIN 2.0

static void choose_axes(mt_vec3 direction, int axes[3])
{
    double x = fabs(direction.x), y = fabs(direction.y), z = fabs(direction.z);
    int largest = y > x;
    largest = z > (largest ? y : x) ? 2 : largest;
    axes[2] = largest;
    axes[0] = largest == 2 ? 0 : largest + 1;
    axes[1] = axes[0] == 2 ? 0 : axes[0] + 1;
}

static void permute(mt_vec3 v, const int axes[3], double out[3])
{
    const double components[3] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; i++) {
        out[i] = components[axes[i]];
    }
}

/* How far along the ray the origin is moved: to the middle's foot on the ray, less the radius of space. */
static double choose_begin(mt_vec3 origin, mt_vec3 direction)
{
    if (mt_vec3_max_abs(origin) <= FARTHEST_ORIGIN) {
        return 0;
    }
    double length = mt_vec3_length(direction);
    double foot = -mt_vec3_dot(origin, direction) / (length * length);
    double begin = foot - FARTHEST_ORIGIN / length;
    return begin > 0 ? begin : 0;
}

static void round_setup(mt_ray_setup *setup)
{
    double reach = 1;
    for (int i = 0; i < 3; i++) {
        setup->float_origin[i] = (float)setup->origin[i];
        setup->float_direction[i] = (float)setup->direction[i];
        double own = 1 + fabs(setup->origin[i]);
        reach = own > reach ? own : reach;
    }
    setup->float_shear[0] = (float)setup->shear[0];
    setup->float_shear[1] = (float)setup->shear[1];
    setup->slack = (float)(SLACK_UNITS * 0x1p-24 * reach);
}

/* A power of two and its inverse. */
typedef struct power {
    double power, inverse;
} power;

/* The power of two that brings a length into [0.5, 1), by its exponent's bits: this is done for every ray. The few
 * lengths whose power has no inverse come as near as those that have. */
static power scale_of(double length)
{
    uint64_t bits;
    memcpy(&bits, &length, sizeof bits);
    uint64_t exponent = bits >> 52;
    exponent = exponent < 1 ? 1 : exponent > 2044 ? 2044 : exponent;
    uint64_t scale = (2045 - exponent) << 52, inverse = (exponent + 1) << 52;
    power result;
    memcpy(&result.power, &scale, sizeof scale);
    memcpy(&result.inverse, &inverse, sizeof inverse);
    return result;
}

void mt_ray_setup_init(const mt_ray_space *space, const mt_ray *ray, mt_ray_profile profile, mt_ray_setup *setup)
{
    setup->profile = profile;
    setup->skip = ray->skip;
    setup->valid = false;
    mt_vec3 origin = mt_ray_space_point(space, ray->origin);
    double largest = mt_vec3_max_abs(ray->direction);
    if (!mt_vec3_is_finite(origin) || !(largest > 0 && largest < INFINITY)) {
        return;
    }
    power unit = scale_of(largest);
    mt_vec3 direction = mt_vec3_scale(ray->direction, unit.power);
    setup->valid = true;
    setup->t_factor = unit.power * (1 / space->scale);
    setup->parameter_factor = unit.inverse * space->scale;
    setup->begin = choose_begin(origin, direction);
    origin = mt_vec3_add(origin, mt_vec3_scale(direction, setup->begin));
    choose_axes(direction, setup->axes);
    permute(origin, setup->axes, setup->origin);
    permute(direction, setup->axes, setup->direction);
    setup->reciprocal = 1 / setup->direction[2];
    setup->shear[0] = setup->direction[0] * setup->reciprocal;
    setup->shear[1] = setup->direction[1] * setup->reciprocal;
    setup->t_minimum = ray->t_minimum;
    setup->t_maximum = ray->t_maximum;
    round_setup(setup);
}

/* All of one sign, zeros allowed, but not all zero: 1 or -1; else 0. False comparisons make NaN 0. */
static int common_sign(double u, double v, double w)
{
    if (u >= 0 && v >= 0 && w >= 0) {
        return u + v + w > 0;
    }
    return u <= 0 && v <= 0 && w <= 0 ? -1 : 0;
}

static int decide_watertight(const mt_ray_setup *setup, const mt_ray_triangle *triangle)
{
    double x[3], y[3];
    for (int i = 0; i < 3; i++) {
        const double *p = triangle->corners[i];
        float along[2] = {(float)p[setup->axes[0]] - setup->float_origin[0],
                          (float)p[setup->axes[1]] - setup->float_origin[1]};
        float depth = (float)p[setup->axes[2]] - setup->float_origin[2];
        x[i] = (double)MT_RAY_SHEAR(along[0], depth, setup->float_shear[0]);
        y[i] = (double)MT_RAY_SHEAR(along[1], depth, setup->float_shear[1]);
    }
    double u = MT_RAY_EDGE(x[1], y[1], x[2], y[2]);
    double v = MT_RAY_EDGE(x[2], y[2], x[0], y[0]);
    double w = MT_RAY_EDGE(x[0], y[0], x[1], y[1]);
    /* A corner that is not finite makes two of the edge functions so. */
    return u + v + w < INFINITY && u + v + w > -INFINITY ? common_sign(u, v, w) : 0;
}

static mt_vec3 corner_by_axes(const mt_ray_setup *setup, const double corner[3])
{
    return mt_vec3_make(corner[setup->axes[0]], corner[setup->axes[1]], corner[setup->axes[2]]);
}

static int decide_exactly(const mt_ray_setup *setup, const mt_ray_triangle *triangle)
{
    mt_vec3 o = mt_vec3_make(setup->origin[0], setup->origin[1], setup->origin[2]);
    mt_vec3 d = mt_vec3_make(setup->direction[0], setup->direction[1], setup->direction[2]);
    mt_vec3 end = mt_vec3_add(o, d);
    mt_vec3 a = corner_by_axes(setup, triangle->corners[0]), b = corner_by_axes(setup, triangle->corners[1]),
            c = corner_by_axes(setup, triangle->corners[2]);
    if (!mt_vec3_is_finite(a) || !mt_vec3_is_finite(b) || !mt_vec3_is_finite(c)) {
        return 0;
    }
    /* The signs of the edge functions above are those of these determinants times that of the direction. */
    int sign = setup->direction[2] < 0 ? 1 : -1;
    return common_sign(sign * mt_orient3d(b, c, end, o), sign * mt_orient3d(c, a, end, o),
                       sign * mt_orient3d(a, b, end, o));
}

/* A triangle's corners in double, sheared so that the ray is the third axis. */
typedef struct sheared {
    double x[3], y[3], z[3];
} sheared;

/* Not returned as a value: a copy of what has just been written number by number waits for all of it. */
static void shear_corners(const mt_ray_setup *setup, const mt_ray_triangle *triangle, sheared *s)
{
    for (int i = 0; i < 3; i++) {
        const double *p = triangle->corners[i];
        s->z[i] = p[setup->axes[2]] - setup->origin[2];
        s->x[i] = MT_RAY_SHEAR(p[setup->axes[0]] - setup->origin[0], s->z[i], setup->shear[0]);
        s->y[i] = MT_RAY_SHEAR(p[setup->axes[1]] - setup->origin[1], s->z[i], setup->shear[1]);
    }
}

/* Weights of the point on the sides that is nearest to the ray: for slivers that the ray misses by no more than what
 * rounding moved their corners. Any other point could lie far along the sliver, outside of boxes that the ray meets. */
static void weigh_sides(const sheared *s, double weights[3])
{
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        double ex = s->x[j] - s->x[i], ey = s->y[j] - s->y[i], square = ex * ex + ey * ey;
        double along = -(s->x[i] * ex + s->y[i] * ey) / square;
        along = !(along > 0) ? 0 : along < 1 ? along : 1;
        double x = s->x[i] + along * ex, y = s->y[i] + along * ey, distance = x * x + y * y;
        if (distance < least) {
            least = distance;
            weights[i] = 1 - along;
            weights[j] = along;
            weights[k] = 0;
        }
    }
}

/* Slope of a plane along the ray up to which its depth is asked: rounding of 2^-52 then moves it by 2^-36, far less
 * than the 2^-24 and more by which boxes are widened. Larger: hits that boxes cull; smaller: slivers whose t is spoilt.
 */
#define STEEPEST_PLANE 0x1p16

static double square_of(const double e[3])
{
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
}

/* Depth of the triangle's plane on the ray, from the corner between the two shorter sides: the weights of a sliver are
 * ratios of areas that rounding spoils, and its longer sides span the plane badly. NAN for a plane nearly along the
 * ray, where the depth of the plane may leave the triangle, and so the boxes that hold it, by more than these are
 * widened. */
static double depth_on_plane(const mt_ray_setup *setup, const mt_ray_triangle *triangle, const sheared *s)
{
    double side[3][3], longest = -1;
    int apex = 0;
    for (int i = 0; i < 3; i++) {
        int from = i == 2 ? 0 : i + 1, to = i == 0 ? 2 : i - 1; /* the side opposite corner i */
        for (int axis = 0; axis < 3; axis++) {
            int at = setup->axes[axis];
            side[i][axis] = triangle->corners[to][at] - triangle->corners[from][at];
        }
        double square = square_of(side[i]);
        apex = square > longest ? i : apex;
        longest = square > longest ? square : longest;
        side[i][0] = MT_RAY_SHEAR(side[i][0], side[i][2], setup->shear[0]);
        side[i][1] = MT_RAY_SHEAR(side[i][1], side[i][2], setup->shear[1]);
    }
    double normal[3];
    MT_RAY_CROSS(side[apex == 2 ? 0 : apex + 1], side[apex == 0 ? 2 : apex - 1], normal);
    bool is_steep = fabs(normal[0]) + fabs(normal[1]) > STEEPEST_PLANE * fabs(normal[2]) || normal[2] == 0;
    double depth = s->z[apex] + (normal[0] * s->x[apex] + normal[1] * s->y[apex]) / normal[2];
    return is_steep ? (double)NAN : depth;
}

/* Weights by areas, for a triangle that is hit, as decided with that sign. False where they cannot be used: the ray
 * misses the unrounded triangle, or the areas are so small beside their rounding that the point they make lies farther
 * off the ray than the slack. */
static bool weigh_areas(const mt_ray_setup *setup, const sheared *s, int sign, double weights[3])
{
    double u = sign * MT_RAY_EDGE(s->x[1], s->y[1], s->x[2], s->y[2]);
    double v = sign * MT_RAY_EDGE(s->x[2], s->y[2], s->x[0], s->y[0]);
    double w = sign * MT_RAY_EDGE(s->x[0], s->y[0], s->x[1], s->y[1]);
    double sum = u + v + w;
    if (!(u >= 0 && v >= 0 && w >= 0 && sum > 0)) {
        return false;
    }
    weights[0] = u / sum;
    weights[1] = v / sum;
    weights[2] = w / sum;
    return fabs(MT_RAY_DOT(weights, s->x)) <= (double)setup->slack &&
           fabs(MT_RAY_DOT(weights, s->y)) <= (double)setup->slack;
}

/* Weights of the corners and t for a triangle that is hit, as decided with that sign. */
static void solve(const mt_ray_setup *setup, const mt_ray_triangle *triangle, int sign, mt_ray_hit *hit)
{
    sheared s;
    shear_corners(setup, triangle, &s);
    if (!weigh_areas(setup, &s, sign, hit->weights)) {
        weigh_sides(&s, hit->weights);
    }
    double depth = hit->weights[0] * s.z[0] + hit->weights[1] * s.z[1] + hit->weights[2] * s.z[2];
    if (setup->profile == MT_RAY_EXACT) {
        double on_plane = depth_on_plane(setup, triangle, &s);
        depth = isnan(on_plane) ? depth : on_plane;
    }
    double low = s.z[0] < s.z[1] ? s.z[0] : s.z[1], high = s.z[0] < s.z[1] ? s.z[1] : s.z[0];
    low = s.z[2] < low ? s.z[2] : low;
    high = s.z[2] > high ? s.z[2] : high;
    depth = depth < low ? low : depth > high ? high : depth;
    hit->t = (setup->begin + depth * setup->reciprocal) * setup->t_factor;
}

static bool hit_fast(const mt_ray_setup *setup, const mt_ray_triangle *triangle, mt_ray_hit *hit)
{
    float corner[3][3], from_a[3], ab[3], ac[3], p[3], q[3], determinant, u, v, t;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 3; i++) {
            corner[i][axis] = (float)triangle->corners[i][setup->axes[axis]];
        }
        from_a[axis] = setup->float_origin[axis] - corner[0][axis];
        ab[axis] = corner[1][axis] - corner[0][axis];
        ac[axis] = corner[2][axis] - corner[0][axis];
    }
    MT_RAY_MOELLER_TRUMBORE(setup->float_direction, from_a, ab, ac, p, q, determinant, u, v, t);
    float sign = determinant < 0 ? -1.0f : 1.0f;
    u *= sign, v *= sign, determinant *= sign;
    if (!(determinant > 0 && determinant < INFINITY && u >= 0 && v >= 0 && u + v <= determinant)) {
        return false;
    }
    hit->weights[1] = (double)u / (double)determinant;
    hit->weights[2] = (double)v / (double)determinant;
    hit->weights[0] = fmax(0, 1 - hit->weights[1] - hit->weights[2]);
    hit->t = (setup->begin + (double)(t * sign / determinant)) * setup->t_factor;
    return true;
}

bool mt_ray_hit_triangle(const mt_ray_setup *setup, const mt_ray_triangle *triangle, mt_index number, mt_ray_hit *hit)
{
    if (number == setup->skip || !setup->valid) {
        return false;
    }
    hit->triangle = number;
    if (setup->profile == MT_RAY_FAST) {
        return hit_fast(setup, triangle, hit) && hit->t >= setup->t_minimum && hit->t <= setup->t_maximum;
    }
    int sign = setup->profile == MT_RAY_EXACT ? decide_exactly(setup, triangle) : decide_watertight(setup, triangle);
    if (!sign) {
        return false;
    }
    solve(setup, triangle, sign, hit);
    return hit->t >= setup->t_minimum && hit->t <= setup->t_maximum;
}

/* A shift of the plane by e moves t by e |n| / |n . d|, and no farther than the corners reach. */
double mt_ray_hit_error(const mt_ray_setup *setup, const mt_ray_triangle *triangle)
{
    double ab[3], ac[3], normal[3], depth[3];
    for (int axis = 0; axis < 3; axis++) {
        int from = setup->axes[axis];
        ab[axis] = triangle->corners[1][from] - triangle->corners[0][from];
        ac[axis] = triangle->corners[2][from] - triangle->corners[0][from];
        depth[axis] = triangle->corners[axis][setup->axes[2]] * setup->reciprocal;
    }
    MT_RAY_CROSS(ab, ac, normal);
    double length = sqrt(MT_RAY_DOT(normal, normal)), incidence = fabs(MT_RAY_DOT(normal, setup->direction));
    double shift = (double)setup->slack * (setup->profile == MT_RAY_EXACT ? 0x1p-29 : 1.0);
    double range = fmax(fmax(depth[0], depth[1]), depth[2]) - fmin(fmin(depth[0], depth[1]), depth[2]) + shift;
    double moved = shift * length / incidence;
    return (moved < range ? moved : range) * fabs(setup->t_factor);
}
