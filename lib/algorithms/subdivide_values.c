/* Catmull-Clark's masks as gathers: each new value is computed once, by one thread, from old ones.
 *
 * Source: Catmull and Clark, 1978; boundary edges and vertices by the masks of the cubic B-spline. With n the
 * valence, F the mean of the face points and R that of the edges' midpoints, (F + 2R + (n-3)P)/n is
 * P + sum((F_i - P) + (Q_i - P))/n^2 over the faces and the edges' far ends Q_i: equal values stay equal to the last
 * bit. The regular case, n = 4, is (sum F_i + sum Q_i)/16 + P/2, whose weights are exact.
 *
 * Invariant: sums are symmetric (subdivide_sum.h), so that mirrored input gives mirrored output and the start of a
 * face or ring does not matter. Cost: O(corners) time, no memory; bound by memory bandwidth on large meshes.
 * Known failure: values past a sixteenth of the largest double overflow. */
#include "lib/algorithms/subdivide_values.h"

#include "lib/algorithms/subdivide_sum.h"

#include <string.h>

typedef struct values_job {
    const mt_subdivide_topology *topology;
    const void *source;
    void *target;
    size_t stride; /* numbers from one value to the next */
    size_t offset; /* of the first component that this pass makes */
    size_t size;   /* bytes of a value */
    bool linear;
} values_job;

/* `wide`, `sides` and `width` (components, at most 4) are constants of each compiled loop. */
#define WIDTH_LIMIT 4

MT_SUBDIVIDE_INLINE double load(const values_job *job, const void *values, mt_index vertex, unsigned component,
                                bool wide)
{
    size_t at = vertex * job->stride + job->offset + component;
    return wide ? ((const double *)values)[at] : (double)((const float *)values)[at];
}

MT_SUBDIVIDE_INLINE void store(const values_job *job, mt_index vertex, unsigned component, double value, bool wide)
{
    size_t at = vertex * job->stride + job->offset + component;
    if (wide) {
        ((double *)job->target)[at] = value;
    } else {
        ((float *)job->target)[at] = (float)value;
    }
}

MT_SUBDIVIDE_INLINE void face_point(const values_job *job, mt_index face, bool wide, unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, sides);
    mt_index count = mt_subdivide_face_begin(topology, face + 1, sides) - begin;
    const mt_index *vertices = topology->corner_vertices + begin;
    mt_index target = topology->vertex_count + face;
    for (unsigned k = 0; k < width; k++) {
        if (count == 4) {
            double a = load(job, job->source, vertices[0], k, wide), b = load(job, job->source, vertices[1], k, wide);
            double c = load(job, job->source, vertices[2], k, wide), d = load(job, job->source, vertices[3], k, wide);
            store(job, target, k, ((a + c) + (b + d)) * 0.25, wide);
            continue;
        }
        mt_subdivide_sum sum = {0, 0};
        for (mt_index i = 0; i < count; i++) {
            mt_subdivide_sum_add(&sum, load(job, job->source, vertices[i], k, wide));
        }
        store(job, target, k, mt_subdivide_sum_over(&sum, count), wide);
    }
}

/* The edge point of a first corner: of the ends alone at a boundary and in linear rules. */
MT_SUBDIVIDE_INLINE void edge_point(const values_job *job, mt_index corner, mt_index next, mt_index face,
                                    mt_index target, bool wide, unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index twin = topology->twins[corner];
    mt_index a = topology->corner_vertices[corner], b = topology->corner_vertices[next];
    bool sharp = job->linear || twin == corner;
    mt_index left = topology->vertex_count + face;
    mt_index right = sharp ? left : topology->vertex_count + mt_subdivide_face(topology, twin, sides);
    for (unsigned k = 0; k < width; k++) {
        double ends = load(job, job->source, a, k, wide) + load(job, job->source, b, k, wide);
        double faces = load(job, job->target, left, k, wide) + load(job, job->target, right, k, wide);
        store(job, target, k, sharp ? ends * 0.5 : (ends + faces) * 0.25, wide);
    }
}

