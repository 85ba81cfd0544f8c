/* The tree's frame, the boxes of triangles, and the tree's invariants. Building is in aabb_build.c. */
#include "lib/spatial/aabb_build.h"
#include "lib/spatial/box.h"

typedef struct boxing {
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    const uint8_t *skip;
    mt_vec3 center;
    double scale;
    mt_aabb_primitive *primitives; /* one a triangle; number MT_NONE: left out */
} boxing;

/* The float so many steps above, 1, 0 or -1. Rounding leaves zeros their sign, so that none is stepped over. Half of
 * all roundings go past x, at random, so nothing here may branch. */
static float step(float f, int32_t steps)
{
    int32_t bits;
    memcpy(&bits, &f, sizeof bits);
    bits += bits < 0 ? -steps : steps;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static float round_down(double x)
{
    float f = (float)x;
    return step(f, -((double)f > x));
}

static float round_up(double x)
{
    float f = (float)x;
    return step(f, (double)f < x);
}

static double smallest(const double x[3])
{
    double m = x[0] < x[1] ? x[0] : x[1];
    return m < x[2] ? m : x[2];
}

static double largest(const double x[3])
{
    double m = x[0] > x[1] ? x[0] : x[1];
    return m > x[2] ? m : x[2];
}

static bool box_triangle(const boxing *job, mt_index triangle, mt_aabb_primitive *primitive)
{
    double x[3][3]; /* by axis, then corner */
    double sum = 0;
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(job->triangulation, triangle, side);
        mt_vec3 p = mt_mesh_position(job->mesh, job->mesh->corner_vertices[corner]);
        /* scaled before the subtraction, which could overflow */
        x[0][side] = p.x * job->scale - job->center.x;
        x[1][side] = p.y * job->scale - job->center.y;
        x[2][side] = p.z * job->scale - job->center.z;
        sum += x[0][side] + x[1][side] + x[2][side];
    }
    for (int axis = 0; axis < 3; axis++) {
        primitive->lower[axis] = round_down(smallest(x[axis]));
        primitive->upper[axis] = round_up(largest(x[axis]));
    }
    return isfinite(sum); /* the frame keeps finite points within 2 of the origin */
}

static void box_triangles(void *user, uint64_t begin, uint64_t end)
{
    const boxing *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_index triangle = (mt_index)i;
        bool kept = !(job->skip && job->skip[triangle]);
        kept = kept && box_triangle(job, triangle, &job->primitives[i]);
        job->primitives[i].number = kept ? triangle : MT_NONE;
        job->primitives[i].face = mt_triangulation_face(job->triangulation, triangle);
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

static mt_index drop_left_out(mt_aabb_primitive *primitives, mt_index count)
{
    mt_index kept = 0;
    for (mt_index i = 0; i < count; i++) {
        if (primitives[i].number != MT_NONE) {
            primitives[kept++] = primitives[i];
        }
    }
    return kept;
}

static mt_status fill_tree(mt_context *context, boxing *job, mt_aabb_tree *tree)
{
    mt_index count = job->triangulation->triangle_count;
    tree->primitives = mt_allocate_array(context, count, sizeof *tree->primitives);
    if (!tree->primitives) {
        return mt_context_error(context)->status;
    }
    job->primitives = tree->primitives;
    mt_parallel_for(context, count, 16384, box_triangles, job);
    tree->primitive_count = drop_left_out(tree->primitives, count);
    tree->center = job->center;
    tree->scale = job->scale;
    return tree->primitive_count ? mt_aabb_build(context, tree) : MT_OK;
}

mt_status mt_aabb_tree_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                              const uint8_t *skip, mt_aabb_tree **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "tree of boxes", "which triangles can meet");
    boxing job = {.mesh = mesh, .triangulation = triangulation, .skip = skip};
    choose_frame(mesh, &job);
    mt_aabb_tree *tree = mt_allocate_zeroed(context, sizeof *tree);
    mt_status status = tree ? fill_tree(context, &job, tree) : MT_ERROR_OUT_OF_MEMORY;
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
        mt_free(context, tree);
    }
}

static bool box_contains(const void *outer_record, const void *inner_record)
{
    box outer = box_load(outer_record), inner = box_load(inner_record);
    for (int axis = 0; axis < 3; axis++) {
        if (!(outer.lower[axis] <= inner.lower[axis] && inner.upper[axis] <= outer.upper[axis])) {
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
        if (seen[i]++ || !box_contains(node, &tree->primitives[i])) {
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
        if (!box_contains(node, &tree->nodes[child])) {
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
