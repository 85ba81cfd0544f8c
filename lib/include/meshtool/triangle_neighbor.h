/* The triangle-neighbour structure (triangles only, boundaries): an indexed mesh and, per triangle, what lies across
 * each of its three sides.
 *
 * Corner 3t + k is the k-th of triangle t, and names the side from its vertex to the next corner's vertex too. The
 * packed form keeps per side the corner of the opposite side, 3 * triangle + side: so neither the previous triangle nor
 * the way around a vertex needs a search. The plain form keeps the neighbouring triangle alone, as textbooks first give
 * it; functions at the end convert between the two. Sides are not joined to edges and edges have no numbers; where one
 * is needed, the lower of the two corners names the edge.
 *
 * A closed mesh takes 26 bytes a triangle. */
#ifndef MESHTOOL_TRIANGLE_NEIGHBOR_H
#define MESHTOOL_TRIANGLE_NEIGHBOR_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_triangle_neighbor_mesh {
    mt_index vertex_count;
    mt_index triangle_count;
    mt_index *vertices;      /* 3 a triangle */
    mt_index *neighbors;     /* 3 a triangle: the corner of the opposite side, MT_NONE at the boundary */
    mt_index *vertex_corner; /* per vertex its highest corner, or, on the boundary, the one from which stepping
                                counter-clockwise sweeps the whole fan; MT_NONE for isolated vertices */
} mt_triangle_neighbor_mesh;

/* Builds the structure from a mesh of triangles; *out is NULL on failure. MT_ERROR_INVALID_MESH names the first face
 * that has more sides; MT_ERROR_NOT_MANIFOLD or MT_ERROR_NOT_ORIENTED the first offender that it cannot hold, in the
 * order of mt_halfedge_create. mt_split_non_manifold makes a mesh that it can. O(vertices + corners). */
mt_status mt_triangle_neighbor_create(mt_context *context, const mt_mesh *mesh, mt_triangle_neighbor_mesh **out);
void mt_triangle_neighbor_destroy(mt_context *context, mt_triangle_neighbor_mesh *structure); /* NULL is allowed */

/* Checks every invariant; MT_ERROR_INTERNAL with the first violation named. O(size). */
mt_status mt_triangle_neighbor_validate(mt_context *context, const mt_triangle_neighbor_mesh *structure);

/* Back to faces as they were, each beginning with its first corner. Positions are taken from `source`, which must have
 * as many vertices; attributes do not follow. */
mt_status mt_triangle_neighbor_to_mesh(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                       const mt_mesh *source, mt_mesh **out);

/* Bytes that the structure holds. */
uint64_t mt_triangle_neighbor_size(const mt_triangle_neighbor_mesh *structure);

