/* Surgery on the half-edge structure. Elements keep their numbers while one works; what is deleted leaves a gap until
 * mt_halfedge_surgery_compact. Every operation has a predicate; one that is not allowed changes nothing and is
 * MT_ERROR_ARGUMENT; one that runs out of memory changes nothing either. Values follow by the log (edit_log.h). */
#ifndef MESHTOOL_HALFEDGE_SURGERY_H
#define MESHTOOL_HALFEDGE_SURGERY_H

#include <meshtool/edit_log.h>
#include <meshtool/halfedge.h>
#include <meshtool/surgery.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Deleted: half-edges with head MT_NONE, faces with face_halfedge MT_NONE, vertices with their mark. The inline
 * functions of halfedge.h serve on `structure` for all that is left. */
typedef struct mt_halfedge_surgery {
    mt_halfedge_mesh structure; /* counts include what is deleted */
    uint64_t vertex_capacity, face_capacity, halfedge_capacity;
    uint8_t *vertex_deleted;
    uint8_t *marks; /* a vertex each, 0 between calls */
    mt_edit_log log;
} mt_halfedge_surgery;

/* Works on a copy of `structure`. */
mt_status mt_halfedge_surgery_create(mt_context *context, const mt_halfedge_mesh *structure, mt_halfedge_surgery **out);
void mt_halfedge_surgery_destroy(mt_context *context, mt_halfedge_surgery *surgery); /* NULL is allowed */

/* Turns the edge between two triangles counter-clockwise to join their other corners. O(valence). */
mt_surgery_verdict mt_halfedge_can_swap_edge(const mt_halfedge_surgery *surgery, mt_index edge);
mt_status mt_halfedge_swap_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge);

/* Puts a vertex on the edge, `weight` of the way from the tail of 2 * edge to its head. Triangles beside it are cut in
 * two; other faces gain a side. *vertex, which may be NULL, receives the new vertex. O(sides). */
mt_surgery_verdict mt_halfedge_can_split_edge(const mt_halfedge_surgery *surgery, mt_index edge);
mt_status mt_halfedge_split_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge, double weight,
                                 mt_index *vertex);

/* Moves the half-edge's tail into its head, which goes `weight` of the way to the tail; the triangles beside it vanish.
 * Allowed when the link condition holds, with the boundary closed by an imagined vertex (Dey, Edelsbrunner, Guha,
 * Nekhayev 1999). O(valence + sides around the ends). */
mt_surgery_verdict mt_halfedge_can_collapse_edge(const mt_halfedge_surgery *surgery, mt_index halfedge);
mt_status mt_halfedge_collapse_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge,
                                    double weight);

/* Old to new numbers, MT_NONE for what is deleted; edges and half-edges keep their sides. */
typedef struct mt_surgery_map {
    mt_index *vertices, *edges, *faces;
} mt_surgery_map;
void mt_surgery_map_release(mt_context *context, mt_surgery_map *map);

/* What is left, in its order, as a new structure. On failure *map is empty. O(size). */
mt_status mt_halfedge_surgery_compact(mt_context *context, const mt_halfedge_surgery *surgery, mt_surgery_map *map,
                                      mt_halfedge_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
