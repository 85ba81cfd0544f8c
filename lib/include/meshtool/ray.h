/* Rays, and the one function that says where a ray meets a triangle.
 *
 * Everything that looks for hits (the tree, a rasteriser, brute force, other structures) only finds candidates,
 * conservatively, and calls mt_ray_hit_triangle with the same mt_ray_setup for the answer: nearest t wins, equal t goes
 * to the lowest triangle (mt_ray_hit_is_nearer). Whoever finds the same candidates finds the same bits.
 *
 * Rays and triangles meet in a mesh's own space: p' = p * scale - center, with scale a power of two that brings the
 * extent to 1. There floats suffice for the decision, whatever the magnitude and the place of the mesh.
 *
 * Sources: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2 (2013); Ize, "Robust BVH Ray
 * Traversal", JCGT 2 (2013); Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2 (1997). */
#ifndef MESHTOOL_RAY_H
#define MESHTOOL_RAY_H

#include <meshtool/mesh.h>
#include <meshtool/triangulate.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a hit is decided. In every profile a ray in the plane of a triangle misses it, and both sides are hit. */
typedef enum mt_ray_profile {
    /* No ray passes between triangles that share vertices. The vertices are rounded to float in the mesh's space
     * (half of 2^-24 of the extent), edge tests on them, sheared along the ray, are exact in sign; t and the weights
     * are then solved in double. */
    MT_RAY_WATERTIGHT = 0,
    /* Moeller and Trumbore's test in float. Rays at edges and vertices slip through; t is off by a relative 1e-3 and
     * more where the ray grazes. */
    MT_RAY_FAST,
    /* The mesh's own vertices in double, edge tests with exact sign, t and weights in double. The ray is the line
     * through the doubles origin and origin + direction. Watertight too. */
    MT_RAY_EXACT
} mt_ray_profile;

/* In the coordinates of the mesh. */
typedef struct mt_ray {
    mt_vec3 origin;
    mt_vec3 direction;           /* of any length but zero; t counts in it */
    double t_minimum, t_maximum; /* the ends count as hits; INFINITY: no end */
    mt_index skip;               /* triangle that is not hit, for rays that start on it; MT_NONE: none */
} mt_ray;

/* From the origin to infinity. */
static inline mt_ray mt_ray_make(mt_vec3 origin, mt_vec3 direction)
{
    mt_ray ray = {origin, direction, 0, INFINITY, MT_NONE};
    return ray;
}

static inline mt_vec3 mt_ray_at(const mt_ray *ray, double t)
{
    return mt_vec3_add(ray->origin, mt_vec3_scale(ray->direction, t));
}

/* Where a mesh's rays and triangles meet: p' = p * scale - center. All finite vertices come to lie within [-1, 1]. */
typedef struct mt_ray_space {
    mt_vec3 center;
    double scale;
} mt_ray_space;
mt_ray_space mt_ray_space_of(const mt_mesh *mesh);

static inline mt_vec3 mt_ray_space_point(const mt_ray_space *space, mt_vec3 p)
{
    return mt_vec3_make(p.x * space->scale - space->center.x, p.y * space->scale - space->center.y,
                        p.z * space->scale - space->center.z);
}

/* What a ray needs once, before it meets triangles. Fields are for this library's own loops. */
typedef struct mt_ray_setup {
    mt_ray_profile profile;
    bool valid;          /* false: origin or direction is not finite, or the direction zero; such a ray hits nothing */
    int axes[3];         /* the last is the direction's largest component */
    double origin[3];    /* in space, by axes; moved along the ray to within 2 of the middle */
    double direction[3]; /* in space, by axes; the largest component in [0.5, 1) */
    double shear[2];     /* direction[0] / direction[2], direction[1] / direction[2] */
    double reciprocal;   /* 1 / direction[2] */
    double begin;        /* parameter of `origin` on the ray, in space */
    double t_factor;     /* t = (begin + parameter) * t_factor */
    double parameter_factor; /* its inverse */
    double t_minimum, t_maximum;
    float float_origin[3], float_direction[3], float_shear[2]; /* the same, rounded; by axes */
    /* What is lost by rounding origin and vertices, the shear included: a triangle that is hit lies at most so far off
     * the ray, in space. Boxes are widened by it. */
    float slack;
    mt_index skip;
} mt_ray_setup;
void mt_ray_setup_init(const mt_ray_space *space, const mt_ray *ray, mt_ray_profile profile, mt_ray_setup *setup);

/* Corners of a triangle in space, x y z each: rounded to float for MT_RAY_WATERTIGHT and MT_RAY_FAST. */
typedef struct mt_ray_triangle {
    double corners[3][3];
} mt_ray_triangle;

/* To float and back. The float goes through memory: gcc 12 drops the rounding from (double)(float)x where it makes
 * vectors of several (tests/bugs/test_ray_rounding.c). */
static inline double mt_ray_round(double x)
{
    float rounded = (float)x;
    __asm__("" : "+m"(rounded));
    return (double)rounded;
}

static inline void mt_ray_triangle_load(const mt_ray_space *space, const mt_mesh *mesh,
                                        const mt_triangulation *triangulation, mt_index triangle,
                                        mt_ray_profile profile, mt_ray_triangle *out)
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index vertex = mesh->corner_vertices[mt_triangulation_corner(triangulation, triangle, side)];
        mt_vec3 p = mt_ray_space_point(space, mt_mesh_position(mesh, vertex));
        bool is_exact = profile == MT_RAY_EXACT;
        out->corners[side][0] = is_exact ? p.x : mt_ray_round(p.x);
        out->corners[side][1] = is_exact ? p.y : mt_ray_round(p.y);
        out->corners[side][2] = is_exact ? p.z : mt_ray_round(p.z);
    }
}

typedef struct mt_ray_hit {
    double t;
    double weights[3]; /* barycentric, of the triangle's three corners; not negative, they sum to 1 within 2^-52 */
    mt_index triangle; /* MT_NONE: nothing was hit */
} mt_ray_hit;

/* A hit of nothing, farther than any other. */
static inline mt_ray_hit mt_ray_no_hit(void)
{
    mt_ray_hit hit = {INFINITY, {0, 0, 0}, MT_NONE};
    return hit;
}

/* Where the ray meets the triangle, or false: a miss, a t outside of the ray's range, a corner that is not finite, or
 * `number` is the one to skip. t never leaves the range that the three corners span along the ray. */
bool mt_ray_hit_triangle(const mt_ray_setup *setup, const mt_ray_triangle *triangle, mt_index number, mt_ray_hit *hit);

/* Nearest t wins, equal t goes to the lowest triangle. */
static inline bool mt_ray_hit_is_nearer(const mt_ray_hit *a, const mt_ray_hit *b)
{
    return (a->t < b->t) | ((a->t == b->t) & (a->triangle < b->triangle));
}

/* How far a hit's t may lie from the exact one of the mesh's own triangle, in units of t, by rounding alone: grows as
 * the ray grazes, up to the range of the triangle along the ray. */
double mt_ray_hit_error(const mt_ray_setup *setup, const mt_ray_triangle *triangle);

/* Where a secondary ray starts: the point of a hit moved to the side of the surface to which `side` points (the
 * triangle's normal, turned towards the new direction; any length), by a few units in the last place of the floats of
 * space: far enough to clear the triangle that was hit in spite of rounding, and no farther, so that a second wall 100
 * such units behind is not jumped. Together with mt_ray.skip. */
mt_vec3 mt_ray_offset(const mt_ray_space *space, mt_vec3 point, mt_vec3 side);

#ifdef __cplusplus
}
#endif
#endif