MT_SUBDIVIDE_INLINE void edge_points(const values_job *job, mt_index face, bool wide, unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, sides);
    mt_index end = mt_subdivide_face_begin(topology, face + 1, sides);
    mt_index target = topology->vertex_count + topology->face_count + mt_subdivide_face_rank(topology, face, sides);
    for (mt_index corner = begin; corner < end; corner++) {
        if (mt_subdivide_is_first(topology, corner)) {
            edge_point(job, corner, corner + 1 == end ? begin : corner + 1, face, target++, wide, sides, width);
        }
    }
}

/* 3/4 P + 1/8 + 1/8 of the neighbours along the boundary. */
MT_SUBDIVIDE_INLINE void boundary_point(const values_job *job, mt_index vertex, mt_index a, mt_index b, bool wide,
                                        unsigned width)
{
    for (unsigned k = 0; k < width; k++) {
        double ends = load(job, job->source, a, k, wide) + load(job, job->source, b, k, wide);
        store(job, vertex, k, load(job, job->source, vertex, k, wide) * 0.75 + ends * 0.125, wide);
    }
}

/* Interior, of valence 4: faces and far ends of the edges in their order around the vertex. */
MT_SUBDIVIDE_INLINE void regular_point(const values_job *job, mt_index vertex, const mt_index faces[4],
                                       const mt_index ends[4], bool wide, unsigned width)
{
    mt_index base = job->topology->vertex_count;
    for (unsigned k = 0; k < width; k++) {
        double even_faces =
            load(job, job->target, base + faces[0], k, wide) + load(job, job->target, base + faces[2], k, wide);
        double odd_faces =
            load(job, job->target, base + faces[1], k, wide) + load(job, job->target, base + faces[3], k, wide);
        double even_ends = load(job, job->source, ends[0], k, wide) + load(job, job->source, ends[2], k, wide);
        double odd_ends = load(job, job->source, ends[1], k, wide) + load(job, job->source, ends[3], k, wide);
        double old = load(job, job->source, vertex, k, wide);
        store(job, vertex, k, ((even_faces + odd_faces) + (even_ends + odd_ends)) * 0.0625 + old * 0.5, wide);
    }
}

MT_SUBDIVIDE_INLINE void irregular_point(const values_job *job, mt_index vertex, mt_index start, bool wide,
                                         unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_subdivide_sum sums[WIDTH_LIMIT] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    double valence = 0;
    mt_index corner = start;
    do {
        mt_index face = topology->vertex_count + mt_subdivide_face(topology, corner, sides);
        mt_index end = topology->corner_vertices[mt_subdivide_next(topology, corner, sides)];
        for (unsigned k = 0; k < width; k++) {
            double old = load(job, job->source, vertex, k, wide);
            mt_subdivide_sum_add(&sums[k], load(job, job->target, face, k, wide) - old);
            mt_subdivide_sum_add(&sums[k], load(job, job->source, end, k, wide) - old);
        }
        valence += 1;
        corner = mt_subdivide_turn(topology, corner, sides);
    } while (corner != start);
    for (unsigned k = 0; k < width; k++) {
        double move = (sums[k].high + sums[k].low) / (valence * valence);
        store(job, vertex, k, load(job, job->source, vertex, k, wide) + move, wide);
    }
}

/* The neighbours along the boundary of a vertex, whose corner `start` has the side that leaves along it. */
MT_SUBDIVIDE_INLINE void boundary_point_at(const values_job *job, mt_index vertex, mt_index start, bool wide,
                                           unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index previous = mt_subdivide_previous(topology, start, sides);
    while (topology->twins[previous] != previous) {
        previous = mt_subdivide_previous(topology, topology->twins[previous], sides);
    }
    mt_index a = topology->corner_vertices[mt_subdivide_next(topology, start, sides)];
    boundary_point(job, vertex, a, topology->corner_vertices[previous], wide, width);
}

MT_SUBDIVIDE_INLINE void interior_point_at(const values_job *job, mt_index vertex, mt_index start, bool wide,
                                           unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index faces[4], ends[4];
    unsigned valence = 0;
    mt_index corner = start;
    do {
        faces[valence] = mt_subdivide_face(topology, corner, sides);
        ends[valence++] = topology->corner_vertices[mt_subdivide_next(topology, corner, sides)];
        corner = mt_subdivide_turn(topology, corner, sides);
    } while (corner != start && valence < 4);
    if (corner == start && valence == 4) {
        regular_point(job, vertex, faces, ends, wide, width);
    } else {
        irregular_point(job, vertex, start, wide, sides, width);
    }
}

