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
#ifndef LIB_ALGORITHMS_SUBDIVIDE_MASKS_H
#define LIB_ALGORITHMS_SUBDIVIDE_MASKS_H

#include "lib/algorithms/subdivide_pass.h"
#include "lib/algorithms/subdivide_sum.h"

/* In all below `wide` (f64), `sides` and `width` (components, at most this) are constants of each compiled loop. */
#define MT_SUBDIVIDE_WIDTH_LIMIT 4

MT_SUBDIVIDE_INLINE double load(const mt_subdivide_loop *loop, const void *values, mt_index vertex, unsigned component,
                                bool wide)
{
    size_t at = vertex * loop->stride + loop->offset + component;
    return wide ? ((const double *)values)[at] : (double)((const float *)values)[at];
}

MT_SUBDIVIDE_INLINE void store(const mt_subdivide_loop *loop, mt_index vertex, unsigned component, double value,
                               bool wide)
{
    size_t at = vertex * loop->stride + loop->offset + component;
    if (wide) {
        ((double *)loop->target)[at] = value;
    } else {
        ((float *)loop->target)[at] = (float)value;
    }
}

MT_SUBDIVIDE_INLINE void face_point(const mt_subdivide_loop *loop, mt_index face, bool wide, unsigned sides,
                                    unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, sides);
    mt_index count = mt_subdivide_face_begin(topology, face + 1, sides) - begin;
    const mt_index *vertices = topology->corner_vertices + begin;
    mt_index target = topology->vertex_count + face;
    for (unsigned k = 0; k < width; k++) {
        if (count == 4) {
            double a = load(loop, loop->source, vertices[0], k, wide),
                   b = load(loop, loop->source, vertices[1], k, wide);
            double c = load(loop, loop->source, vertices[2], k, wide),
                   d = load(loop, loop->source, vertices[3], k, wide);
            store(loop, target, k, ((a + c) + (b + d)) * 0.25, wide);
            continue;
        }
        mt_subdivide_sum sum = {0, 0};
        for (mt_index i = 0; i < count; i++) {
            mt_subdivide_sum_add(&sum, load(loop, loop->source, vertices[i], k, wide));
        }
        store(loop, target, k, mt_subdivide_sum_over(&sum, count), wide);
    }
}

/* The edge point of a first corner: of the ends alone at a boundary and in linear rules. */
MT_SUBDIVIDE_INLINE void edge_point(const mt_subdivide_loop *loop, mt_index corner, mt_index next, mt_index face,
                                    mt_index target, bool wide, unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index twin = topology->twins[corner];
    mt_index a = topology->corner_vertices[corner], b = topology->corner_vertices[next];
    bool sharp = loop->linear || twin == corner;
    mt_index left = topology->vertex_count + face;
    mt_index right = sharp ? left : topology->vertex_count + mt_subdivide_face(topology, twin, sides);
    for (unsigned k = 0; k < width; k++) {
        double ends = load(loop, loop->source, a, k, wide) + load(loop, loop->source, b, k, wide);
        double faces = load(loop, loop->target, left, k, wide) + load(loop, loop->target, right, k, wide);
        store(loop, target, k, sharp ? ends * 0.5 : (ends + faces) * 0.25, wide);
    }
}

MT_SUBDIVIDE_INLINE void edge_points(const mt_subdivide_loop *loop, mt_index face, bool wide, unsigned sides,
                                     unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index begin = mt_subdivide_face_begin(topology, face, sides);
    mt_index end = mt_subdivide_face_begin(topology, face + 1, sides);
    mt_index target = topology->vertex_count + topology->face_count + mt_subdivide_face_rank(topology, face, sides);
    for (mt_index corner = begin; corner < end; corner++) {
        if (mt_subdivide_is_first(topology, corner)) {
            edge_point(loop, corner, corner + 1 == end ? begin : corner + 1, face, target++, wide, sides, width);
        }
    }
}

/* 3/4 P + 1/8 + 1/8 of the neighbours along the boundary, or P. */
MT_SUBDIVIDE_INLINE void boundary_point(const mt_subdivide_loop *loop, mt_index vertex, mt_index a, mt_index b,
                                        bool wide, unsigned width)
{
    for (unsigned k = 0; k < width; k++) {
        double ends = load(loop, loop->source, a, k, wide) + load(loop, loop->source, b, k, wide);
        double old = load(loop, loop->source, vertex, k, wide);
        store(loop, vertex, k, loop->still_boundary ? old : old * 0.75 + ends * 0.125, wide);
    }
}

/* Interior, of valence 4: faces and far ends of the edges in their order around the vertex. */
MT_SUBDIVIDE_INLINE void regular_point(const mt_subdivide_loop *loop, mt_index vertex, const mt_index faces[4],
                                       const mt_index ends[4], bool wide, unsigned width)
{
    mt_index base = loop->topology->vertex_count;
    for (unsigned k = 0; k < width; k++) {
        double even_faces =
            load(loop, loop->target, base + faces[0], k, wide) + load(loop, loop->target, base + faces[2], k, wide);
        double odd_faces =
            load(loop, loop->target, base + faces[1], k, wide) + load(loop, loop->target, base + faces[3], k, wide);
        double even_ends = load(loop, loop->source, ends[0], k, wide) + load(loop, loop->source, ends[2], k, wide);
        double odd_ends = load(loop, loop->source, ends[1], k, wide) + load(loop, loop->source, ends[3], k, wide);
        double old = load(loop, loop->source, vertex, k, wide);
        store(loop, vertex, k, ((even_faces + odd_faces) + (even_ends + odd_ends)) * 0.0625 + old * 0.5, wide);
    }
}

