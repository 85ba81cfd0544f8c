/* Faces around a vertex of many corners, as at the tip of a fine cone, sorted by where their unit normals lie (Morton
 * order), leaf by leaf of eight under a tree of boxes with sums. A corner takes a node whole, drops it or descends, by
 * the bounds of its dot product with the node's box; where these cannot tell for sure it comes to single faces, which
 * are decided as pairs are: so who belongs to the sum does not depend on the tree. */
#include "lib/algorithms/normals_crease.h"

#define LEAF 8

/* More than the rounding of a dot product of unit vectors, and of its bounds. Larger: more nodes are opened; smaller: a
 * node could be taken whole whose faces would not be one by one. */
#define DOT_ERROR 0x1p-48

/* Nodes in the order of a heap: 1 is the root, i has the children 2i and 2i + 1; leaf number l is node leaf_count + l.
 */
typedef struct crease_tree {
    mt_crease_star *star;
    const mt_sort_entry *entries;
    mt_index count, leaf_count; /* a power of two */
} crease_tree;

/* 21 bits with two zeros after each. */
static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

static uint64_t morton_key(mt_vec3 unit)
{
    const double scale = 0x1p20 - 1;
    uint64_t x = (uint64_t)((unit.x + 1) * scale), y = (uint64_t)((unit.y + 1) * scale),
             z = (uint64_t)((unit.z + 1) * scale);
    return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

static mt_vec3 least(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
}

static mt_vec3 greatest(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
}

static const mt_crease_node empty_node = {{2, 2, 2}, {-2, -2, -2}, {{0, 0, 0}, 0}};

static mt_crease_node make_leaf(const crease_tree *tree, mt_index leaf)
{
    mt_crease_node node = empty_node;
    for (mt_index i = leaf * LEAF; i < tree->count && i < (leaf + 1) * LEAF; i++) {
        const mt_crease_corner *corner = &tree->star->corners[tree->entries[i].index];
        node.low = least(node.low, corner->unit);
        node.high = greatest(node.high, corner->unit);
        mt_add_term(&node.sum, corner->term);
    }
    return node;
}

static void build(const crease_tree *tree)
{
    mt_crease_node *nodes = tree->star->nodes;
    for (mt_index leaf = 0; leaf < tree->leaf_count; leaf++) {
        nodes[tree->leaf_count + leaf] = make_leaf(tree, leaf);
    }
    for (mt_index i = tree->leaf_count; i-- > 1;) {
        const mt_crease_node *left = &nodes[2 * i], *right = left + 1;
        nodes[i] = (mt_crease_node){least(left->low, right->low), greatest(left->high, right->high), left->sum};
        mt_add_term(&nodes[i].sum, right->sum);
    }
}

static void add_leaf(const crease_tree *tree, mt_index leaf, mt_vec3 unit, mt_scaled_vector *sum)
{
    for (mt_index i = leaf * LEAF; i < tree->count && i < (leaf + 1) * LEAF; i++) {
        const mt_crease_corner *corner = &tree->star->corners[tree->entries[i].index];
        if (mt_symmetric_dot(unit, corner->unit) > tree->star->limit) {
            mt_add_term(sum, corner->term);
        }
    }
}

/* The least and the greatest dot product of a unit vector with any within a box. */
static void bound_dot(const mt_crease_node *node, mt_vec3 unit, double *low, double *high)
{
    mt_vec3 a = mt_vec3_make(unit.x * node->low.x, unit.y * node->low.y, unit.z * node->low.z);
    mt_vec3 b = mt_vec3_make(unit.x * node->high.x, unit.y * node->high.y, unit.z * node->high.z);
    mt_vec3 lows = least(a, b), highs = greatest(a, b);
    *low = lows.x + lows.y + lows.z - DOT_ERROR;
    *high = highs.x + highs.y + highs.z + DOT_ERROR;
}

static mt_vec3 query(const crease_tree *tree, const mt_crease_corner *own)
{
    mt_index stack[64], top = 0;
    mt_scaled_vector sum = {{0, 0, 0}, 0};
    double limit = tree->star->limit, low, high;
    if (!(mt_symmetric_dot(own->unit, own->unit) > limit)) {
        sum = own->term;
    }
    stack[top++] = 1;
    while (top > 0) {
        mt_index i = stack[--top];
        const mt_crease_node *node = &tree->star->nodes[i];
        if (node->low.x > node->high.x) {
            continue; /* holds none */
        }
        bound_dot(node, own->unit, &low, &high);
        if (low > limit) {
            mt_add_term(&sum, node->sum);
        } else if (high > limit && i >= tree->leaf_count) {
            add_leaf(tree, i - tree->leaf_count, own->unit, &sum);
        } else if (high > limit) {
            stack[top++] = 2 * i + 1;
            stack[top++] = 2 * i;
        }
    }
    return mt_unit_vector(sum.vector);
}

void mt_crease_sum_many(mt_crease_star *star, mt_sort_entry *entries, mt_index count)
{
    for (mt_index i = 0; i < count; i++) {
        entries[i].key = morton_key(star->corners[entries[i].index].unit);
    }
    mt_sort_entries(entries, star->spare, count);
    crease_tree tree = {star, entries, count, 1};
    while ((uint64_t)tree.leaf_count * LEAF < count) {
        tree.leaf_count *= 2;
    }
    build(&tree);
    for (mt_index i = 0; i < count; i++) {
        mt_crease_corner *own = &star->corners[entries[i].index];
        own->normal = query(&tree, own);
    }
}
