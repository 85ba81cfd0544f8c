/* Source: DeRose, Kass and Truong (1998), section 4: where a rule changes between a level and the next, the two are
 * blended. Written as child + weight (parent - child), so that equal values stay equal to the last bit. */
#include "lib/algorithms/subdivide_patch.h"

static double get(const mt_subdivide_loop *loop, const void *values, mt_index vertex, size_t component, bool wide)
{
    size_t at = vertex * loop->stride + component;
    return wide ? ((const double *)values)[at] : (double)((const float *)values)[at];
}

static void set(const mt_subdivide_loop *loop, mt_index vertex, size_t component, double value, bool wide)
{
    size_t at = vertex * loop->stride + component;
    if (wide) {
        ((double *)loop->target)[at] = value;
    } else {
        ((float *)loop->target)[at] = (float)value;
    }
}

static double ruled(mt_subdivide_vertex_rule rule, double old, double ends, double smooth)
{
    switch (rule) {
    case MT_VERTEX_CORNER:
        return old;
    case MT_VERTEX_CREASE:
        return old * 0.75 + ends * 0.125;
    default:
        return smooth;
    }
}

MT_SUBDIVIDE_INLINE void patch_vertex(const mt_subdivide_loop *loop, const mt_vertex_patch *patch, bool wide)
{
    const mt_index *vertices = loop->topology->corner_vertices;
    mt_index vertex = vertices[patch->corner], a = vertices[patch->ends[0]], b = vertices[patch->ends[1]];
    double weight = (double)patch->weight;
    for (size_t k = 0; k < loop->stride; k++) {
        double old = get(loop, loop->source, vertex, k, wide);
        double ends = get(loop, loop->source, a, k, wide) + get(loop, loop->source, b, k, wide);
        double smooth = get(loop, loop->target, vertex, k, wide);
        double parent = ruled(patch->parent, old, ends, smooth), child = ruled(patch->child, old, ends, smooth);
        set(loop, vertex, k, patch->weight == 1 ? parent : child + weight * (parent - child), wide);
    }
}

MT_SUBDIVIDE_INLINE void patch_edge(const mt_subdivide_loop *loop, const mt_edge_patch *patch, bool wide)
{
    const mt_subdivide_topology *topology = loop->topology;
    unsigned sides = topology->face_size;
    if (topology->twins[patch->side] == patch->side) {
        return;
    }
    mt_index a = topology->corner_vertices[patch->side];
    mt_index b = topology->corner_vertices[mt_subdivide_next(topology, patch->side, sides)];
    mt_index target = mt_subdivide_first_edge_point(topology) + mt_subdivide_edge(topology, patch->side, sides);
    double weight = (double)patch->weight;
    for (size_t k = 0; k < loop->stride; k++) {
        double middle = (get(loop, loop->source, a, k, wide) + get(loop, loop->source, b, k, wide)) * 0.5;
        double smooth = get(loop, loop->target, target, k, wide);
        set(loop, target, k, patch->weight == 1 ? middle : smooth + weight * (middle - smooth), wide);
    }
}

#define PATCH_LOOPS(name, wide)                                                                                        \
    static void patch_vertices_##name(void *user, uint64_t begin, uint64_t end)                                        \
    {                                                                                                                  \
        const mt_subdivide_loop *loop = user;                                                                          \
        const mt_vertex_patch *patches = loop->patches;                                                                \
        for (uint64_t i = begin; i < end; i++) {                                                                       \
            if (patches[i].weight >= 0 && !(loop->skipped && loop->skipped[i])) {                                      \
                patch_vertex(loop, &patches[i], wide);                                                                 \
            }                                                                                                          \
        }                                                                                                              \
    }                                                                                                                  \
    static void patch_edges_##name(void *user, uint64_t begin, uint64_t end)                                           \
    {                                                                                                                  \
        const mt_subdivide_loop *loop = user;                                                                          \
        const mt_edge_patch *patches = loop->patches;                                                                  \
        for (uint64_t i = begin; i < end; i++) {                                                                       \
            if (patches[i].weight >= 0) {                                                                              \
                patch_edge(loop, &patches[i], wide);                                                                   \
            }                                                                                                          \
        }                                                                                                              \
    }
PATCH_LOOPS(f32, false)
PATCH_LOOPS(f64, true)

void mt_subdivide_vertex_patches_add(const mt_subdivide_loop *values, const mt_vertex_patch *patches,
                                     const uint8_t *skipped, uint64_t count, bool wide, mt_subdivide_pass *pass)
{
    mt_subdivide_loop loop = *values;
    loop.patches = patches;
    loop.skipped = skipped;
    if (count) {
        mt_subdivide_pass_add(pass, &loop, wide ? patch_vertices_f64 : patch_vertices_f32, count);
    }
}

void mt_subdivide_patches_add(const mt_subdivide_loop *values, const mt_subdivide_sharp *sharp,
                              const mt_subdivide_patches *patches, const uint8_t *skipped, bool wide,
                              mt_subdivide_pass *pass)
{
    mt_subdivide_loop loop = *values;
    loop.patches = patches->edges;
    mt_subdivide_vertex_patches_add(values, patches->vertices, skipped, sharp->vertex_count, wide, pass);
    if (sharp->edge_count) {
        mt_subdivide_pass_add(pass, &loop, wide ? patch_edges_f64 : patch_edges_f32, sharp->edge_count);
    }
}
