/* Cost: O(corners); the walks of a level's vertices, done once for the mesh. */
#include "lib/algorithms/subdivide_rings.h"

typedef struct ring_scan {
    const mt_subdivide_topology *topology;
    mt_index *block_counts; /* corners that the rings of a block's vertices reach */
} ring_scan;

MT_SUBDIVIDE_INLINE mt_index ring_length(const mt_subdivide_topology *topology, mt_index vertex, unsigned sides)
{
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    mt_index count = 0;
    mt_index corner = start;
    while (corner != MT_NONE) {
        count++;
        mt_index previous = mt_subdivide_previous(topology, corner, sides);
        corner = topology->twins[previous];
        if (corner == previous || corner == start) {
            break;
        }
    }
    return count;
}

#define RING_LOOP(name, sides)                                                                                         \
    static void name(void *user, uint64_t begin, uint64_t end)                                                         \
    {                                                                                                                  \
        const ring_scan *scan = user;                                                                                  \
        mt_index count = 0;                                                                                            \
        for (uint64_t vertex = begin; vertex < end; vertex++) {                                                        \
            count += ring_length(scan->topology, (mt_index)vertex, sides);                                             \
        }                                                                                                              \
        scan->block_counts[begin / MT_SUBDIVIDE_GRAIN] = count;                                                        \
    }
RING_LOOP(count_polygon_rings, 0)
RING_LOOP(count_triangle_rings, 3)
RING_LOOP(count_quad_rings, 4)

mt_status mt_subdivide_count_ring_corners(mt_context *context, const mt_subdivide_topology *topology, mt_index *count)
{
    static const mt_parallel_body loops[] = {
        [0] = count_polygon_rings, [3] = count_triangle_rings, [4] = count_quad_rings};
    uint64_t block_count = (uint64_t)topology->vertex_count / MT_SUBDIVIDE_GRAIN + 1;
    ring_scan scan = {.topology = topology};
    scan.block_counts = mt_allocate_array_zeroed(context, block_count, sizeof(mt_index));
    if (!scan.block_counts) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, topology->vertex_count, MT_SUBDIVIDE_GRAIN, loops[topology->face_size], &scan);
    *count = 0;
    for (uint64_t block = 0; block < block_count; block++) {
        *count += scan.block_counts[block];
    }
    mt_free(context, scan.block_counts);
    return MT_OK;
}
