/* The loops of each rule, compiled once for every type, shape of faces and width of values from the same masks
 * (subdivide_masks.h), and which of them a field takes. */
#include "lib/algorithms/subdivide_values.h"

#include "lib/algorithms/subdivide_loop.h"
#include "lib/algorithms/subdivide_masks.h"

#include <string.h>

/* Edge points, and behind them, while what they read is in the cache, the former points whose first face of today
 * lies in the same block; `age` is twice the levels since those were made. */
MT_SUBDIVIDE_INLINE void edge_block(const mt_subdivide_loop *loop, uint64_t begin, uint64_t end, bool wide,
                                    unsigned sides, unsigned width)
{
    for (uint64_t face = begin; face < end; face++) {
        edge_points(loop, (mt_index)face, wide, sides, width);
    }
    for (unsigned age = 0; sides == 4 && !loop->linear && age < 2 * loop->topology->level; age += 2) {
        uint64_t rest = ((uint64_t)1 << age) - 1;
        for (uint64_t face = (begin + rest) >> age; face < (end + rest) >> age; face++) {
            former_points(loop, (mt_index)face, age, wide, width);
        }
    }
}

MT_SUBDIVIDE_INLINE void face_block(const mt_subdivide_loop *loop, uint64_t begin, uint64_t end, bool wide,
                                    unsigned sides, unsigned width)
{
    for (uint64_t face = begin; face < end; face++) {
        face_point(loop, (mt_index)face, wide, sides, width);
    }
}

MT_SUBDIVIDE_INLINE void vertex_block(const mt_subdivide_loop *loop, uint64_t begin, uint64_t end, bool wide,
                                      unsigned sides, unsigned width)
{
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        vertex_point(loop, (mt_index)vertex, wide, sides, width);
    }
}

#define LOOP(pass, name, wide, sides, width)                                                                           \
    static void name(void *user, uint64_t begin, uint64_t end)                                                         \
    {                                                                                                                  \
        pass(user, begin, end, wide, sides, width);                                                                    \
    }