/* Any vertex, by a walk around it. */
MT_SUBDIVIDE_INLINE void vertex_point(const values_job *job, mt_index vertex, bool wide, unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    if (start == MT_NONE) {
        for (unsigned k = 0; k < width; k++) {
            store(job, vertex, k, load(job, job->source, vertex, k, wide), wide);
        }
    } else if (topology->twins[start] == start) {
        boundary_point_at(job, vertex, start, wide, sides, width);
    } else {
        interior_point_at(job, vertex, start, wide, sides, width);
    }
}

/* Faces and far ends of a vertex's edges, from its corners. */
MT_SUBDIVIDE_INLINE void regular_point_at(const values_job *job, mt_index vertex, const mt_index ring[4], bool wide,
                                          unsigned width)
{
    mt_index faces[4], ends[4];
    for (unsigned i = 0; i < 4; i++) {
        faces[i] = ring[i] >> 2;
        ends[i] = job->topology->corner_vertices[mt_subdivide_next(job->topology, ring[i], 4)];
    }
    regular_point(job, vertex, faces, ends, wide, width);
}

/* An edge point of an earlier level, around which lay, when it was made, two children of each face of its edge: one,
 * `face`, had it at corner 4 face + 1; the other of that face, `after`, at 4 after + 3; across the edge those of the
 * other face. The corners of today are those, shifted by the age; their twins still lie in the same four. */
MT_SUBDIVIDE_INLINE void former_edge_point(const values_job *job, mt_index face, unsigned age, bool wide,
                                           unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    const mt_index *vertices = topology->corner_vertices, *twins = topology->twins;
    mt_index side = (4 * face) << age, corner = (4 * face + 1) << age;
    mt_index twin = twins[side];
    if (twin < side) {
        return;
    }
    mt_index leaving = (4 * (twins[corner] >> (age + 2)) + 3) << age;
    if (twin == side) {
        mt_index a = vertices[mt_subdivide_next(topology, leaving, 4)];
        mt_index b = vertices[mt_subdivide_previous(topology, corner, 4)];
        boundary_point(job, vertices[corner], a, b, wide, width);
        return;
    }
    mt_index across = (4 * (twin >> (age + 2)) + 3) << age;
    mt_index opposite = (4 * (twins[leaving] >> (age + 2)) + 1) << age;
    mt_index ring[4] = {corner, across, opposite, leaving};
    regular_point_at(job, vertices[corner], ring, wide, width);
}

/* The points that an earlier level added, by the faces that it made, without a walk: the edge points by their first
 * corner, and the face point that the children 4i .. 4i+3 of a quad share. */
MT_SUBDIVIDE_INLINE void former_points(const values_job *job, mt_index face, unsigned age, bool wide, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    former_edge_point(job, face, age, wide, width);
    mt_index corner = (4 * face + 2) << age, step = 4u << age;
    mt_index vertex = topology->corner_vertices[corner];
    if ((face & 3) == 0 && vertex >= topology->vertex_corner_count) {
        mt_index ring[4] = {corner, corner + step, corner + 2 * step, corner + 3 * step};
        regular_point_at(job, vertex, ring, wide, width);
    }
}

/* Edge points, and behind them, while what they read is in the cache, the former points whose first face of today
 * lies in the same block; `age` is twice the levels since those were made. */
MT_SUBDIVIDE_INLINE void edge_block(const values_job *job, uint64_t begin, uint64_t end, bool wide, unsigned sides,
                                    unsigned width)
{
    for (uint64_t face = begin; face < end; face++) {
        edge_points(job, (mt_index)face, wide, sides, width);
    }
    for (unsigned age = 0; sides == 4 && !job->linear && age < 2 * job->topology->level; age += 2) {
        uint64_t rest = ((uint64_t)1 << age) - 1;
        for (uint64_t face = (begin + rest) >> age; face < (end + rest) >> age; face++) {
            former_points(job, (mt_index)face, age, wide, width);
        }
    }
}

