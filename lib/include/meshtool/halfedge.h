/* The half-edge structure (polygons, boundaries). Half-edges come in pairs: the twin of h is h ^ 1, and
 * edge e has the half-edges 2e and 2e + 1; 2e is the side of the lower corner, and edges are numbered in
 * the order of these. Boundary half-edges exist and have no face; they are linked into loops.
 *
 * There is no `previous` stored, so a closed triangle mesh takes 42 bytes a triangle: mt_halfedge_previous
 * finds it in two steps on a triangle and in one on the boundary, in a walk around any other face. */
#ifndef MESHTOOL_HALFEDGE_H
#define MESHTOOL_HALFEDGE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_halfedge {
    mt_index next; /* the following half-edge of the same face or boundary loop */
    mt_index head; /* the vertex it points to */
    mt_index face; /* MT_NONE on the boundary */
} mt_halfedge;

typedef struct mt_halfedge_mesh {
    mt_index vertex_count;
    mt_index face_count;
    mt_index halfedge_count; /* twice the edges */
    mt_halfedge *halfedges;
    mt_index *vertex_halfedge; /* a half-edge that points to the vertex, the boundary one where there is one;
                                  MT_NONE for isolated vertices */
    mt_index *face_halfedge;   /* the half-edge of the face's first corner's side */
} mt_halfedge_mesh;

/* Builds the structure from the mesh's faces; *out is NULL on failure. Never drops a face: MT_ERROR_NOT_MANIFOLD or
 * MT_ERROR_NOT_ORIENTED names the first offender (a face that names a vertex twice, else an edge of three faces or
 * more, else an edge along which two faces run in the same direction, else a vertex where several fans of faces meet),
 * and what can mend it. O(vertices + corners). */
mt_status mt_halfedge_create(mt_context *context, const mt_mesh *mesh, mt_halfedge_mesh **out);
void mt_halfedge_destroy(mt_context *context, mt_halfedge_mesh *structure); /* NULL is allowed */

/* Checks every invariant; MT_ERROR_INTERNAL with the first violation named. O(size). */
mt_status mt_halfedge_validate(mt_context *context, const mt_halfedge_mesh *structure);

/* Back to faces, in their order, each beginning with the tail of its face_halfedge, so that a mesh comes back as it
 * was. Positions are taken from `source`, which must have as many vertices; attributes do not follow. */
mt_status mt_halfedge_to_mesh(mt_context *context, const mt_halfedge_mesh *structure, const mt_mesh *source,
                              mt_mesh **out);

/* Bytes that the structure holds. */
uint64_t mt_halfedge_size(const mt_halfedge_mesh *structure);

static inline mt_index mt_halfedge_twin(mt_index halfedge)
{
    return halfedge ^ 1u;
}

static inline mt_index mt_halfedge_next(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge].next;
}

static inline mt_index mt_halfedge_head(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge].head;
}

static inline mt_index mt_halfedge_tail(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge ^ 1u].head;
}

static inline mt_index mt_halfedge_face(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge].face;
}

static inline bool mt_halfedge_is_boundary(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge].face == MT_NONE;
}

/* Whether either side of the edge has no face. */
static inline bool mt_halfedge_edge_is_boundary(const mt_halfedge_mesh *structure, mt_index edge)
{
    return mt_halfedge_is_boundary(structure, 2 * edge) || mt_halfedge_is_boundary(structure, 2 * edge + 1);
}

/* False for isolated vertices too. */
static inline bool mt_halfedge_vertex_is_boundary(const mt_halfedge_mesh *structure, mt_index vertex)
{
    mt_index halfedge = structure->vertex_halfedge[vertex];
    return halfedge != MT_NONE && mt_halfedge_is_boundary(structure, halfedge);
}

/* The half-edge whose next is this one. O(1) on triangles and the boundary, O(sides) on other faces. */
static inline mt_index mt_halfedge_previous(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    if (mt_halfedge_is_boundary(structure, halfedge)) {
        return structure->vertex_halfedge[mt_halfedge_tail(structure, halfedge)];
    }
    mt_index at = halfedge;
    while (structure->halfedges[at].next != halfedge) {
        at = structure->halfedges[at].next;
    }
    return at;
}

/* Around a face or a boundary loop: begin with face_halfedge and step with mt_halfedge_next until it is back there; the
 * neighbouring face is mt_halfedge_face(structure, h ^ 1). Around a vertex boundary half-edges close every ring. */