#define LOOPS(pass, shape, sides)                                                                                      \
    LOOP(pass, pass##_f32_##shape##_1, false, sides, 1)                                                                \
    LOOP(pass, pass##_f32_##shape##_2, false, sides, 2)                                                                \
    LOOP(pass, pass##_f32_##shape##_3, false, sides, 3)                                                                \
    LOOP(pass, pass##_f32_##shape##_4, false, sides, 4)                                                                \
    LOOP(pass, pass##_f64_##shape##_1, true, sides, 1)                                                                 \
    LOOP(pass, pass##_f64_##shape##_2, true, sides, 2)                                                                 \
    LOOP(pass, pass##_f64_##shape##_3, true, sides, 3)                                                                 \
    LOOP(pass, pass##_f64_##shape##_4, true, sides, 4)
#define LOOPS_OF_SHAPES(pass) LOOPS(pass, polygons, 0) LOOPS(pass, triangles, 3) LOOPS(pass, quads, 4)
LOOPS_OF_SHAPES(face_block)
LOOPS_OF_SHAPES(edge_block)
LOOPS_OF_SHAPES(vertex_block)

/* By number of sides (0: any), f32 and f64, and components less 1. */
#define ROW(pass, type, shape)                                                                                         \
    {                                                                                                                  \
        pass##_##type##_##shape##_1, pass##_##type##_##shape##_2, pass##_##type##_##shape##_3,                         \
            pass##_##type##_##shape##_4                                                                                \
    }
#define ROWS(pass, shape)                                                                                              \
    {                                                                                                                  \
        ROW(pass, f32, shape), ROW(pass, f64, shape)                                                                   \
    }
typedef mt_parallel_body loop_table[5][2][MT_SUBDIVIDE_WIDTH_LIMIT];
static const loop_table face_loops = {
    [0] = ROWS(face_block, polygons), [3] = ROWS(face_block, triangles), [4] = ROWS(face_block, quads)};
static const loop_table edge_loops = {
    [0] = ROWS(edge_block, polygons), [3] = ROWS(edge_block, triangles), [4] = ROWS(edge_block, quads)};
static const loop_table vertex_loops = {
    [0] = ROWS(vertex_block, polygons), [3] = ROWS(vertex_block, triangles), [4] = ROWS(vertex_block, quads)};

static void keep_old_values(void *user, uint64_t begin, uint64_t end)
{
    const mt_subdivide_loop *loop = user;
    memcpy((char *)loop->target + begin * loop->size, (const char *)loop->source + begin * loop->size,
           (end - begin) * loop->size);
}

static void copy_origins(void *user, uint64_t begin, uint64_t end)
{
    const mt_subdivide_loop *loop = user;
    const mt_subdivide_topology *topology = loop->topology;
    const mt_index *source = loop->source;
    mt_index *target = loop->target;
    unsigned sides = topology->face_size;
    mt_index edge_base = mt_subdivide_first_edge_point(topology);
    bool face_points = mt_subdivide_face_point_count(topology) > 0;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index first = mt_subdivide_face_begin(topology, face, sides);
        mt_index last = mt_subdivide_face_begin(topology, face + 1, sides);
        mt_index rank = mt_subdivide_face_rank(topology, face, sides);
        if (face_points) {
            target[topology->vertex_count + face] = source[topology->corner_vertices[first]];
        }
        for (mt_index corner = first; corner < last; corner++) {
            if (mt_subdivide_is_first(topology, corner)) {
                target[edge_base + rank++] = source[topology->corner_vertices[corner]];
            }
        }
    }
}

/* The loops for components offset .. offset + width - 1. */
static void plan_rules(mt_subdivide_loop loop, bool wide, uint32_t width, mt_subdivide_pass *first,
                       mt_subdivide_pass *second)
{
    const mt_subdivide_topology *topology = loop.topology;
    unsigned sides = topology->face_size;
    if (topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP) {
        mt_subdivide_loop_rules(&loop, wide, second);
        return;
    }
    mt_subdivide_pass_add(first, &loop, face_loops[sides][wide][width - 1], topology->face_count);
    mt_subdivide_pass_add(second, &loop, edge_loops[sides][wide][width - 1], topology->face_count);
    if (!loop.linear) {
        mt_subdivide_pass_add(second, &loop, vertex_loops[sides][wide][width - 1], topology->vertex_corner_count);
    }
}

size_t mt_subdivide_values_loop_count(uint32_t component_count)
{
    return 2 * ((size_t)component_count / MT_SUBDIVIDE_WIDTH_LIMIT + 1);
}

void mt_subdivide_values_plan(const mt_subdivide_topology *topology, mt_subdivide_rule rule, mt_type type,
                              uint32_t component_count, const void *source, void *target, mt_subdivide_pass *first,
                              mt_subdivide_pass *second)
{
    mt_subdivide_loop loop = {.topology = topology, .source = source, .target = target, .stride = component_count};
    loop.size = component_count * mt_type_size(type);
    loop.linear = rule == MT_SUBDIVIDE_LINEAR;
    loop.still_boundary = rule == MT_SUBDIVIDE_SMOOTH_BUT_BOUNDARY;
    if (loop.linear || rule == MT_SUBDIVIDE_ORIGIN) {
        mt_subdivide_pass_add(first, &loop, keep_old_values, topology->vertex_count);
    }
    if (rule == MT_SUBDIVIDE_ORIGIN) {
        mt_subdivide_pass_add(second, &loop, copy_origins, topology->face_count);
        return;
    }
    for (uint32_t offset = 0; offset < component_count; offset += MT_SUBDIVIDE_WIDTH_LIMIT) {
        uint32_t rest = component_count - offset;
        loop.offset = offset;
        plan_rules(loop, type == MT_F64, rest < MT_SUBDIVIDE_WIDTH_LIMIT ? rest : MT_SUBDIVIDE_WIDTH_LIMIT, first,
                   second);
    }
}
