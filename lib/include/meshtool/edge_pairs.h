/* Edge pairing: which corners' sides lie on the same edge. Everything that needs connectivity starts
 * from this; nothing pairs edges by itself.
 *
 * Corner c of a face has the side from its vertex to the next corner's vertex. Side and corner are
 * used for each other. An edge is an unordered pair of distinct vertices that is a side of some face. */
#ifndef MESHTOOL_EDGE_PAIRS_H
#define MESHTOOL_EDGE_PAIRS_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_edge_class {
    MT_EDGE_NONE,        /* a side a = b counts as no side */
    MT_EDGE_BOUNDARY,    /* one side */
    MT_EDGE_REGULAR,     /* two sides in opposite directions */
    MT_EDGE_MISORIENTED, /* two sides in the same direction */
    MT_EDGE_NON_MANIFOLD /* three sides or more */
} mt_edge_class;

typedef struct mt_edge_pairs {
    mt_index corner_count;
    mt_index edge_count; /* of all four classes */
    mt_index boundary_count;
    mt_index regular_count;
    mt_index misoriented_count;
    mt_index non_manifold_count;
    mt_index degenerate_side_count;
    mt_index *next_side; /* per corner the corner before it with the same edge, in descending order, and from the
                            first to the last: itself at a boundary, the twin at a regular edge; MT_NONE for a = b */
} mt_edge_pairs;

/* Pairs all sides; *out is NULL on failure. O(vertices + corners) time whatever the valences, in parallel with
 * the same result for any number of threads; keeps 4 bytes a corner and needs about 12 more meanwhile. */
mt_status mt_edge_pairs_create(mt_context *context, const mt_mesh *mesh, mt_edge_pairs **out);

/* NULL is allowed. */
void mt_edge_pairs_destroy(mt_context *context, mt_edge_pairs *pairs);

/* The class of the edge of a corner's side. O(1). */
static inline mt_edge_class mt_edge_class_of(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index corner)
{
    mt_index other = pairs->next_side[corner];
    if (other == MT_NONE) {
        return MT_EDGE_NONE;
    }
    if (other == corner) {
        return MT_EDGE_BOUNDARY;
    }
    if (pairs->next_side[other] != corner) {
        return MT_EDGE_NON_MANIFOLD;
    }
    bool same_start = mesh->corner_vertices[other] == mesh->corner_vertices[corner];
    return same_start ? MT_EDGE_MISORIENTED : MT_EDGE_REGULAR;
}

/* The twin across a regular edge, MT_NONE otherwise. O(1). */
static inline mt_index mt_edge_twin(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index corner)
{
    return mt_edge_class_of(mesh, pairs, corner) == MT_EDGE_REGULAR ? pairs->next_side[corner] : MT_NONE;
}

/* Whether the corner is the lowest of its edge: edges are numbered in the order of these. The ring descends but
 * for the step up from its first side to its last. O(1). */
static inline bool mt_edge_is_first(const mt_edge_pairs *pairs, mt_index corner)
{
    mt_index other = pairs->next_side[corner];
    return other != MT_NONE && other >= corner;
}

/* Stores the faces of the edge of a first corner in `faces`, ascending, at most `room` of them; one that has the edge
 * twice comes twice. Returns how many sides the edge has. */
mt_index mt_edge_faces(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first, mt_index room, mt_index *faces);

#ifdef __cplusplus
}
#endif
#endif
