/* The half-edge structure (polygons, boundaries). Half-edges come in pairs: the twin of h is h ^ 1, and
 * edge e has the half-edges 2e and 2e + 1; 2e is the side of the lower corner, and edges are numbered in
 * the order of these. Boundary half-edges exist and have no face; they are linked into loops. */
#ifndef MESHTOOL_HALFEDGE_H
#define MESHTOOL_HALFEDGE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_halfedge_mesh {
    mt_index vertex_count;
    mt_index face_count;
    mt_index halfedge_count; /* twice the edges */
    mt_index *next;          /* following half-edge of the same face or boundary loop */
    mt_index *previous;
    mt_index *head;            /* the vertex it points to */
    mt_index *face;            /* MT_NONE on the boundary */
    mt_index *vertex_halfedge; /* one half-edge pointing to the vertex, a boundary one where there is one;
                                  MT_NONE for isolated vertices */
    mt_index *face_halfedge;   /* the half-edge of the face's first corner's side */
} mt_halfedge_mesh;

/* Builds the structure. MT_ERROR_NOT_MANIFOLD or MT_ERROR_NOT_ORIENTED names the first offender (edge, vertex
 * or degenerate face). O(corners). */
mt_status mt_halfedge_create(mt_context *context, const mt_mesh *mesh, mt_halfedge_mesh **out);
void mt_halfedge_destroy(mt_context *context, mt_halfedge_mesh *structure);

/* Checks every invariant; MT_ERROR_INTERNAL with the first violation named. O(size). */
mt_status mt_halfedge_validate(mt_context *context, const mt_halfedge_mesh *structure);

/* Back to faces, each beginning at its face_halfedge's tail; positions are taken from `source`, which must have the
 * same vertices. */
mt_status mt_halfedge_to_mesh(mt_context *context, const mt_halfedge_mesh *structure, const mt_mesh *source,
                              mt_mesh **out);

static inline mt_index mt_halfedge_twin(mt_index halfedge)
{
    return halfedge ^ 1u;
}

static inline mt_index mt_halfedge_tail(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->head[halfedge ^ 1u];
}

static inline bool mt_halfedge_is_boundary(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->face[halfedge] == MT_NONE;
}

/* The next half-edge, clockwise, that points to the same vertex. */
static inline mt_index mt_halfedge_next_around_head(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->next[halfedge] ^ 1u;
}

/* The same, counter-clockwise. */
static inline mt_index mt_halfedge_previous_around_head(const mt_halfedge_mesh *structure, mt_index halfedge)
{
    return structure->previous[halfedge ^ 1u];
}

#ifdef __cplusplus
}
#endif
#endif
