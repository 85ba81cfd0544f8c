/* Surgery on the half-edge structure; surgery.h says what each operation does and when it is allowed. */
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

/* The half-edge from tail to head, MT_NONE when there is none or a vertex is deleted or out of range. O(valence). */
mt_index mt_halfedge_surgery_find(const mt_halfedge_surgery *surgery, mt_index tail, mt_index head);

/* O(valence). */
mt_surgery_verdict mt_halfedge_can_swap_edge(const mt_halfedge_surgery *surgery, mt_index edge);
mt_status mt_halfedge_swap_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index edge);

/* From the half-edge's tail to its head; weight in [0, 1], else MT_ERROR_ARGUMENT. *vertex, which may be NULL, receives
 * the new vertex. O(sides). */
mt_surgery_verdict mt_halfedge_can_split_edge(const mt_halfedge_surgery *surgery, mt_index halfedge);
mt_status mt_halfedge_split_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, double weight,
                                 mt_index *vertex);

/* `from` and `to` are half-edges that point to the vertex; one of them may be MT_NONE. *out, which may be NULL,
 * receives the new vertex, which lies where the old one does. O(valence + sides). */
mt_surgery_verdict mt_halfedge_can_split_vertex(const mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                                mt_index to);
mt_status mt_halfedge_split_vertex(mt_context *context, mt_halfedge_surgery *surgery, mt_index vertex, mt_index from,
                                   mt_index to, mt_index *out);

/* Moves the half-edge's tail into its head; weight in [0, 1], else MT_ERROR_ARGUMENT. O(valences + sides of the faces
 * at the tail). */
mt_surgery_verdict mt_halfedge_can_collapse_edge(const mt_halfedge_surgery *surgery, mt_index halfedge);
mt_status mt_halfedge_collapse_edge(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge,
                                    double weight);

/* O(sides). */
mt_surgery_verdict mt_halfedge_can_remove_face(const mt_halfedge_surgery *surgery, mt_index face);
mt_status mt_halfedge_remove_face(mt_context *context, mt_halfedge_surgery *surgery, mt_index face);

/* `vertices` run counter-clockwise. *face, which may be NULL, receives the new face. O(valences). */
mt_surgery_verdict mt_halfedge_can_add_face(const mt_halfedge_surgery *surgery, mt_index count,
                                            const mt_index *vertices);
mt_status mt_halfedge_add_face(mt_context *context, mt_halfedge_surgery *surgery, mt_index count,
                               const mt_index *vertices, mt_index *face);

/* What is left, in its order, as a new structure. map may be NULL; on failure it is empty. O(size). */
mt_status mt_halfedge_surgery_compact(mt_context *context, const mt_halfedge_surgery *surgery, mt_surgery_map *map,
                                      mt_halfedge_mesh **out);

/* What is left as a mesh, numbered as mt_halfedge_surgery_compact does, with everything that lies on `source`, the mesh
 * of which the structure was made: positions, attributes, labels, wires, points, creases and sharp vertices, as the log
 * says (edit_log.h). An added face has no parent: no labels, no indexed values, zero for other values, at its corners
 * too. MT_ERROR_ARGUMENT when the log was off or the source has other counts. O(size + log). */
mt_status mt_halfedge_surgery_to_mesh(mt_context *context, const mt_halfedge_surgery *surgery, const mt_mesh *source,
                                      mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