MT_SUBDIVIDE_INLINE void face_block(const values_job *job, uint64_t begin, uint64_t end, bool wide, unsigned sides,
                                    unsigned width)
{
    for (uint64_t face = begin; face < end; face++) {
        face_point(job, (mt_index)face, wide, sides, width);
    }
}

MT_SUBDIVIDE_INLINE void vertex_block(const values_job *job, uint64_t begin, uint64_t end, bool wide, unsigned sides,
                                      unsigned width)
{
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        vertex_point(job, (mt_index)vertex, wide, sides, width);
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
typedef mt_parallel_body loop_table[5][2][WIDTH_LIMIT];
static const loop_table face_loops = {
    [0] = ROWS(face_block, polygons), [3] = ROWS(face_block, triangles), [4] = ROWS(face_block, quads)};
static const loop_table edge_loops = {
    [0] = ROWS(edge_block, polygons), [3] = ROWS(edge_block, triangles), [4] = ROWS(edge_block, quads)};
static const loop_table vertex_loops = {
    [0] = ROWS(vertex_block, polygons), [3] = ROWS(vertex_block, triangles), [4] = ROWS(vertex_block, quads)};

static void keep_old_values(void *user, uint64_t begin, uint64_t end)
{
    const values_job *job = user;
    memcpy((char *)job->target + begin * job->size, (const char *)job->source + begin * job->size,
           (end - begin) * job->size);
}

static void copy_origins(void *user, uint64_t begin, uint64_t end)
{
    const values_job *job = user;
    const mt_subdivide_topology *topology = job->topology;
    const mt_index *source = job->source;
    mt_index *target = job->target;
    unsigned sides = topology->face_size;
    mt_index edge_base = topology->vertex_count + topology->face_count;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index first = mt_subdivide_face_begin(topology, face, sides);
        mt_index last = mt_subdivide_face_begin(topology, face + 1, sides);
        mt_index rank = mt_subdivide_face_rank(topology, face, sides);
        target[topology->vertex_count + face] = source[topology->corner_vertices[first]];
        for (mt_index corner = first; corner < last; corner++) {
            if (mt_subdivide_is_first(topology, corner)) {
                target[edge_base + rank++] = source[topology->corner_vertices[corner]];
            }
        }
    }
}

/* The rules for components offset .. offset + width - 1. */
static void apply_rules(mt_context *context, const values_job *job, bool wide, uint32_t width)
{
    const mt_subdivide_topology *topology = job->topology;
    unsigned sides = topology->face_size;
    values_job copy = *job;
    mt_parallel_for(context, topology->face_count, MT_SUBDIVIDE_GRAIN, face_loops[sides][wide][width - 1], &copy);
    mt_parallel_for(context, topology->face_count, MT_SUBDIVIDE_GRAIN, edge_loops[sides][wide][width - 1], &copy);
    if (!job->linear) {
        mt_parallel_for(context, topology->vertex_corner_count, MT_SUBDIVIDE_GRAIN,
                        vertex_loops[sides][wide][width - 1], &copy);
    }
}

void mt_subdivide_values(mt_context *context, const mt_subdivide_topology *topology, mt_subdivide_rule rule,
                         mt_type type, uint32_t component_count, const void *source, void *target)
{
    values_job job = {.topology = topology, .source = source, .target = target, .stride = component_count};
    job.size = component_count * mt_type_size(type);
    job.linear = rule == MT_SUBDIVIDE_LINEAR;
    if (rule != MT_SUBDIVIDE_SMOOTH) {
        mt_parallel_for(context, topology->vertex_count, 4 * MT_SUBDIVIDE_GRAIN, keep_old_values, &job);
    }
    if (rule == MT_SUBDIVIDE_ORIGIN) {
        mt_parallel_for(context, topology->face_count, MT_SUBDIVIDE_GRAIN, copy_origins, &job);
        return;
    }
    for (uint32_t offset = 0; offset < component_count; offset += WIDTH_LIMIT) {
        uint32_t width = component_count - offset < WIDTH_LIMIT ? component_count - offset : WIDTH_LIMIT;
        job.offset = offset;
        apply_rules(context, &job, type == MT_F64, width);
    }
}