MT_SUBDIVIDE_INLINE void irregular_point(const mt_subdivide_loop *loop, mt_index vertex, mt_index start, bool wide,
                                         unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_subdivide_sum sums[MT_SUBDIVIDE_WIDTH_LIMIT] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    double valence = 0;
    mt_index corner = start;
    do {
        mt_index face = topology->vertex_count + mt_subdivide_face(topology, corner, sides);
        mt_index end = topology->corner_vertices[mt_subdivide_next(topology, corner, sides)];
        for (unsigned k = 0; k < width; k++) {
            double old = load(loop, loop->source, vertex, k, wide);
            mt_subdivide_sum_add(&sums[k], load(loop, loop->target, face, k, wide) - old);
            mt_subdivide_sum_add(&sums[k], load(loop, loop->source, end, k, wide) - old);
        }
        valence += 1;
        corner = mt_subdivide_turn(topology, corner, sides);
    } while (corner != start);
    for (unsigned k = 0; k < width; k++) {
        double move = (sums[k].high + sums[k].low) / (valence * valence);
        store(loop, vertex, k, load(loop, loop->source, vertex, k, wide) + move, wide);
    }
}

/* The neighbours along the boundary of a vertex, whose corner `start` has the side that leaves along it. */
MT_SUBDIVIDE_INLINE void boundary_point_at(const mt_subdivide_loop *loop, mt_index vertex, mt_index start, bool wide,
                                           unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index previous = mt_subdivide_previous(topology, start, sides);
    while (topology->twins[previous] != previous) {
        previous = mt_subdivide_previous(topology, topology->twins[previous], sides);
    }
    mt_index a = topology->corner_vertices[mt_subdivide_next(topology, start, sides)];
    boundary_point(loop, vertex, a, topology->corner_vertices[previous], wide, width);
}

MT_SUBDIVIDE_INLINE void interior_point_at(const mt_subdivide_loop *loop, mt_index vertex, mt_index start, bool wide,
                                           unsigned sides, unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index faces[4], ends[4];
    unsigned valence = 0;
    mt_index corner = start;
    do {
        faces[valence] = mt_subdivide_face(topology, corner, sides);
        ends[valence++] = topology->corner_vertices[mt_subdivide_next(topology, corner, sides)];
        corner = mt_subdivide_turn(topology, corner, sides);
    } while (corner != start && valence < 4);
    if (corner == start && valence == 4) {
        regular_point(loop, vertex, faces, ends, wide, width);
    } else {
        irregular_point(loop, vertex, start, wide, sides, width);
    }
}

/* Any vertex, by a walk around it. */
MT_SUBDIVIDE_INLINE void vertex_point(const mt_subdivide_loop *loop, mt_index vertex, bool wide, unsigned sides,
                                      unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    if (start == MT_NONE) {
        for (unsigned k = 0; k < width; k++) {
            store(loop, vertex, k, load(loop, loop->source, vertex, k, wide), wide);
        }
    } else if (topology->twins[start] == start) {
        boundary_point_at(loop, vertex, start, wide, sides, width);
    } else {
        interior_point_at(loop, vertex, start, wide, sides, width);
    }
}

/* Faces and far ends of a vertex's edges, from its corners. */
MT_SUBDIVIDE_INLINE void regular_point_at(const mt_subdivide_loop *loop, mt_index vertex, const mt_index ring[4],
                                          bool wide, unsigned width)
{
    mt_index faces[4], ends[4];
    for (unsigned i = 0; i < 4; i++) {
        faces[i] = ring[i] >> 2;
        ends[i] = loop->topology->corner_vertices[mt_subdivide_next(loop->topology, ring[i], 4)];
    }
    regular_point(loop, vertex, faces, ends, wide, width);
}

/* An edge point of an earlier level, around which lay, when it was made, two children of each face of its edge: one,
 * `face`, had it at corner 4 face + 1; the other of that face, `after`, at 4 after + 3; across the edge those of the
 * other face. The corners of today are those, shifted by the age; their twins still lie in the same four. */
MT_SUBDIVIDE_INLINE void former_edge_point(const mt_subdivide_loop *loop, mt_index face, unsigned age, bool wide,
                                           unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
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
        boundary_point(loop, vertices[corner], a, b, wide, width);
        return;
    }
    mt_index across = (4 * (twin >> (age + 2)) + 3) << age;
    mt_index opposite = (4 * (twins[leaving] >> (age + 2)) + 1) << age;
    mt_index ring[4] = {corner, across, opposite, leaving};
    regular_point_at(loop, vertices[corner], ring, wide, width);
}

/* The points that an earlier level added, by the faces that it made, without a walk: the edge points by their first
 * corner, and the face point that the children 4i .. 4i+3 of a quad share. */
MT_SUBDIVIDE_INLINE void former_points(const mt_subdivide_loop *loop, mt_index face, unsigned age, bool wide,
                                       unsigned width)
{
    const mt_subdivide_topology *topology = loop->topology;
    former_edge_point(loop, face, age, wide, width);
    mt_index corner = (4 * face + 2) << age, step = 4u << age;
    mt_index vertex = topology->corner_vertices[corner];
    if ((face & 3) == 0 && vertex >= topology->vertex_corner_count) {
        mt_index ring[4] = {corner, corner + step, corner + 2 * step, corner + 3 * step};
        regular_point_at(loop, vertex, ring, wide, width);
    }
}

#endif
