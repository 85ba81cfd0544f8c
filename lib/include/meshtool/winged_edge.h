/* The winged-edge structure (polygons, boundaries): per edge its two vertices, its two faces, and the four edges that
 * come before and after it around these.
 *
 * Edges are numbered in the order of their first corners, as in halfedge.h; an edge runs from tail to head as its first
 * corner's side does, and that corner's face lies to its left. Outside the boundary lies no face, MT_NONE, but the
 * wings there are linked all the same, from one boundary edge to the next around the hole: so every ring is closed, and
 * no loop must turn back at the boundary.
 *
 * A closed mesh of triangles takes 54 bytes a triangle; while it is built some room more is held, and kept. */
#ifndef MESHTOOL_WINGED_EDGE_H
#define MESHTOOL_WINGED_EDGE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_winged_edge {
    mt_index head, tail;   /* vertices: the edge runs from tail to head */
    mt_index left, right;  /* faces, seen from the front along the edge; one of them is MT_NONE on the boundary */
    mt_index lprev, lnext; /* edges before and after this one, counter-clockwise around the left face */
    mt_index rprev, rnext; /* the same around the right face, which this edge passes from head to tail */
} mt_winged_edge;

typedef struct mt_winged_edge_mesh {
    mt_index vertex_count;
    mt_index face_count;
    mt_index edge_count;
    mt_winged_edge *edges;
    mt_index *vertex_edge; /* an edge of the vertex, on the boundary the one from which stepping counter-clockwise
                              sweeps the whole fan; MT_NONE for isolated vertices */
    mt_index *face_edge;   /* the edge of the face's first corner's side */
} mt_winged_edge_mesh;

/* Builds the structure from the mesh's faces; *out is NULL on failure. Refuses what mt_halfedge_create refuses, in the
 * same order; mt_split_non_manifold makes a mesh that it can hold. O(vertices + corners). */
mt_status mt_winged_edge_create(mt_context *context, const mt_mesh *mesh, mt_winged_edge_mesh **out);
void mt_winged_edge_destroy(mt_context *context, mt_winged_edge_mesh *structure); /* NULL is allowed */

/* Checks every invariant; MT_ERROR_INTERNAL with the first violation named. O(size). */
mt_status mt_winged_edge_validate(mt_context *context, const mt_winged_edge_mesh *structure);

/* Back to faces, in their order, each beginning where its face_edge begins, so that a mesh comes back as it was.
 * Positions are taken from `source`, which must have as many vertices; attributes do not follow. */
mt_status mt_winged_edge_to_mesh(mt_context *context, const mt_winged_edge_mesh *structure, const mt_mesh *source,
                                 mt_mesh **out);

/* Bytes that the structure holds. */
uint64_t mt_winged_edge_size(const mt_winged_edge_mesh *structure);

/* Steps. Which wing is meant depends on which way the edge runs, so each begins with that question; `vertex` must be an
 * end of the edge, `face` a side of it (MT_NONE: the outside of a boundary edge). O(1). */

/* The next edge at the vertex, counter-clockwise seen from the front. */
static inline mt_index mt_winged_edge_counterclockwise(const mt_winged_edge_mesh *structure, mt_index edge,
                                                       mt_index vertex)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->tail == vertex ? at->lprev : at->rprev;
}

/* The same, clockwise. */
static inline mt_index mt_winged_edge_clockwise(const mt_winged_edge_mesh *structure, mt_index edge, mt_index vertex)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->tail == vertex ? at->rnext : at->lnext;
}

/* The next edge around the face, counter-clockwise; around a hole for MT_NONE. */
static inline mt_index mt_winged_edge_next(const mt_winged_edge_mesh *structure, mt_index edge, mt_index face)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->left == face ? at->lnext : at->rnext;
}

/* The same, clockwise. */
static inline mt_index mt_winged_edge_previous(const mt_winged_edge_mesh *structure, mt_index edge, mt_index face)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->left == face ? at->lprev : at->rprev;
}

static inline mt_index mt_winged_edge_other_vertex(const mt_winged_edge_mesh *structure, mt_index edge, mt_index vertex)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->tail == vertex ? at->head : at->tail;
}

static inline mt_index mt_winged_edge_other_face(const mt_winged_edge_mesh *structure, mt_index edge, mt_index face)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->left == face ? at->right : at->left;
}

/* The vertex at which the edge's side of the face begins. */
static inline mt_index mt_winged_edge_origin(const mt_winged_edge_mesh *structure, mt_index edge, mt_index face)
{
    const mt_winged_edge *at = &structure->edges[edge];
    return at->left == face ? at->tail : at->head;
}