/* The next half-edge that points to the same vertex, clockwise seen from the front. O(1). */
static inline mt_index mt_halfedge_clockwise(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->halfedges[halfedge].next ^ 1u;
}

/* The same, counter-clockwise. Costs a mt_halfedge_previous. */
static inline mt_index mt_halfedge_counterclockwise(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return mt_halfedge_previous(structure, halfedge ^ 1u);
}

/* The ring of a vertex: its edges one after the other, each with the vertex at its other end and the face that follows
 * it counter-clockwise, MT_NONE where that is the outside; isolated vertices have none. On the boundary it begins with
 * the edge from which stepping counter-clockwise sweeps the whole fan.
 *
 *     for (mt_halfedge_ring ring = mt_halfedge_ring_begin(structure, vertex); mt_halfedge_ring_goes_on(&ring);
 *          mt_halfedge_ring_counterclockwise(structure, &ring)) {
 *         ring.neighbor; ring.halfedge; ring.face;
 *     }
 *
 * Clockwise begins with mt_halfedge_ring_begin_clockwise and meets the same edges in the opposite order, without
 * looking for a previous half-edge. */
typedef struct mt_halfedge_ring {
    mt_index neighbor; /* the vertex at the other end of the edge */
    mt_index face;     /* the face counter-clockwise of the edge */
    mt_index halfedge; /* the one that points to the ring's vertex; MT_NONE at the end */
    mt_index begin;    /* the half-edge that ends the ring */
} mt_halfedge_ring;

static inline bool mt_halfedge_ring_goes_on(const mt_halfedge_ring *ring)
{
    return ring->halfedge != MT_NONE;
}

static inline mt_halfedge_ring mt_halfedge_ring_at(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    mt_halfedge_ring ring = {MT_NONE, MT_NONE, halfedge, halfedge};
    if (halfedge != MT_NONE) {
        ring.neighbor = mt_halfedge_tail(structure, halfedge);
        ring.face = mt_halfedge_face(structure, halfedge ^ 1u);
    }
    return ring;
}

static inline void mt_halfedge_ring_go_to(const mt_halfedge_mesh *structure, mt_halfedge_ring *ring, mt_index halfedge)
{
    mt_index begin = ring->begin;
    *ring = mt_halfedge_ring_at(structure, halfedge == begin ? MT_NONE : halfedge);
    ring->begin = begin;
}

static inline mt_halfedge_ring mt_halfedge_ring_begin(const mt_halfedge_mesh *structure, mt_index vertex)
{
    return mt_halfedge_ring_at(structure, structure->vertex_halfedge[vertex]);
}

static inline void mt_halfedge_ring_counterclockwise(const mt_halfedge_mesh *structure, mt_halfedge_ring *ring)
{
    mt_halfedge_ring_go_to(structure, ring, mt_halfedge_counterclockwise(structure, ring->halfedge));
}

static inline mt_halfedge_ring mt_halfedge_ring_begin_clockwise(const mt_halfedge_mesh *structure, mt_index vertex)
{
    mt_index halfedge = structure->vertex_halfedge[vertex];
    return mt_halfedge_ring_at(structure, halfedge == MT_NONE ? MT_NONE : mt_halfedge_clockwise(structure, halfedge));
}

static inline void mt_halfedge_ring_clockwise(const mt_halfedge_mesh *structure, mt_halfedge_ring *ring)
{
    mt_halfedge_ring_go_to(structure, ring, mt_halfedge_clockwise(structure, ring->halfedge));
}

/* Edges at the vertex, 0 for isolated ones. O(valence). */
static inline mt_index mt_halfedge_valence(const mt_halfedge_mesh *structure, mt_index vertex)
{
    mt_index count = 0;
    for (mt_halfedge_ring ring = mt_halfedge_ring_begin_clockwise(structure, vertex); mt_halfedge_ring_goes_on(&ring);
         mt_halfedge_ring_clockwise(structure, &ring)) {
        count++;
    }
    return count;
}

/* For every vertex the sum of its neighbours' values, `component_count` doubles a vertex in both arrays, which must not
 * overlap; 0 for isolated vertices. Adds in the order of edges, so that the structure is read from front to back:
 * faster than walking around each vertex, several times where faces are in a random order. O(size). */
void mt_halfedge_sum_neighbors(const mt_halfedge_mesh *structure, const double *values, mt_index component_count,
                               double *sums);

#ifdef __cplusplus
}
#endif
#endif
