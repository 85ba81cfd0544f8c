/* Rays through the tree: nodes front to back, culled only behind the best t; leaves filtered eight triangles at a time
 * in float, and what passes is asked of mt_ray_hit_triangle, so that the answer is that of brute force.
 *
 * Boxes: the slabs of Kay and Kajiya with the reciprocal of the direction. Zero components give infinite slabs, or NaN
 * where a plane goes through the origin, which the order of minimum and maximum drops: inside. Each plane is moved
 * outwards by what the triangle test can be off and what this test rounds (after Ize 2013, here added to the origin
 * instead of multiplied to the distance, which costs nothing in the loop). */
#include <meshtool/surface_tree.h>

#include "lib/spatial/ray_formulas.h"
#include "lib/spatial/surface_walk.h"

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

/* A parameter in space not below that of t, as a float. */
static float parameter_above(const mt_ray_setup *setup, double t)
{
    double parameter = t * setup->parameter_factor - setup->begin;
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
        walk->reciprocal[axis] = 1 / setup->float_direction[i];
    }
    double begin = setup->t_minimum * setup->parameter_factor - setup->begin;
    begin -= fabs(begin) * 0x1p-22;
    walk->begin = setup->begin > 0 && begin < 0 ? 0 : (float)begin;
    walk->limit = parameter_above(setup, setup->t_maximum);
    walk->best = mt_ray_no_hit();
}

/* Where the ray enters each child; returns the bits of those that it meets. A NaN leaves the other operand. */
MT_INLINE uint32_t enter_children(const ray_walk *walk, const mt_surface_node *node, float near[MT_WIDTH])
{
    const float *nx = node->planes[walk->near_planes[0]], *fx = node->planes[walk->far_planes[0]];
    const float *ny = node->planes[walk->near_planes[1]], *fy = node->planes[walk->far_planes[1]];
    const float *nz = node->planes[walk->near_planes[2]], *fz = node->planes[walk->far_planes[2]];
    const float nox = walk->near_origin[0], noy = walk->near_origin[1], noz = walk->near_origin[2];
    const float fox = walk->far_origin[0], foy = walk->far_origin[1], foz = walk->far_origin[2];
    const float rx = walk->reciprocal[0], ry = walk->reciprocal[1], rz = walk->reciprocal[2];
    const float begin = walk->begin, limit = walk->limit;
    int32_t passes[MT_WIDTH];
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float x = (nx[lane] - nox) * rx, y = (ny[lane] - noy) * ry, z = (nz[lane] - noz) * rz;
        float enters = x > begin ? x : begin;
        enters = y > enters ? y : enters;
        enters = z > enters ? z : enters;
        x = (fx[lane] - fox) * rx, y = (fy[lane] - foy) * ry, z = (fz[lane] - foz) * rz;
        float leaves = x < limit ? x : limit;
        leaves = y < leaves ? y : leaves;
        leaves = z < leaves ? z : leaves;
        near[lane] = enters;
        passes[lane] = enters <= leaves ? -1 : 0;
    }
    return mt_bits_of(passes);
}

/* The same coordinate of a leaf's corners, in the order of the ray's axes. */
typedef struct leaf_view {
    const float *corners[3][3];
} leaf_view;

MT_INLINE leaf_view view_leaf(const ray_walk *walk, const float *rows, mt_index count)
{
    leaf_view view;
    for (int corner = 0; corner < 3; corner++) {
        for (int i = 0; i < 3; i++) {
            view.corners[corner][i] = rows + (size_t)(3 * corner + walk->setup.axes[i]) * count;
        }
    }
    return view;
}

/* Edge functions of the sheared corners. Without a margin their signs are right or zero; the margin, a multiple of the
 * slack, allows for what rounding took from vertices, origin and shear. */
MT_INLINE uint32_t filter_edges(const ray_walk *walk, const leaf_view *view, bool has_margin)
{
    const float ox = walk->setup.float_origin[0], oy = walk->setup.float_origin[1], oz = walk->setup.float_origin[2];
    const float sx = walk->setup.float_shear[0], sy = walk->setup.float_shear[1], slack = walk->setup.slack;
    int32_t passes[MT_WIDTH];
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float az = view->corners[0][2][lane] - oz, bz = view->corners[1][2][lane] - oz,
              cz = view->corners[2][2][lane] - oz;
        float ax = MT_RAY_SHEAR(view->corners[0][0][lane] - ox, az, sx);
        float ay = MT_RAY_SHEAR(view->corners[0][1][lane] - oy, az, sy);
        float bx = MT_RAY_SHEAR(view->corners[1][0][lane] - ox, bz, sx);
        float by = MT_RAY_SHEAR(view->corners[1][1][lane] - oy, bz, sy);
        float cx = MT_RAY_SHEAR(view->corners[2][0][lane] - ox, cz, sx);
        float cy = MT_RAY_SHEAR(view->corners[2][1][lane] - oy, cz, sy);
        float u = MT_RAY_EDGE(bx, by, cx, cy), v = MT_RAY_EDGE(cx, cy, ax, ay), w = MT_RAY_EDGE(ax, ay, bx, by);
        float low = u < v ? u : v, high = u > v ? u : v;
        low = w < low ? w : low;
        high = w > high ? w : high;
        if (!has_margin) {
            passes[lane] = ((low >= 0) | (high <= 0)) ? -1 : 0;
            continue;
        }
        float size = fabsf(ax) + fabsf(ay) + fabsf(bx) + fabsf(by) + fabsf(cx) + fabsf(cy);
        float margin = slack * (size + slack) * 2;
        bool is_met = (low >= -margin) | (high <= margin);
        passes[lane] = is_met ? -1 : 0;
    }
    return mt_bits_of(passes);
}

