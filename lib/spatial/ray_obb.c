/* The record of the hierarchy of oriented boxes, and its check. Building is in ray_obb_build.c, rays in
 * ray_obb_walk.c. */
#include "lib/spatial/ray_obb.h"

static mt_status create(mt_context *context, const mt_ray_source *source, void **body)
{
    mt_ray_obb *obb = mt_allocate_zeroed(context, sizeof *obb);
    *body = obb;
    if (!obb) {
        return mt_context_error(context)->status;
    }
    int part = mt_part_begin(context, "oriented boxes", "which triangles a ray is near, along their principal axes");
    mt_status status = mt_packed_triangles_init(context, source, &obb->triangles);
    if (status == MT_OK) {
        status = mt_ray_obb_build(context, obb);
    }
    mt_part_end(context, part);
    return status;
}

static void destroy(mt_context *context, void *body)
{
    mt_ray_obb *obb = body;
    mt_packed_triangles_release(context, &obb->triangles);
    mt_free(context, obb->nodes);
    mt_free(context, obb);
}

static uint64_t size(const void *body)
{
    const mt_ray_obb *obb = body;
    return sizeof *obb + mt_packed_triangles_size(&obb->triangles) + obb->node_count * sizeof *obb->nodes;
}

static bool box_holds(const mt_ray_obb *obb, const mt_ray_obb_node *node)
{
    for (mt_index at = node->first; at < node->first + node->count; at++) {
        for (int i = 0; i < 9; i++) {
            double x = mt_oriented_box_along(&node->box, i / 3, &obb->triangles.items[at], i % 3);
            if (!((double)node->box.lower[i / 3] <= x && x <= (double)node->box.upper[i / 3])) {
                return false;
            }
        }
    }
    return true;
}

/* Every child has one parent, which stands before it, and leaves share out the triangles. Boxes hold what is in the
 * leaves below them, which may reach out of each other: `lasts` and `firsts` gather ranges from the leaves up. */
static bool nodes_are_sound(const mt_ray_obb *obb, mt_index *firsts, mt_index *lasts)
{
    for (uint64_t i = obb->node_count; i-- > 0;) {
        mt_ray_obb_node node = obb->nodes[i];
        if (node.count) {
            firsts[i] = node.first;
            lasts[i] = node.first + node.count;
        } else if (node.first <= i || node.first + 1 >= obb->node_count ||
                   lasts[node.first] != firsts[node.first + 1]) {
            return false;
        } else {
            firsts[i] = firsts[node.first];
            lasts[i] = lasts[node.first + 1];
        }
        node.first = firsts[i];
        node.count = lasts[i] - firsts[i];
        if (lasts[i] > obb->triangles.count || !box_holds(obb, &node)) {
            return false;
        }
    }
    return !obb->node_count || (firsts[0] == 0 && lasts[0] == obb->triangles.count);
}

static mt_status validate(mt_context *context, const void *body)
{
    const mt_ray_obb *obb = body;
    mt_status status = mt_packed_triangles_validate(context, &obb->triangles);
    if (status != MT_OK) {
        return status;
    }
    mt_index *firsts = mt_allocate_array(context, obb->node_count, sizeof *firsts);
    mt_index *lasts = mt_allocate_array(context, obb->node_count, sizeof *lasts);
    status = MT_ERROR_OUT_OF_MEMORY;
    if (firsts && lasts) {
        status = nodes_are_sound(obb, firsts, lasts)
                     ? MT_OK
                     : mt_fail(context, MT_ERROR_INTERNAL, "an oriented box does not hold its triangles as it should");
    }
    mt_free(context, firsts);
    mt_free(context, lasts);
    return status;
}

const mt_ray_structure_record mt_ray_structure_obb = {"obb", create, destroy, validate, size, mt_ray_obb_find_hit};
