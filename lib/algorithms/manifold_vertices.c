/* Vertices with a NaN or infinite coordinate, and the bounds of what faces name. Vertices in no face are left out of
 * the bounds: one far away would cost the volume its digits.
 *
 * Cost: O(vertices) time; a byte a vertex when some are not finite. */
#include "lib/algorithms/manifold_check.h"

typedef struct vertex_block {
    mt_vec3 minimum, maximum; /* minimum.x > maximum.x: none */
    mt_index non_finite_count;
} vertex_block;

typedef struct vertex_scan {
    manifold_check *check;
    vertex_block *blocks;
} vertex_scan;

static void extend(vertex_block *block, mt_vec3 low, mt_vec3 high)
{
    block->minimum.x = low.x < block->minimum.x ? low.x : block->minimum.x;
    block->minimum.y = low.y < block->minimum.y ? low.y : block->minimum.y;
    block->minimum.z = low.z < block->minimum.z ? low.z : block->minimum.z;
    block->maximum.x = high.x > block->maximum.x ? high.x : block->maximum.x;
    block->maximum.y = high.y > block->maximum.y ? high.y : block->maximum.y;
    block->maximum.z = high.z > block->maximum.z ? high.z : block->maximum.z;
}

static vertex_block empty_block(void)
{
    vertex_block block = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    return block;
}

static void scan_block(void *user, uint64_t begin, uint64_t end)
{
    const vertex_scan *scan = user;
    vertex_block block = empty_block();
    for (mt_index vertex = (mt_index)begin; vertex < end; vertex++) {
        mt_vec3 p = mt_mesh_position(scan->check->mesh, vertex);
        if (!mt_vec3_is_finite(p)) {
            block.non_finite_count++;
        } else if (scan->check->fans->fans[vertex] != MT_FANS_NONE) {
            extend(&block, p, p);
        }
    }
    scan->blocks[begin / MANIFOLD_GRAIN] = block;
}

static void mark_block(void *user, uint64_t begin, uint64_t end)
{
    manifold_check *check = user;
    for (mt_index vertex = (mt_index)begin; vertex < end; vertex++) {
        check->vertex_is_non_finite[vertex] = !mt_vec3_is_finite(mt_mesh_position(check->mesh, vertex));
    }
}

mt_status mt_manifold_scan_vertices(manifold_check *check)
{
    mt_index vertex_count = check->mesh->vertex_count;
    uint64_t block_count = ((uint64_t)vertex_count + MANIFOLD_GRAIN - 1) / MANIFOLD_GRAIN;
    vertex_scan scan = {check, mt_allocate_array(check->context, block_count, sizeof *scan.blocks)};
    if (!scan.blocks) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(check->context, vertex_count, MANIFOLD_GRAIN, scan_block, &scan);
    vertex_block all = empty_block();
    for (uint64_t block = 0; block < block_count; block++) {
        extend(&all, scan.blocks[block].minimum, scan.blocks[block].maximum);
        all.non_finite_count += scan.blocks[block].non_finite_count;
    }
    mt_free(check->context, scan.blocks);
    if (all.minimum.x <= all.maximum.x) {
        check->minimum = all.minimum;
        check->maximum = all.maximum;
    }
    check->report->defect_counts[MT_DEFECT_NON_FINITE_VERTEX] = all.non_finite_count;
    if (all.non_finite_count) {
        check->vertex_is_non_finite = mt_allocate(check->context, vertex_count);
        if (!check->vertex_is_non_finite) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        mt_parallel_for(check->context, vertex_count, MANIFOLD_GRAIN, mark_block, check);
    }
    return MT_OK;
}
