/* Making, freeing and checking the tree. Building is in surface_build.c, rays in surface_rays.c. */
#include <meshtool/surface_tree.h>

#include "lib/spatial/box.h"
#include "lib/spatial/surface_tree.h"

static mt_status fill_tree(mt_context *context, mt_surface_tree *tree)
{
    mt_surface_box *boxes = NULL;
    mt_status status = mt_surface_boxes_create(context, tree, &boxes);
    if (status == MT_OK && tree->count) {
        status = mt_surface_build(context, tree, boxes);
    }
    mt_free(context, boxes);
    return status;
}

mt_status mt_surface_tree_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                 const mt_surface_tree_options *options, mt_surface_tree **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "surface tree", "which triangles a ray or a point is near");
    mt_surface_tree *tree = mt_allocate_zeroed(context, sizeof *tree);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (tree) {
        tree->mesh = mesh;
        tree->triangulation = triangulation;
        tree->elements = options && options->elements ? options->elements : MT_SURFACE_TRIANGLES;
        tree->quality = options ? options->quality : MT_BUILD_BALANCED;
        tree->numbering = mt_surface_number(mesh, triangulation);
        tree->space = mt_ray_space_of(mesh);
        status = fill_tree(context, tree);
    }
    if (status == MT_OK) {
        *out = tree;
    } else {
        mt_surface_tree_destroy(context, tree);
    }
    mt_part_end(context, part);
    return status;
}

void mt_surface_tree_destroy(mt_context *context, mt_surface_tree *tree)
{
    if (tree) {
        mt_free(context, tree->nodes);
        mt_free(context, tree->words);
        mt_free(context, tree);
    }
}

const mt_ray_space *mt_surface_tree_space(const mt_surface_tree *tree)
{
    return &tree->space;
}

mt_index mt_surface_tree_count(const mt_surface_tree *tree)
{
    return tree->count;
}

mt_index mt_surface_tree_left_out(const mt_surface_tree *tree)
{
    return tree->left_out;
}

uint64_t mt_surface_tree_size(const mt_surface_tree *tree)
{
    uint64_t words = tree->count ? (uint64_t)tree->count * MT_SURFACE_WORDS + MT_WIDTH : 0;
    return sizeof *tree + tree->node_count * (uint64_t)sizeof *tree->nodes + words * sizeof *tree->words;
}

typedef struct checking {
    const mt_surface_tree *tree;
    uint8_t *seen; /* per element number */
    mt_index seen_count;
} checking;

static box child_box(const mt_surface_node *node, int slot)
{
    box b = box_empty();
    for (int axis = 0; axis < 3; axis++) {
        b.lower[axis] = node->planes[2 * axis][slot];
        b.upper[axis] = node->planes[2 * axis + 1][slot];
    }
    return b;
}

static bool box_contains(const box *outer, const box *inner)
{
    bool contains = true;
    for (int axis = 0; axis < 3; axis++) {
        contains &= outer->lower[axis] <= inner->lower[axis] && inner->upper[axis] <= outer->upper[axis];
    }
    return contains;
}

static bool leaf_is_sound(checking *check, uint32_t child, const box *bounds)
{
    mt_index first = mt_surface_leaf_first(child), count = mt_surface_leaf_count(child);
    if ((uint64_t)first + count > check->tree->count) {
        return false;
    }
    const uint32_t *words = check->tree->words + (size_t)first * MT_SURFACE_WORDS;
    for (mt_index i = 0; i < count; i++) {
        mt_index number = words[9 * count + i];
        if (number >= check->tree->numbering.end || check->seen[number]++) {
            return false;
        }
        for (mt_index coordinate = 0; coordinate < 9; coordinate++) {
            float x;
            memcpy(&x, words + coordinate * count + i, sizeof x);
            if (!(bounds->lower[coordinate % 3] <= x && x <= bounds->upper[coordinate % 3])) {
                return false;
            }
        }
    }
    check->seen_count += count;
    return true;
}

/* Children stand behind their parents, each once: a walk in the order of the nodes sees parents first. */
static bool node_is_sound(checking *check, mt_index number, box *bounds)
{
    const mt_surface_node *node = &check->tree->nodes[number];
    for (int slot = 0; slot < MT_WIDTH; slot++) {
        box own = child_box(node, slot);
        uint32_t child = node->children[slot];
        if (own.lower[0] > own.upper[0]) {
            continue;
        }
        if (!box_contains(&bounds[number], &own)) {
            return false;
        }
        if (child & MT_SURFACE_LEAF) {
            if (!leaf_is_sound(check, child, &own)) {
                return false;
            }
        } else if (child <= number || child >= check->tree->node_count) {
            return false;
        } else {
            bounds[child] = own;
        }
    }
    return true;
}

static bool tree_is_sound(checking *check, box *bounds)
{
    bounds[0] = box_empty();
    for (int axis = 0; axis < 3; axis++) {
        bounds[0].lower[axis] = -INFINITY;
        bounds[0].upper[axis] = INFINITY;
    }
    for (mt_index number = 0; number < check->tree->node_count; number++) {
        if (!node_is_sound(check, number, bounds)) {
            return false;
        }
    }
    return check->seen_count == check->tree->count;
}

mt_status mt_surface_tree_validate(mt_context *context, const mt_surface_tree *tree)
{
    checking check = {.tree = tree};
    check.seen = mt_allocate_array_zeroed(context, tree->numbering.end, 1);
    box *bounds = mt_allocate_array(context, (uint64_t)tree->node_count + 1, sizeof *bounds);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (check.seen && bounds) {
        status = tree_is_sound(&check, bounds)
                     ? MT_OK
                     : mt_fail(context, MT_ERROR_INTERNAL, "the surface tree does not hold its elements as it should");
    }
    mt_free(context, bounds);
    mt_free(context, check.seen);
    return status;
}
