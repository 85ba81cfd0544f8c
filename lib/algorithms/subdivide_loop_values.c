/* Loop's masks as gathers.
 *
 * Source: Loop (1987), section 3, with the weights of any valence n: an old vertex moves by b times the sum of what its
 * neighbours differ from it, b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n, which is 1/16 for n = 6; edge points are 3/8
 * of the ends and 1/8 of the opposite vertices. Boundaries are cubic B-splines, as with Catmull-Clark.
 * Invariant: the order of a sum does not matter (subdivide_sum.h), and equal values stay equal to the last bit.
 * Cost: O(corners); a walk around every vertex. */
#include "lib/algorithms/subdivide_loop.h"

#include "lib/algorithms/subdivide_masks.h"

#include <meshtool/elementary.h>

static unsigned width_of(const mt_subdivide_loop *loop)
{
    size_t rest = loop->stride - loop->offset;
    return (unsigned)(rest < MT_SUBDIVIDE_WIDTH_LIMIT ? rest : MT_SUBDIVIDE_WIDTH_LIMIT);
}

MT_SUBDIVIDE_INLINE void triangle_edge_point(const mt_subdivide_loop *loop, mt_index corner, mt_index target, bool wide)
{
    const mt_subdivide_topology *topology = loop->topology;
    const mt_index *vertices = topology->corner_vertices;
    mt_index twin = topology->twins[corner];
    bool sharp = loop->linear || twin == corner;
    mt_index a = vertices[corner], b = vertices[mt_subdivide_next(topology, corner, 3)];
    mt_index c = vertices[mt_subdivide_previous(topology, corner, 3)];
    mt_index d = vertices[mt_subdivide_previous(topology, twin, 3)];
    for (unsigned k = 0; k < width_of(loop); k++) {
        double ends = load(loop, loop->source, a, k, wide) + load(loop, loop->source, b, k, wide);
        double opposite = load(loop, loop->source, c, k, wide) + load(loop, loop->source, d, k, wide);
        store(loop, target, k, sharp ? ends * 0.5 : ends * 0.5 + (opposite - ends) * 0.125, wide);
    }
}

MT_SUBDIVIDE_INLINE void triangle_edge_points(const mt_subdivide_loop *loop, mt_index face, bool wide)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index target = mt_subdivide_first_edge_point(topology) + topology->edge_ranks[face];
    for (mt_index corner = 3 * face; corner < 3 * face + 3; corner++) {
        if (mt_subdivide_is_first(topology, corner)) {
            triangle_edge_point(loop, corner, target++, wide);
        }
    }
}

double mt_loop_weight(mt_index valence)
{
    if (valence == 6) {
        return 0.0625;
    }
    double root = 0.375 + mt_cos(2 * MT_PI / valence) * 0.25;
    return (0.625 - root * root) / valence;
}

MT_SUBDIVIDE_INLINE void inner_point(const mt_subdivide_loop *loop, mt_index vertex, mt_index start, bool wide)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_subdivide_sum sums[MT_SUBDIVIDE_WIDTH_LIMIT] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    unsigned width = width_of(loop);
    mt_index corner = start, valence = 0;
    do {
        mt_index end = topology->corner_vertices[mt_subdivide_next(topology, corner, 3)];
        for (unsigned k = 0; k < width; k++) {
            double old = load(loop, loop->source, vertex, k, wide);
            mt_subdivide_sum_add(&sums[k], load(loop, loop->source, end, k, wide) - old);
        }
        valence++;
        corner = mt_subdivide_turn(topology, corner, 3);
    } while (corner != start);
    double weight = mt_loop_weight(valence);
    for (unsigned k = 0; k < width; k++) {
        double move = (sums[k].high + sums[k].low) * weight;
        store(loop, vertex, k, load(loop, loop->source, vertex, k, wide) + move, wide);
    }
}

MT_SUBDIVIDE_INLINE void triangle_vertex_point(const mt_subdivide_loop *loop, mt_index vertex, bool wide)
{
    mt_index start = mt_subdivide_vertex_corner(loop->topology, vertex);
    bool boundary = start != MT_NONE && loop->topology->twins[start] == start;
    if (start == MT_NONE || (boundary && loop->still_boundary)) {
        for (unsigned k = 0; k < width_of(loop); k++) {
            store(loop, vertex, k, load(loop, loop->source, vertex, k, wide), wide);
        }
    } else if (boundary) {
        boundary_point_at(loop, vertex, start, wide, 3, width_of(loop));
    } else {
        inner_point(loop, vertex, start, wide);
    }
}

#define LOOPS_OF(name, wide)                                                                                           \
    static void edges_##name(void *user, uint64_t begin, uint64_t end)                                                 \
    {                                                                                                                  \
        for (uint64_t face = begin; face < end; face++) {                                                              \
            triangle_edge_points(user, (mt_index)face, wide);                                                          \
        }                                                                                                              \
    }                                                                                                                  \
    static void vertices_##name(void *user, uint64_t begin, uint64_t end)                                              \
    {                                                                                                                  \
        for (uint64_t vertex = begin; vertex < end; vertex++) {                                                        \
            triangle_vertex_point(user, (mt_index)vertex, wide);                                                       \
        }                                                                                                              \
    }
LOOPS_OF(f32, false)
LOOPS_OF(f64, true)

void mt_subdivide_loop_rules(const mt_subdivide_loop *loop, bool wide, mt_subdivide_pass *pass)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_subdivide_pass_add(pass, loop, wide ? edges_f64 : edges_f32, topology->face_count);
    if (!loop->linear) {
        mt_subdivide_pass_add(pass, loop, wide ? vertices_f64 : vertices_f32, topology->vertex_count);
    }
}
