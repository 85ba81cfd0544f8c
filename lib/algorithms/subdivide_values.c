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

/* `wide`, `quads` and `width` (components, at most 4) are constants of each compiled loop. */
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

MT_SUBDIVIDE_INLINE void face_point(const values_job *job, mt_index face, bool wide, bool quads, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, quads);
    mt_index sides = quads ? 4 : topology->face_offsets[face + 1] - begin;
    const mt_index *vertices = topology->corner_vertices + begin;
    mt_index target = topology->vertex_count + face;
    for (unsigned k = 0; k < width; k++) {
        if (sides == 4) {
            double a = load(job, job->source, vertices[0], k, wide), b = load(job, job->source, vertices[1], k, wide);
            double c = load(job, job->source, vertices[2], k, wide), d = load(job, job->source, vertices[3], k, wide);
            store(job, target, k, ((a + c) + (b + d)) * 0.25, wide);
            continue;
        }
        mt_subdivide_sum sum = {0, 0};
        for (mt_index i = 0; i < sides; i++) {
            mt_subdivide_sum_add(&sum, load(job, job->source, vertices[i], k, wide));
        }
        store(job, target, k, mt_subdivide_sum_over(&sum, sides), wide);
    }
}

/* The edge point of a first corner: of the ends alone at a boundary and in linear rules. */
MT_SUBDIVIDE_INLINE void edge_point(const values_job *job, mt_index corner, mt_index next, mt_index face,
                                    mt_index target, bool wide, bool quads, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index twin = topology->twins[corner];
    mt_index a = topology->corner_vertices[corner], b = topology->corner_vertices[next];
    bool sharp = job->linear || twin == corner;
    mt_index left = topology->vertex_count + face;
    mt_index right = sharp ? left : topology->vertex_count + mt_subdivide_face(topology, twin, quads);
    for (unsigned k = 0; k < width; k++) {
        double ends = load(job, job->source, a, k, wide) + load(job, job->source, b, k, wide);
        double faces = load(job, job->target, left, k, wide) + load(job, job->target, right, k, wide);
        store(job, target, k, sharp ? ends * 0.5 : (ends + faces) * 0.25, wide);
    }
}

MT_SUBDIVIDE_INLINE void edge_points(const values_job *job, mt_index face, bool wide, bool quads, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, quads);
    mt_index end = quads ? begin + 4 : topology->face_offsets[face + 1];
    mt_index target = topology->vertex_count + topology->face_count + topology->edge_ranks[quads ? face : begin];
    for (mt_index corner = begin; corner < end; corner++) {
        if (mt_subdivide_is_first(topology, corner)) {
            edge_point(job, corner, corner + 1 == end ? begin : corner + 1, face, target++, wide, quads, width);
        }
    }
}

/* 3/4 P + 1/8 + 1/8 of the neighbours along the boundary; `corner` is the one whose side leaves along it. */
MT_SUBDIVIDE_INLINE void boundary_point(const values_job *job, mt_index vertex, mt_index corner, bool wide, bool quads,
                                        unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index previous = mt_subdivide_previous(topology, corner, quads);
    while (topology->twins[previous] != previous) {
        previous = mt_subdivide_previous(topology, topology->twins[previous], quads);
    }
    mt_index a = topology->corner_vertices[mt_subdivide_next(topology, corner, quads)];
    mt_index b = topology->corner_vertices[previous];
    for (unsigned k = 0; k < width; k++) {
        double ends = load(job, job->source, a, k, wide) + load(job, job->source, b, k, wide);
        store(job, vertex, k, load(job, job->source, vertex, k, wide) * 0.75 + ends * 0.125, wide);
    }
}

MT_SUBDIVIDE_INLINE void regular_point(const values_job *job, mt_index vertex, const mt_index ring[4], bool wide,
                                       bool quads, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index faces[4], ends[4];
    for (unsigned i = 0; i < 4; i++) {
        faces[i] = topology->vertex_count + mt_subdivide_face(topology, ring[i], quads);
        ends[i] = topology->corner_vertices[mt_subdivide_next(topology, ring[i], quads)];
    }
    for (unsigned k = 0; k < width; k++) {
        double face_sum = (load(job, job->target, faces[0], k, wide) + load(job, job->target, faces[2], k, wide)) +
                          (load(job, job->target, faces[1], k, wide) + load(job, job->target, faces[3], k, wide));
        double end_sum = (load(job, job->source, ends[0], k, wide) + load(job, job->source, ends[2], k, wide)) +
                         (load(job, job->source, ends[1], k, wide) + load(job, job->source, ends[3], k, wide));
        double old = load(job, job->source, vertex, k, wide);
        store(job, vertex, k, (face_sum + end_sum) * 0.0625 + old * 0.5, wide);
    }
}

