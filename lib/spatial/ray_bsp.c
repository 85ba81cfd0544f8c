/* The record of the BSP tree, and its check. Building is in ray_bsp_build.c, rays in ray_bsp_walk.c. */
#include "lib/spatial/ray_bsp.h"

static mt_status create(mt_context *context, const mt_ray_source *source, void **body)
{
    mt_ray_bsp *bsp = mt_allocate_zeroed(context, sizeof *bsp);
    *body = bsp;
    if (!bsp) {
        return mt_context_error(context)->status;
    }
    int part = mt_part_begin(context, "BSP tree", "which triangles are in the parts of space that a ray goes through");
    mt_status status = mt_packed_triangles_init(context, source, &bsp->triangles);
    if (status == MT_OK) {
        status = mt_ray_bsp_build(context, bsp);
    }
    mt_part_end(context, part);
    return status;
}

static void destroy(mt_context *context, void *body)
{
    mt_ray_bsp *bsp = body;
    mt_packed_triangles_release(context, &bsp->triangles);
    mt_free(context, bsp->nodes);
    mt_free(context, bsp->entries);
    mt_free(context, bsp);
}

static uint64_t size(const void *body)
{
    const mt_ray_bsp *bsp = body;
    return sizeof *bsp + mt_packed_triangles_size(&bsp->triangles) + bsp->node_count * sizeof *bsp->nodes +
           bsp->entry_count * sizeof *bsp->entries;
}

/* Every child has one parent, which stands before it; the leaves share out the entries. */
static bool nodes_are_sound(const mt_ray_bsp *bsp, uint8_t *parents)
{
    uint64_t entry_count = 0;
    for (uint64_t i = 0; i < bsp->node_count; i++) {
        const mt_ray_bsp_node *node = &bsp->nodes[i];
        uint64_t number = mt_ray_bsp_number(node);
        if (parents[i] != (i > 0)) {
            return false;
        }
        if (mt_ray_bsp_axis(node) != MT_RAY_BSP_LEAF) {
            if (number <= i || number + 1 >= bsp->node_count) {
                return false;
            }
            parents[number]++, parents[number + 1]++;
            continue;
        }
        if (node->first + number > bsp->entry_count) {
            return false;
        }
        entry_count += number;
        if (!mt_places_are_rising(bsp->entries + node->first, number, bsp->triangles.count)) {
            return false;
        }
    }
    return entry_count == bsp->entry_count;
}

/* Points of the triangle lie in leaves that hold it. */
static bool is_entered(const mt_ray_bsp *bsp, mt_index at)
{
    double point[3];
    for (int sample = 0; sample < MT_PACKED_SAMPLES; sample++) {
        mt_packed_triangle_sample(&bsp->triangles.items[at], sample, point);
        const mt_ray_bsp_node *node = bsp->nodes;
        while (mt_ray_bsp_axis(node) != MT_RAY_BSP_LEAF) {
            node = &bsp->nodes[mt_ray_bsp_number(node) + (point[mt_ray_bsp_axis(node)] > (double)node->plane)];
        }
        if (!mt_places_hold(bsp->entries + node->first, mt_ray_bsp_number(node), at)) {
            return false;
        }
    }
    return true;
}

static mt_status validate(mt_context *context, const void *body)
{
    const mt_ray_bsp *bsp = body;
    mt_status status = mt_packed_triangles_validate(context, &bsp->triangles);
    if (status != MT_OK) {
        return status;
    }
    uint8_t *parents = mt_allocate_array_zeroed(context, bsp->node_count, 1);
    if (!parents) {
        return mt_context_error(context)->status;
    }
    bool is_sound = nodes_are_sound(bsp, parents);
    for (mt_index at = 0; at < bsp->triangles.count && is_sound; at++) {
        is_sound = is_entered(bsp, at);
    }
    mt_free(context, parents);
    return is_sound ? MT_OK
                    : mt_fail(context, MT_ERROR_INTERNAL, "the BSP tree does not hold its triangles as it should");
}

const mt_ray_structure_record mt_ray_structure_bsp = {"bsp", create, destroy, validate, size, mt_ray_bsp_find_hit};