/* The same operations as the hit function's, so that nothing is lost. */
MT_INLINE uint32_t filter_fast(const ray_walk *walk, const leaf_view *view)
{
    int32_t passes[MT_WIDTH];
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float from_a[3], ab[3], ac[3], p[3], q[3], determinant, u, v, t;
        for (int i = 0; i < 3; i++) {
            float a = view->corners[0][i][lane];
            ab[i] = view->corners[1][i][lane] - a;
            ac[i] = view->corners[2][i][lane] - a;
            from_a[i] = walk->setup.float_origin[i] - a;
        }
        MT_RAY_MOELLER_TRUMBORE(walk->setup.float_direction, from_a, ab, ac, p, q, determinant, u, v, t);
        (void)t;
        float sign = determinant < 0 ? -1.0f : 1.0f;
        u *= sign, v *= sign, determinant *= sign;
        bool is_met = (determinant > 0) & (u >= 0) & (v >= 0) & (u + v <= determinant);
        passes[lane] = is_met ? -1 : 0;
    }
    return mt_bits_of(passes);
}

/* Asks the hit function of what passed the filter. Returns true when the walk is over. */
static bool decide_leaf(ray_walk *walk, const float *rows, mt_index count, uint32_t bits)
{
    for (; bits; bits &= bits - 1) {
        mt_index lane = (mt_index)__builtin_ctz(bits), number = mt_leaf_number(rows, count, lane);
        mt_ray_triangle triangle;
        mt_ray_hit hit;
        if (number >= walk->tree->numbering.wires) {
            continue;
        }
        if (walk->setup.profile == MT_RAY_EXACT) {
            mt_ray_triangle_load(&walk->tree->space, walk->tree->mesh, walk->tree->triangulation, number, MT_RAY_EXACT,
                                 &triangle);
        } else {
            for (mt_index i = 0; i < 9; i++) {
                triangle.corners[i / 3][i % 3] = (double)rows[i * (size_t)count + lane];
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
    const float *rows = mt_leaf_rows(walk->tree, child);
    const leaf_view view = view_leaf(walk, rows, count);
    uint32_t bits = 0;
    switch (walk->setup.profile) {
    case MT_RAY_WATERTIGHT:
        bits = filter_edges(walk, &view, false);
        break;
    case MT_RAY_EXACT:
        bits = filter_edges(walk, &view, true);
        break;
    case MT_RAY_FAST:
        bits = filter_fast(walk, &view);
        break;
    }
    bits &= (1u << count) - 1;
    return bits && decide_leaf(walk, rows, count, bits);
}

/* While the nearest child is looked at, its brother comes from memory. */
MT_INLINE void prefetch_child(const mt_surface_tree *tree, uint32_t child)
{
    bool is_leaf = child & MT_SURFACE_LEAF;
    const void *leaf = tree->words + (size_t)mt_surface_leaf_first(child) * MT_SURFACE_WORDS;
    const char *at = is_leaf ? leaf : (const void *)(tree->nodes + (is_leaf ? 0 : child));
    __builtin_prefetch(at);
    __builtin_prefetch(at + 64);
    __builtin_prefetch(at + 128);
}

/* Descends to the nearest child met and leaves the others on the stack; MT_SURFACE_UNUSED: none was met. Two children
 * are the most frequent case that is not plain, and ordered without a branch. */
MT_INLINE uint32_t descend(const ray_walk *walk, uint32_t child, mt_pending *stack, size_t *depth)
{
    float near[MT_WIDTH];
    const mt_surface_node *node = &walk->tree->nodes[child];
    uint32_t bits = enter_children(walk, node, near);
    if (!bits) {
        return MT_SURFACE_UNUSED;
    }
    uint32_t others = bits & (bits - 1);
    if (!others) {
        return node->children[__builtin_ctz(bits)];
    }
    if (!(others & (others - 1))) {
        mt_pending a = mt_pending_first(node, near, bits), b = mt_pending_first(node, near, others);
        mt_pending far = a < b ? b : a;
        stack[(*depth)++] = far;
        prefetch_child(walk->tree, mt_pending_child(far));
        return mt_pending_child(a < b ? a : b);
    }
    *depth = mt_push_children(node, near, bits, stack, *depth);
    prefetch_child(walk->tree, mt_pending_child(stack[*depth - 2]));
    return mt_pending_child(stack[--*depth]);
}

MT_CLONES static void walk_tree(ray_walk *walk)
{
    mt_pending stack[MT_SURFACE_STACK];
    size_t depth = 0;
    uint32_t child = 0;
    for (;;) {
        while (!(child & MT_SURFACE_LEAF)) {
            child = descend(walk, child, stack, &depth);
        }
        if (child != MT_SURFACE_UNUSED && visit_leaf(walk, child)) {
            return;
        }
        do {
            if (!depth) {
                return;
            }
            depth--;
        } while (mt_pending_near(stack[depth]) > walk->limit);
        child = mt_pending_child(stack[depth]);
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
