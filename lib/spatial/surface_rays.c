/* Rays through the tree: nodes front to back, culled only behind the best t; leaves filtered eight triangles at a time
 * in float, and what passes is asked of mt_ray_hit_triangle, so that the answer is that of brute force.
 *
 * Boxes: the slabs of Kay and Kajiya with the reciprocal of the direction. Zero components give infinite slabs, or NaN
 * where a plane goes through the origin, which the order of minimum and maximum drops: inside. Each plane is moved
 * outwards by what the triangle test can be off and what this test rounds (after Ize 2013, here added to the origin
 * instead of multiplied to the distance, which costs nothing in the loop). */
#include <meshtool/surface_tree.h>

#include "lib/spatial/lanes.h"
#include "lib/spatial/ray_formulas.h"
#include "lib/spatial/surface_tree.h"

/* Of the ray's slack: the slab's own subtraction, reciprocal and product round by half a unit each, the slack is eight.
 */
#define BOX_SLACK 1.5f

typedef struct ray_walk {
    mt_ray_setup setup;
    const mt_surface_tree *tree;
    bool any; /* the first hit will do */
    int near_planes[3], far_planes[3];
    float near_origin[3], far_origin[3], reciprocal[3]; /* x y z */
    float begin, limit;                                 /* parameters in space between which boxes count */
    mt_ray_hit best;
} ray_walk;

typedef struct pending {
    float near;
    uint32_t child;
} pending;

/* A parameter in space not below that of t, as a float. */
static float parameter_above(const mt_ray_setup *setup, double t)
{
    double parameter = t / setup->t_factor - setup->begin;
    return (float)(parameter + fabs(parameter) * 0x1p-22 + setup->begin * 0x1p-50);
}

static void start_walk(ray_walk *walk)
{
    const mt_ray_setup *setup = &walk->setup;
    for (int i = 0; i < 3; i++) {
        int axis = setup->axes[i];
        bool negative = signbit(setup->direction[i]);
        float slack = (negative ? -BOX_SLACK : BOX_SLACK) * setup->slack;
        walk->near_planes[axis] = 2 * axis + negative;
        walk->far_planes[axis] = 2 * axis + !negative;
        walk->near_origin[axis] = setup->float_origin[i] + slack;
        walk->far_origin[axis] = setup->float_origin[i] - slack;
        walk->reciprocal[axis] = (float)(1 / setup->direction[i]);
    }
    double begin = setup->t_minimum / setup->t_factor - setup->begin;
    begin -= fabs(begin) * 0x1p-22;
    walk->begin = setup->begin > 0 && begin < 0 ? 0 : (float)begin;
    walk->limit = parameter_above(setup, setup->t_maximum);
    walk->best = mt_ray_no_hit();
}

/* Where the ray enters each child; returns the bits of those that it meets. */
MT_INLINE uint32_t enter_children(const ray_walk *walk, const mt_surface_node *node, lanes *near)
{
    lanes far, x;
    *near = walk->begin + (lanes){0};
    far = walk->limit + (lanes){0};
    for (int axis = 0; axis < 3; axis++) {
        lanes_load(node->planes[walk->near_planes[axis]], &x);
        x = (x - walk->near_origin[axis]) * walk->reciprocal[axis];
        lanes_maximum(&x, near, near);
        lanes_load(node->planes[walk->far_planes[axis]], &x);
        x = (x - walk->far_origin[axis]) * walk->reciprocal[axis];
        lanes_minimum(&x, &far, &far);
    }
    lane_mask met = *near <= far;
    return lanes_bits(&met);
}

/* The corners of a leaf's triangles relative to the ray's origin, by the ray's axes. */
MT_INLINE void load_corner(const ray_walk *walk, const float *words, mt_index count, int corner, lanes out[3])
{
    for (int i = 0; i < 3; i++) {
        lanes_load(words + (size_t)(3 * corner + walk->setup.axes[i]) * count, &out[i]);
        out[i] = out[i] - walk->setup.float_origin[i];
    }
}

/* Edge functions of the sheared corners, whose signs are right or zero. With a margin: what rounding of vertices and
 * shear may have taken from each is allowed for. */
MT_INLINE uint32_t filter_edges(const ray_walk *walk, const float *words, mt_index count, bool with_margin)
{
    lanes x[3], y[3], low = {0}, high = {0};
    for (int corner = 0; corner < 3; corner++) {
        lanes p[3];
        load_corner(walk, words, count, corner, p);
        x[corner] = MT_RAY_SHEAR(p[0], p[2], walk->setup.float_shear[0]);
        y[corner] = MT_RAY_SHEAR(p[1], p[2], walk->setup.float_shear[1]);
    }
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        lanes edge = MT_RAY_EDGE(x[j], y[j], x[k], y[k]), margin = {0};
        if (with_margin) {
            float slack = walk->setup.slack;
            lanes size = {0}, part[4] = {x[j], y[j], x[k], y[k]};
            for (int m = 0; m < 4; m++) {
                lanes negative = -part[m];
                lanes_maximum(&negative, &part[m], &part[m]);
                size += part[m];
            }
            margin = slack * size + size * size * 0x1p-22f + 2 * slack * slack;
        }
        lanes least = edge - margin, most = edge + margin;
        if (i) {
            lanes_minimum(&most, &low, &low);
            lanes_maximum(&least, &high, &high);
        } else {
            low = most;
            high = least;
        }
    }
    lane_mask passes = (low >= 0) | (high <= 0);
    return lanes_bits(&passes);
}