static inline bool mt_winged_edge_is_boundary(const mt_winged_edge_mesh *structure, mt_index edge)
{
    return structure->edges[edge].left == MT_NONE || structure->edges[edge].right == MT_NONE;
}

/* False for isolated vertices too. */
static inline bool mt_winged_edge_vertex_is_boundary(const mt_winged_edge_mesh *structure, mt_index vertex)
{
    mt_index edge = structure->vertex_edge[vertex];
    return edge != MT_NONE && mt_winged_edge_is_boundary(structure, edge);
}

/* The ring of a vertex: its edges one after the other, each with the vertex at its other end and the face that follows
 * it counter-clockwise, MT_NONE where that is the outside.
 *
 *     for (mt_winged_ring ring = mt_winged_ring_begin(structure, vertex); mt_winged_ring_goes_on(&ring);
 *          mt_winged_ring_counterclockwise(structure, &ring)) {
 *         ring.neighbor; ring.edge; ring.face;
 *     }
 *
 * Clockwise begins with mt_winged_ring_begin_clockwise and meets the same edges in the opposite order. */
typedef struct mt_winged_ring {
    mt_index neighbor;  /* the vertex at the other end of the edge */
    mt_index face;      /* the face counter-clockwise of the edge */
    mt_index edge;      /* MT_NONE at the end */
    mt_index vertex;    /* the ring's own */
    mt_index begin;     /* the edge that ends the ring */
    mt_index following; /* the edge counter-clockwise of this one */
    mt_index preceding; /* the edge clockwise of this one */
} mt_winged_ring;

static inline bool mt_winged_ring_goes_on(const mt_winged_ring *ring)
{
    return ring->edge != MT_NONE;
}

static inline void mt_winged_ring_go_to(const mt_winged_edge_mesh *structure, mt_winged_ring *ring, mt_index edge)
{
    const mt_winged_edge *at = &structure->edges[edge];
    bool leaves = at->tail == ring->vertex;
    ring->edge = edge;
    ring->neighbor = leaves ? at->head : at->tail;
    ring->face = leaves ? at->left : at->right;
    ring->following = leaves ? at->lprev : at->rprev;
    ring->preceding = leaves ? at->rnext : at->lnext;
}

static inline mt_winged_ring mt_winged_ring_begin(const mt_winged_edge_mesh *structure, mt_index vertex)
{
    mt_index edge = structure->vertex_edge[vertex];
    mt_winged_ring ring = {MT_NONE, MT_NONE, edge, vertex, edge, MT_NONE, MT_NONE};
    if (edge != MT_NONE) {
        mt_winged_ring_go_to(structure, &ring, edge);
    }
    return ring;
}

static inline void mt_winged_ring_counterclockwise(const mt_winged_edge_mesh *structure, mt_winged_ring *ring)
{
    if (ring->following == ring->begin) {
        ring->edge = MT_NONE;
    } else {
        mt_winged_ring_go_to(structure, ring, ring->following);
    }
}

/* At the edge that counter-clockwise comes last. */
static inline mt_winged_ring mt_winged_ring_begin_clockwise(const mt_winged_edge_mesh *structure, mt_index vertex)
{
    mt_winged_ring ring = mt_winged_ring_begin(structure, vertex);
    if (mt_winged_ring_goes_on(&ring)) {
        ring.begin = ring.preceding;
        mt_winged_ring_go_to(structure, &ring, ring.preceding);
    }
    return ring;
}

static inline void mt_winged_ring_clockwise(const mt_winged_edge_mesh *structure, mt_winged_ring *ring)
{
    if (ring->preceding == ring->begin) {
        ring->edge = MT_NONE;
    } else {
        mt_winged_ring_go_to(structure, ring, ring->preceding);
    }
}

/* Around a face or a hole, from its face_edge on:
 *
 *     mt_index begin = structure->face_edge[face], edge = begin;
 *     do {
 *         vertex: mt_winged_edge_origin(structure, edge, face); neighbour: mt_winged_edge_other_face(structure, edge,
 * face) edge = mt_winged_edge_next(structure, edge, face);     (or _previous) } while (edge != begin); */

/* Edges at the vertex, 0 for isolated ones. O(valence). */
static inline mt_index mt_winged_edge_valence(const mt_winged_edge_mesh *structure, mt_index vertex)
{
    mt_index count = 0;
    for (mt_winged_ring ring = mt_winged_ring_begin(structure, vertex); mt_winged_ring_goes_on(&ring);
         mt_winged_ring_counterclockwise(structure, &ring)) {
        count++;
    }
    return count;
}

#ifdef __cplusplus
}
#endif
#endif
