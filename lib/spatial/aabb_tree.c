/* The tree's frame, the boxes of triangles, and the tree's invariants. Building is in aabb_build.c. */
#include "lib/spatial/aabb_build.h"

#include <string.h>

typedef struct boxing {
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    const uint8_t *skip;
    mt_vec3 center;
    double scale;
    boxed_primitive *primitives; /* one a triangle; number MT_NONE: left out */
} boxing;

static float round_down(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float round_up(double x)
{
    float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

static void cover_coordinate(mt_box *box, int axis, double x)
{
    float lower = round_down(x), upper = round_up(x);
    box->lower[axis] = lower < box->lower[axis] ? lower : box->lower[axis];
    box->upper[axis] = upper > box->upper[axis] ? upper : box->upper[axis];
}

static bool box_triangle(const boxing *job, mt_index triangle, mt_box *box)
{
    *box = (mt_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(job->triangulation, triangle, side);
        mt_vec3 p = mt_mesh_position(job->mesh, job->mesh->corner_vertices[corner]);
        if (!mt_vec3_is_finite(p)) {
            return false;
        }
        /* scaled before the subtraction, which could overflow */
        cover_coordinate(box, 0, p.x * job->scale - job->center.x);
        cover_coordinate(box, 1, p.y * job->scale - job->center.y);
        cover_coordinate(box, 2, p.z * job->scale - job->center.z);
    }
    return true;
}

static void box_triangles(void *user, uint64_t begin, uint64_t end)
{
    const boxing *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_index triangle = (mt_index)i;
        bool kept = !(job->skip && job->skip[triangle]);
        kept = kept && box_triangle(job, triangle, &job->primitives[i].box);
        job->primitives[i].number = kept ? triangle : MT_NONE;
    }
}

static void choose_frame(const mt_mesh *mesh, boxing *job)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    job->scale = 1;
    job->center = mt_vec3_make(0, 0, 0);
    if (bounds.finite_count) {
        double largest = fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum));
        double coarse = mt_power_of_two_scale(largest);
        mt_vec3 low = mt_vec3_scale(bounds.minimum, coarse), high = mt_vec3_scale(bounds.maximum, coarse);
        mt_vec3 middle = mt_vec3_scale(mt_vec3_add(low, high), 0.5);
        double fine = mt_power_of_two_scale(mt_vec3_max_abs(mt_vec3_subtract(high, low)));
        double both = coarse * fine;
        if (isfinite(both)) {
            job->scale = both;
            job->center = mt_vec3_scale(middle, fine);
        } else {
            job->scale = coarse;
            job->center = middle;
        }
    }
}

static mt_index drop_left_out(boxed_primitive *primitives, mt_index count)
{
    mt_index kept = 0;
    for (mt_index i = 0; i < count; i++) {
        if (primitives[i].number != MT_NONE) {
            primitives[kept++] = primitives[i];
        }
    }
    return kept;
}

typedef struct unpacking {
    const boxed_primitive *primitives;
    mt_aabb_tree *tree;
} unpacking;

static void unpack(void *user, uint64_t begin, uint64_t end)
{
    const unpacking *job = user;
    for (uint64_t i = begin; i < end; i++) {
        job->tree->primitives[i] = job->primitives[i].number;
        job->tree->boxes[i] = job->primitives[i].box;
    }
}

static mt_status fill_tree(mt_context *context, boxing *job, mt_aabb_tree *tree)
{
    mt_index count = job->triangulation->triangle_count;
    mt_parallel_for(context, count, 16384, box_triangles, job);
    tree->primitive_count = drop_left_out(job->primitives, count);
    tree->center = job->center;
    tree->scale = job->scale;
    tree->primitives = mt_allocate_array(context, tree->primitive_count, sizeof *tree->primitives);
    tree->boxes = mt_allocate_array(context, tree->primitive_count, sizeof *tree->boxes);
    if (!tree->primitives || !tree->boxes) {
        return mt_context_error(context)->status;
    }
    if (!tree->primitive_count) {
        return MT_OK;
    }
    mt_status status = mt_aabb_build(context, job->primitives, tree->primitive_count, tree);
    if (status == MT_OK) {
        unpacking copy = {job->primitives, tree};
        mt_parallel_for(context, tree->primitive_count, 65536, unpack, &copy);
    }
    return status;
}

mt_status mt_aabb_tree_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                              const uint8_t *skip, mt_aabb_tree **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "tree of boxes", "which triangles can meet");
    boxing job = {.mesh = mesh, .triangulation = triangulation, .skip = skip};
    choose_frame(mesh, &job);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    mt_aabb_tree *tree = mt_allocate_zeroed(context, sizeof *tree);
    job.primitives = mt_allocate_array(context, triangulation->triangle_count, sizeof *job.primitives);
    if (tree && job.primitives) {
        status = fill_tree(context, &job, tree);
    }
    mt_free(context, job.primitives);
    if (status == MT_OK) {
        *out = tree;
    } else {
        mt_aabb_tree_destroy(context, tree);
    }
    mt_part_end(context, part);
    return status;
}

void mt_aabb_tree_destroy(mt_context *context, mt_aabb_tree *tree)
{
    if (tree) {
        mt_free(context, tree->nodes);
        mt_free(context, tree->primitives);
        mt_free(context, tree->boxes);
        mt_free(context, tree);
    }
}

static bool box_contains(const mt_box *outer, const mt_box *inner)
{
    for (int axis = 0; axis < 3; axis++) {
        if (!(outer->lower[axis] <= inner->lower[axis] && inner->upper[axis] <= outer->upper[axis])) {
            return false;
        }
    }
    return true;
}

static mt_status check_leaf(mt_context *context, const mt_aabb_tree *tree, mt_index number, uint8_t *seen)
{
    const mt_aabb_node *node = &tree->nodes[number];
    if ((uint64_t)node->first + node->count > tree->primitive_count) {
        return mt_fail(context, MT_ERROR_INTERNAL, "leaf %u reaches past the primitives", number);
    }
    for (mt_index i = node->first; i < node->first + node->count; i++) {
        if (seen[i]++ || !box_contains(&node->box, &tree->boxes[i])) {
            return mt_fail(context, MT_ERROR_INTERNAL, "primitive place %u is in two leaves or out of its box", i);
        }
    }
    return MT_OK;
}

static mt_status check_inner(mt_context *context, const mt_aabb_tree *tree, mt_index number)
{
    const mt_aabb_node *node = &tree->nodes[number];
    if (node->first <= number || (uint64_t)node->first + 2 > tree->node_count) {
        return mt_fail(context, MT_ERROR_INTERNAL, "node %u has children at %u", number, node->first);
    }
    for (mt_index child = node->first; child < node->first + 2; child++) {
        if (!box_contains(&node->box, &tree->nodes[child].box)) {
            return mt_fail(context, MT_ERROR_INTERNAL, "node %u reaches out of its parent %u", child, number);
        }
    }
    return MT_OK;
}

mt_status mt_aabb_tree_validate(mt_context *context, const mt_aabb_tree *tree)
{
    uint8_t *seen = mt_allocate_zeroed(context, tree->primitive_count);
    mt_status status = seen ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (mt_index i = 0; status == MT_OK && i < tree->node_count; i++) {
        status = tree->nodes[i].count ? check_leaf(context, tree, i, seen) : check_inner(context, tree, i);
    }
    for (mt_index i = 0; status == MT_OK && i < tree->primitive_count; i++) {
        if (!seen[i]) {
            status = mt_fail(context, MT_ERROR_INTERNAL, "primitive place %u is in no leaf", i);
        }
    }
    mt_free(context, seen);
    return status;
}