/* The corners before and after in the same triangle. */
static inline mt_index mt_triangle_next_corner(mt_index corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

static inline mt_index mt_triangle_previous_corner(mt_index corner)
{
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/* The triangle of a corner; MT_NONE of MT_NONE. */
static inline mt_index mt_triangle_of_corner(mt_index corner)
{
    return corner == MT_NONE ? MT_NONE : corner / 3;
}

/* The triangle across a side, MT_NONE at the boundary. */
static inline mt_index mt_triangle_neighbor_across(const mt_triangle_neighbor_mesh *structure, mt_index corner)
{
    return mt_triangle_of_corner(structure->neighbors[corner]);
}

static inline bool mt_triangle_neighbor_is_boundary(const mt_triangle_neighbor_mesh *structure, mt_index corner)
{
    return structure->neighbors[corner] == MT_NONE;
}

/* The next corner at the same vertex, counter-clockwise seen from the front; MT_NONE past the boundary. */
static inline mt_index mt_triangle_neighbor_counterclockwise(const mt_triangle_neighbor_mesh *structure,
                                                             mt_index corner)
{
    return structure->neighbors[mt_triangle_previous_corner(corner)];
}

/* The same, clockwise. */
static inline mt_index mt_triangle_neighbor_clockwise(const mt_triangle_neighbor_mesh *structure, mt_index corner)
{
    mt_index across = structure->neighbors[corner];
    return across == MT_NONE ? MT_NONE : mt_triangle_next_corner(across);
}

/* False for isolated vertices too. */
static inline bool mt_triangle_neighbor_vertex_is_boundary(const mt_triangle_neighbor_mesh *structure, mt_index vertex)
{
    mt_index corner = structure->vertex_corner[vertex];
    return corner != MT_NONE && structure->neighbors[corner] == MT_NONE;
}

/* The ring of a vertex: its edges one after the other, each with the vertex at its other end and the triangle that
 * follows it counter-clockwise. On the boundary there is one triangle less than edges, and the ring knows:
 *
 *     for (mt_triangle_ring ring = mt_triangle_ring_begin(structure, vertex); mt_triangle_ring_goes_on(&ring);
 *          mt_triangle_ring_counterclockwise(structure, &ring)) {
 *         ring.neighbor; ring.side; mt_triangle_of_corner(ring.corner);
 *     }
 *
 * Clockwise begins with mt_triangle_ring_begin_clockwise and meets the same edges in the opposite order. */
typedef struct mt_triangle_ring {
    mt_index neighbor; /* the vertex at the other end of the edge */
    mt_index corner;   /* the vertex's corner in the triangle after the edge; MT_NONE where the boundary is */
    mt_index side;     /* the edge, as a side of that triangle, or of the one before it; MT_NONE at the end */
    mt_index begin;    /* the corner that ends the ring */
} mt_triangle_ring;

static inline bool mt_triangle_ring_goes_on(const mt_triangle_ring *ring)
{
    return ring->side != MT_NONE;
}

static inline mt_triangle_ring mt_triangle_ring_at(const mt_triangle_neighbor_mesh *structure, mt_index corner)
{
    mt_triangle_ring ring = {MT_NONE, corner, corner, corner};
    if (corner != MT_NONE) {
        ring.neighbor = structure->vertices[mt_triangle_next_corner(corner)];
    }
    return ring;
}

static inline mt_triangle_ring mt_triangle_ring_begin(const mt_triangle_neighbor_mesh *structure, mt_index vertex)
{
    return mt_triangle_ring_at(structure, structure->vertex_corner[vertex]);
}

static inline void mt_triangle_ring_counterclockwise(const mt_triangle_neighbor_mesh *structure, mt_triangle_ring *ring)
{
    if (ring->corner == MT_NONE) {
        ring->side = MT_NONE;
        return;
    }
    mt_index side = mt_triangle_previous_corner(ring->corner);
    mt_index corner = structure->neighbors[side];
    ring->neighbor = structure->vertices[side];
    ring->corner = corner;
    ring->side = corner == ring->begin ? MT_NONE : corner == MT_NONE ? side : corner;
}

/* At the edge that counter-clockwise comes last. O(valence) on the boundary. */
static inline mt_triangle_ring mt_triangle_ring_begin_clockwise(const mt_triangle_neighbor_mesh *structure,
                                                                mt_index vertex)
{
    mt_triangle_ring ring = mt_triangle_ring_begin(structure, vertex);
    if (!mt_triangle_ring_goes_on(&ring)) {
        return ring;
    }
    if (structure->neighbors[ring.corner] != MT_NONE) {
        return mt_triangle_ring_at(structure, mt_triangle_neighbor_clockwise(structure, ring.corner));
    }
    while (ring.corner != MT_NONE) {
        mt_triangle_ring_counterclockwise(structure, &ring);
    }
    ring.begin = MT_NONE;
    return ring;
}

static inline void mt_triangle_ring_clockwise(const mt_triangle_neighbor_mesh *structure, mt_triangle_ring *ring)
{
    mt_index corner = ring->corner == MT_NONE ? mt_triangle_next_corner(ring->side)
                                              : mt_triangle_neighbor_clockwise(structure, ring->corner);
    ring->corner = corner;
    ring->side = corner == ring->begin ? MT_NONE : corner;
    if (ring->side != MT_NONE) {
        ring->neighbor = structure->vertices[mt_triangle_next_corner(corner)];
    }
}

/* Around a triangle t the corners 3t, 3t + 1 and 3t + 2 give its vertices, its sides and its neighbours. */

/* Edges at the vertex, 0 for isolated ones. O(valence). */
static inline mt_index mt_triangle_neighbor_valence(const mt_triangle_neighbor_mesh *structure, mt_index vertex)
{
    mt_index count = 0;
    for (mt_triangle_ring ring = mt_triangle_ring_begin(structure, vertex); mt_triangle_ring_goes_on(&ring);
         mt_triangle_ring_counterclockwise(structure, &ring)) {
        count++;
    }
    return count;
}

/* For every vertex the sum of its neighbours' values, `component_count` doubles a vertex in both arrays, which must not
 * overlap; 0 for isolated vertices. Adds in the order of sides, so that the structure is read from front to back:
 * faster than walking around each vertex, several times where faces are in a random order. O(size). */
void mt_triangle_neighbor_sum_neighbors(const mt_triangle_neighbor_mesh *structure, const double *values,
                                        mt_index component_count, double *sums);

/* The plain form: fills `triangles` (3 a triangle, the caller's) with the triangle across each side, MT_NONE at the
 * boundary. O(triangles). */
void mt_triangle_neighbor_unpack(const mt_triangle_neighbor_mesh *structure, mt_index *triangles);

/* The packed form from the plain one: finds for every side its place in the neighbour. MT_ERROR_ARGUMENT names the
 * first triangle whose neighbour has no such side, or does not know it. O(triangles). */
mt_status mt_triangle_neighbor_pack(mt_context *context, mt_index vertex_count, mt_index triangle_count,
                                    const mt_index *vertices, const mt_index *triangles,
                                    mt_triangle_neighbor_mesh **out);

/* The triangle clockwise of `triangle` around `vertex` in the plain form, by search among its vertices; MT_NONE past
 * the boundary. */
static inline mt_index mt_plain_neighbor_clockwise(const mt_index *vertices, const mt_index *triangles,
                                                   mt_index triangle, mt_index vertex)
{
    const mt_index *corner = vertices + 3 * (size_t)triangle;
    mt_index side = corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2;
    return triangles[3 * (size_t)triangle + side];
}

#ifdef __cplusplus
}
#endif
#endif
