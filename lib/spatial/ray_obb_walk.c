/* Rays through the hierarchy of oriented boxes, the nearer child first, culled only behind the best t.
 *
 * A ray is turned into a box's axes, in float, and meets its slabs by the IEEE rules: a component of 0 gives infinite
 * slabs, or NaN where a plane goes through the origin, which the order of comparisons drops: inside. Slabs are widened
 * by BOX_SLACK times the ray's slack, which is 8 units of 2^-24 of the reach and holds every point that is hit off the
 * ray on two axes, so by 1.42 times that along a turned one. To it come, in units of 2^-24 of the reach: 5.2 for the
 * origin's product with an axis (three roundings each, and the axis' sum of components is at most the root of 3), 9 for
 * the direction's along the ray's length, 5.3 for difference, reciprocal and product of the slab, 0.9 for the corners
 * of the exact profile: 4 times the slack in all. */
#include "lib/spatial/ray_obb.h"

#define BOX_SLACK 5.0f

typedef struct pending {
    float near;
    uint32_t node;
} pending;

typedef struct obb_walk {
    const mt_ray_obb *obb;
    float4 origin[3], direction[3]; /* x y z, each in all lanes */
    float4 slack;
    float begin;
    mt_ray_search *search;
} obb_walk;

static float4 all_lanes(float x)
{
    return (float4){x, x, x, x};
}

static void start(mt_ray_search *search, const mt_ray_obb *obb, obb_walk *walk)
{
    const mt_ray_setup *setup = &search->setup;
    for (int i = 0; i < 3; i++) {
        walk->origin[setup->axes[i]] = all_lanes(setup->float_origin[i]);
        walk->direction[setup->axes[i]] = all_lanes(setup->float_direction[i]);
    }
    walk->obb = obb;
    walk->search = search;
    walk->slack = all_lanes(BOX_SLACK * setup->slack);
    walk->begin = (float)(search->begin - fabs(search->begin) * 0x1p-22);
}

/* A float not below the limit. */
static float limit_of(const mt_ray_search *search)
{
    return (float)(search->limit + fabs(search->limit) * 0x1p-22);
}

/* Where the ray enters the box; false: it does not, or behind the limit. */
static bool enter(const obb_walk *walk, const mt_oriented_box *frame, float limit, float *near)
{
    float4 columns[3], lower, upper;
    memcpy(columns, frame->columns, sizeof columns);
    memcpy(&lower, frame->lower, sizeof lower);
    memcpy(&upper, frame->upper, sizeof upper);
    float4 origin = columns[0] * walk->origin[0] + columns[1] * walk->origin[1] + columns[2] * walk->origin[2];
    float4 direction =
        columns[0] * walk->direction[0] + columns[1] * walk->direction[1] + columns[2] * walk->direction[2];
    float4 reciprocal = 1.0f / direction;
    const int4 backward = (int4)direction < 0;
    float4 low = lower - walk->slack - origin, high = upper + walk->slack - origin;
    float4 enters = (float4)(((int4)high & backward) | ((int4)low & ~backward)) * reciprocal;
    float4 leaves = (float4)(((int4)low & backward) | ((int4)high & ~backward)) * reciprocal;
    float first = walk->begin, last = limit;
    for (int axis = 0; axis < 3; axis++) {
        first = enters[axis] > first ? enters[axis] : first;
        last = leaves[axis] < last ? leaves[axis] : last;
    }
    *near = first;
    return first <= last;
}

/* Returns true when the search is over. */
static bool try_leaf(const obb_walk *walk, const mt_ray_obb_node *leaf)
{
    for (uint32_t i = 0; i < leaf->count; i++) {
        if (mt_ray_search_try(walk->search, leaf->first + i)) {
            return true;
        }
    }
    return false;
}

/* Pushes the children that the ray meets, the nearer one last; returns the new depth. */
static size_t push_children(const obb_walk *walk, const mt_ray_obb_node *node, float limit, pending *stack,
                            size_t depth)
{
    const mt_ray_obb_node *children = &walk->obb->nodes[node->first];
    float near[2];
    bool is_met[2];
    for (int i = 0; i < 2; i++) {
        is_met[i] = enter(walk, &children[i].box, limit, &near[i]);
    }
    int nearer = near[1] < near[0], farther = !nearer;
    if (is_met[farther]) {
        stack[depth++] = (pending){near[farther], node->first + (uint32_t)farther};
    }
    if (is_met[nearer]) {
        stack[depth++] = (pending){near[nearer], node->first + (uint32_t)nearer};
    }
    return depth;
}

static void walk_boxes(const obb_walk *walk)
{
    pending stack[MT_RAY_OBB_DEPTH + 2];
    size_t depth = 0;
    float limit = limit_of(walk->search), near;
    if (enter(walk, &walk->obb->nodes[0].box, limit, &near)) {
        stack[depth++] = (pending){near, 0};
    }
    while (depth) {
        pending next = stack[--depth];
        if (next.near > limit) {
            continue;
        }
        const mt_ray_obb_node *node = &walk->obb->nodes[next.node];
        if (!node->count) {
            depth = push_children(walk, node, limit, stack, depth);
        } else if (try_leaf(walk, node)) {
            return;
        } else {
            limit = limit_of(walk->search);
        }
    }
}

bool mt_ray_obb_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    const mt_ray_obb *obb = body;
    mt_ray_search search;
    obb_walk walk;
    if (mt_ray_search_init(&obb->triangles, ray, profile, any, &search)) {
        start(&search, obb, &walk);
        walk_boxes(&walk);
    }
    *hit = search.best;
    return hit->triangle != MT_NONE;
}