MT_SUBDIVIDE_INLINE void irregular_point(const values_job *job, mt_index vertex, mt_index start, bool wide, bool quads,
                                         unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_subdivide_sum sums[WIDTH_LIMIT] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    double valence = 0;
    mt_index corner = start;
    do {
        mt_index face = topology->vertex_count + mt_subdivide_face(topology, corner, quads);
        mt_index end = topology->corner_vertices[mt_subdivide_next(topology, corner, quads)];
        for (unsigned k = 0; k < width; k++) {
            double old = load(job, job->source, vertex, k, wide);
            mt_subdivide_sum_add(&sums[k], load(job, job->target, face, k, wide) - old);
            mt_subdivide_sum_add(&sums[k], load(job, job->source, end, k, wide) - old);
        }
        valence += 1;
        corner = mt_subdivide_turn(topology, corner, quads);
    } while (corner != start);
    for (unsigned k = 0; k < width; k++) {
        double move = (sums[k].high + sums[k].low) / (valence * valence);
        store(job, vertex, k, load(job, job->source, vertex, k, wide) + move, wide);
    }
}

MT_SUBDIVIDE_INLINE void vertex_point(const values_job *job, mt_index vertex, bool wide, bool quads, unsigned width)
{
    const mt_subdivide_topology *topology = job->topology;
    mt_index start = topology->vertex_corners[vertex];
    if (start == MT_NONE) {
        for (unsigned k = 0; k < width; k++) {
            store(job, vertex, k, load(job, job->source, vertex, k, wide), wide);
        }
        return;
    }
    if (topology->twins[start] == start) {
        boundary_point(job, vertex, start, wide, quads, width);
        return;
    }
    mt_index ring[4];
    unsigned valence = 0;
    mt_index corner = start;
    do {
        ring[valence++] = corner;
        corner = mt_subdivide_turn(topology, corner, quads);
    } while (corner != start && valence < 4);
    if (corner == start && valence == 4) {
        regular_point(job, vertex, ring, wide, quads, width);
    } else {
        irregular_point(job, vertex, start, wide, quads, width);
    }
}

#define LOOP(pass, name, wide, quads, width)                                                                           \
    static void name(void *user, uint64_t begin, uint64_t end)                                                         \
    {                                                                                                                  \
        for (uint64_t element = begin; element < end; element++) {                                                     \
            pass(user, (mt_index)element, wide, quads, width);                                                         \
        }                                                                                                              \
    }
#define LOOPS_OF_WIDTH(pass, width)                                                                                    \
    LOOP(pass, pass##_f32_polygons_##width, false, false, width)                                                       \
    LOOP(pass, pass##_f32_quads_##width, false, true, width)                                                           \
    LOOP(pass, pass##_f64_polygons_##width, true, false, width)                                                        \
    LOOP(pass, pass##_f64_quads_##width, true, true, width)
#define LOOPS(pass) LOOPS_OF_WIDTH(pass, 1) LOOPS_OF_WIDTH(pass, 2) LOOPS_OF_WIDTH(pass, 3) LOOPS_OF_WIDTH(pass, 4)
LOOPS(face_point)
LOOPS(edge_points)
LOOPS(vertex_point)

/* Per pass: type, shape of the faces, components. */
#define ROW(pass, type, shape)                                                                                         \
    {                                                                                                                  \
        pass##_##type##_##shape##_1, pass##_##type##_##shape##_2, pass##_##type##_##shape##_3,                         \
            pass##_##type##_##shape##_4                                                                                \
    }
#define TABLE(pass)                                                                                                    \
    {                                                                                                                  \
        {ROW(pass, f32, polygons), ROW(pass, f32, quads)},                                                             \
        {                                                                                                              \
            ROW(pass, f64, polygons), ROW(pass, f64, quads)                                                            \
        }                                                                                                              \
    }
enum { FACE_PASS, EDGE_PASS, VERTEX_PASS, PASS_COUNT };
static const mt_parallel_body passes[PASS_COUNT][2][2][WIDTH_LIMIT] = {TABLE(face_point), TABLE(edge_points),
                                                                       TABLE(vertex_point)};

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
    bool quads = !topology->face_offsets;
    const mt_index *source = job->source;
    mt_index *target = job->target;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index first = mt_subdivide_face_begin(topology, face, quads);
        mt_index last = mt_subdivide_face_begin(topology, face + 1, quads);
        mt_index edge_point =
            topology->vertex_count + topology->face_count + topology->edge_ranks[quads ? face : first];
        target[topology->vertex_count + face] = source[topology->corner_vertices[first]];
        for (mt_index corner = first; corner < last; corner++) {
            if (mt_subdivide_is_first(topology, corner)) {
                target[edge_point++] = source[topology->corner_vertices[corner]];
            }
        }
    }
}

void mt_subdivide_values(mt_context *context, const mt_subdivide_topology *topology, mt_subdivide_rule rule,
                         mt_type type, uint32_t component_count, const void *source, void *target)
{
    bool wide = type == MT_F64, quads = !topology->face_offsets;
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
        mt_parallel_for(context, topology->face_count, MT_SUBDIVIDE_GRAIN, passes[FACE_PASS][wide][quads][width - 1],
                        &job);
        mt_parallel_for(context, topology->face_count, MT_SUBDIVIDE_GRAIN, passes[EDGE_PASS][wide][quads][width - 1],
                        &job);
        if (!job.linear) {
            mt_parallel_for(context, topology->vertex_count, MT_SUBDIVIDE_GRAIN,
                            passes[VERTEX_PASS][wide][quads][width - 1], &job);
        }
    }
}
