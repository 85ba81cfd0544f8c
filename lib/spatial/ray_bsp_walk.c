/* Rays through the BSP tree, front to back, by the cases of how a ray relates to a plane (Kaplan, "The Use of Spatial
 * Coherence in Ray Tracing", 1985): the ray stays on its side, or leaves it for the other, or comes from it. A ray
 * along the plane, of a component of +0 or -0, stays on its side, or visits both where it comes within what rounding
 * allows for; both sides always would ask a thousandfold of rays along an axis. Where a ray begins or ends on a plane,
 * the plane belongs to both sides.
 *
 * A hit lies in the leaf whose interval holds its parameter, give or take doubles, and its triangle is an entry of
 * every leaf within MT_RAY_NEARNESS: so the walk may end when what is left begins behind the best hit. */
#include "lib/spatial/ray_bsp.h"

/* Components that cross no plane: over the length of a ray amid the triangles they move by less than doubles round. */
#define STANDSTILL 0x1p-60

/* Triangles last asked, by the low bits of their places: those on both sides of planes come again and again. */
#define RECENT 16

typedef struct interval {
    double enter, leave;
    uint32_t node;
} interval;

typedef struct bsp_walk {
    double origin[3], reciprocal[3]; /* x y z; reciprocal 0: does not move */
    interval stack[MT_RAY_BSP_DEPTH + 1];
    size_t depth;
    mt_index recent[RECENT];
} bsp_walk;

static void start(const mt_ray_setup *setup, bsp_walk *walk)
{
    for (int i = 0; i < 3; i++) {
        bool is_moving = fabs(setup->direction[i]) > STANDSTILL;
        walk->origin[setup->axes[i]] = setup->origin[i];
        walk->reciprocal[setup->axes[i]] = is_moving ? 1 / setup->direction[i] : 0;
    }
    walk->depth = 0;
    memset(walk->recent, 0xff, sizeof walk->recent);
}

/* Goes on to the side where the ray comes first; the other waits. */
static void descend(const mt_ray_bsp_node *node, bsp_walk *walk, interval *here)
{
    unsigned axis = mt_ray_bsp_axis(node);
    uint32_t below = mt_ray_bsp_number(node);
    double plane = (double)node->plane, origin = walk->origin[axis], reciprocal = walk->reciprocal[axis];
    if (reciprocal == 0) {
        here->node = below + (origin > plane);
        if (fabs(origin - plane) <= MT_RAY_NEARNESS) {
            walk->stack[walk->depth++] = (interval){here->enter, here->leave, below + (origin <= plane)};
        }
        return;
    }
    double crossing = (plane - origin) * reciprocal;
    uint32_t first = below + (reciprocal < 0), second = below + (reciprocal > 0);
    here->node = crossing < here->enter ? second : first;
    if (crossing >= here->enter && crossing <= here->leave) {
        walk->stack[walk->depth++] = (interval){crossing, here->leave, second};
        here->leave = crossing;
    }
}

/* Returns true when the search is over. */
static bool try_leaf(const mt_ray_bsp *bsp, const mt_ray_bsp_node *leaf, bsp_walk *walk, mt_ray_search *search)
{
    const mt_index *entries = bsp->entries + leaf->first;
    for (uint32_t i = 0; i < mt_ray_bsp_number(leaf); i++) {
        mt_index at = entries[i];
        if (walk->recent[at % RECENT] != at) {
            walk->recent[at % RECENT] = at;
            if (mt_ray_search_try(search, at)) {
                return true;
            }
        }
    }
    return false;
}

static void walk_nodes(const mt_ray_bsp *bsp, interval here, mt_ray_search *search)
{
    bsp_walk walk;
    start(&search->setup, &walk);
    for (;;) {
        const mt_ray_bsp_node *node = &bsp->nodes[here.node];
        while (mt_ray_bsp_axis(node) != MT_RAY_BSP_LEAF) {
            descend(node, &walk, &here);
            node = &bsp->nodes[here.node];
        }
        if (try_leaf(bsp, node, &walk, search) || !walk.depth) {
            return;
        }
        here = walk.stack[--walk.depth];
        if (here.enter > search->limit) {
            return;
        }
    }
}

bool mt_ray_bsp_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    const mt_ray_bsp *bsp = body;
    mt_ray_search search;
    interval whole = {.node = 0};
    if (mt_ray_search_init(&bsp->triangles, ray, profile, any, &search) &&
        mt_ray_search_enter(&search, &whole.enter, &whole.leave)) {
        if (mt_ray_search_is_near(&search)) {
            walk_nodes(bsp, whole, &search);
        } else {
            mt_ray_search_try_all(&search);
        }
    }
    *hit = search.best;
    return hit->triangle != MT_NONE;
}