/* The same operations as the hit function's, so that nothing is lost. */
MT_INLINE uint32_t filter_fast(const ray_walk *walk, const float *words, mt_index count)
{
    lanes direction[3], from_a[3], ab[3], ac[3], p[3], q[3], determinant, u, v, t;
    for (int i = 0; i < 3; i++) {
        lanes a;
        int axis = walk->setup.axes[i];
        lanes_load(words + (size_t)axis * count, &a);
        lanes_load(words + (size_t)(3 + axis) * count, &ab[i]);
        lanes_load(words + (size_t)(6 + axis) * count, &ac[i]);
        ab[i] = ab[i] - a;
        ac[i] = ac[i] - a;
        from_a[i] = walk->setup.float_origin[i] - a;
        direction[i] = walk->setup.float_direction[i] + (lanes){0};
    }
    MT_RAY_MOELLER_TRUMBORE(direction, from_a, ab, ac, p, q, determinant, u, v, t);
    (void)t;
    lane_mask turned = determinant < 0;
    lanes sign = (lanes)(turned & (lane_mask)((lanes){0} - 2.0f)) + 1.0f;
    u = u * sign;
    v = v * sign;
    determinant = determinant * sign;
    lane_mask passes = (determinant > 0) & (u >= 0) & (v >= 0) & (u + v <= determinant);
    return lanes_bits(&passes);
}

/* Asks the hit function of what passed the filter. Returns true when the walk is over. */
static bool decide_leaf(ray_walk *walk, const float *words, mt_index count, uint32_t bits)
{
    for (; bits; bits &= bits - 1) {
        mt_index lane = (mt_index)__builtin_ctz(bits), number;
        mt_ray_triangle triangle;
        mt_ray_hit hit;
        memcpy(&number, words + 9 * (size_t)count + lane, sizeof number);
        if (number >= walk->tree->numbering.wires) {
            continue;
        }
        if (walk->setup.profile == MT_RAY_EXACT) {
            mt_ray_triangle_load(&walk->tree->space, walk->tree->mesh, walk->tree->triangulation, number, MT_RAY_EXACT,
                                 &triangle);
        } else {
            for (mt_index i = 0; i < 9; i++) {
                triangle.corners[i / 3][i % 3] = (double)words[i * (size_t)count + lane];
            }
        }
        if (mt_ray_hit_triangle(&walk->setup, &triangle, number, &hit) && mt_ray_hit_is_nearer(&hit, &walk->best)) {
            walk->best = hit;
            walk->limit = parameter_above(&walk->setup, hit.t);
            if (walk->any) {
                return true;
            }
        }
    }
    return false;
}

MT_INLINE bool visit_leaf(ray_walk *walk, uint32_t child)
{
    mt_index count = mt_surface_leaf_count(child);
    const float *words =
        (const float *)(const void *)(walk->tree->words + (size_t)mt_surface_leaf_first(child) * MT_SURFACE_WORDS);
    uint32_t bits = 0;
    switch (walk->setup.profile) {
    case MT_RAY_WATERTIGHT:
        bits = filter_edges(walk, words, count, false);
        break;
    case MT_RAY_EXACT:
        bits = filter_edges(walk, words, count, true);
        break;
    case MT_RAY_FAST:
        bits = filter_fast(walk, words, count);
        break;
    }
    bits &= (1u << count) - 1;
    return bits && decide_leaf(walk, words, count, bits);
}

/* Pushes the children met, the nearest on top. */
MT_INLINE size_t push_children(const mt_surface_node *node, const lanes *near, uint32_t bits, pending *stack,
                               size_t depth)
{
    size_t bottom = depth;
    for (; bits; bits &= bits - 1) {
        int slot = __builtin_ctz(bits);
        pending item = {(*near)[slot], node->children[slot]};
        size_t at = depth++;
        for (; at > bottom && stack[at - 1].near < item.near; at--) {
            stack[at] = stack[at - 1];
        }
        stack[at] = item;
    }
    return depth;
}

MT_CLONES static void walk_tree(ray_walk *walk)
{
    pending stack[MT_SURFACE_STACK];
    size_t depth = 1;
    stack[0] = (pending){walk->begin, 0};
    while (depth) {
        pending item = stack[--depth];
        if (item.near > walk->limit) {
            continue;
        }
        if (item.child & MT_SURFACE_LEAF) {
            if (visit_leaf(walk, item.child)) {
                return;
            }
            continue;
        }
        const mt_surface_node *node = &walk->tree->nodes[item.child];
        lanes near;
        uint32_t bits = enter_children(walk, node, &near);
        depth = push_children(node, &near, bits, stack, depth);
    }
}

static bool shoot(const mt_surface_tree *tree, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    ray_walk walk;
    mt_ray_setup_init(&tree->space, ray, profile, &walk.setup);
    *hit = mt_ray_no_hit();
    if (!tree->node_count || !walk.setup.valid) {
        return false;
    }
    walk.tree = tree;
    walk.any = any;
    start_walk(&walk);
    walk_tree(&walk);
    *hit = walk.best;
    return hit->triangle != MT_NONE;
}

bool mt_surface_tree_nearest_hit(const mt_surface_tree *tree, const mt_ray *ray, mt_ray_profile profile,
                                 mt_ray_hit *hit)
{
    return shoot(tree, ray, profile, false, hit);
}

bool mt_surface_tree_any_hit(const mt_surface_tree *tree, const mt_ray *ray, mt_ray_profile profile)
{
    mt_ray_hit hit;
    return shoot(tree, ray, profile, true, &hit);
}
