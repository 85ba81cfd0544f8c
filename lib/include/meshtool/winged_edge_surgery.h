/* Surgery on the winged-edge structure; surgery.h says what each operation does and when it is allowed. An edge is
 * named by its number and, where its direction matters, the vertex from which it is meant to run. */
#ifndef MESHTOOL_WINGED_EDGE_SURGERY_H
#define MESHTOOL_WINGED_EDGE_SURGERY_H

#include <meshtool/edit_log.h>
#include <meshtool/surgery.h>
#include <meshtool/winged_edge.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Deleted: edges with head and tail MT_NONE, faces with face_edge MT_NONE, vertices with their mark. The inline
 * functions of winged_edge.h serve on `structure` for all that is left. */
typedef struct mt_winged_surgery {
    mt_winged_edge_mesh structure; /* counts include what is deleted */
    uint64_t vertex_capacity, face_capacity, edge_capacity;
    uint8_t *vertex_deleted;
    uint8_t *marks; /* a vertex each, 0 between calls */
    mt_edit_log log;
} mt_winged_surgery;

/* Works on a copy of `structure`. MT_ERROR_TOO_LARGE past 2147 million edges, here and where they are made. */
mt_status mt_winged_surgery_create(mt_context *context, const mt_winged_edge_mesh *structure, mt_winged_surgery **out);
void mt_winged_surgery_destroy(mt_context *context, mt_winged_surgery *surgery); /* NULL is allowed */

/* The edge between two vertices, MT_NONE when there is none or a vertex is deleted or out of range. O(valence). */
mt_index mt_winged_surgery_find(const mt_winged_surgery *surgery, mt_index vertex, mt_index other);

/* O(valence). */
mt_surgery_verdict mt_winged_can_swap_edge(const mt_winged_surgery *surgery, mt_index edge);
mt_status mt_winged_swap_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge);

/* From the vertex `tail` to the edge's other end; weight in [0, 1], else MT_ERROR_ARGUMENT. *vertex, which may be NULL,
 * receives the new vertex. New edges: from the new vertex to the edge's other end first, then those that cut triangles,
 * from the new vertex away. O(1). */
mt_surgery_verdict mt_winged_can_split_edge(const mt_winged_surgery *surgery, mt_index edge, mt_index tail);
mt_status mt_winged_split_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge, mt_index tail,
                               double weight, mt_index *vertex);

/* `from` and `to` are edges of the vertex; one of them may be MT_NONE. *out, which may be NULL, receives the new
 * vertex, which lies where the old one does. O(valence). */
mt_surgery_verdict mt_winged_can_split_vertex(const mt_winged_surgery *surgery, mt_index vertex, mt_index from,
                                              mt_index to);
mt_status mt_winged_split_vertex(mt_context *context, mt_winged_surgery *surgery, mt_index vertex, mt_index from,
                                 mt_index to, mt_index *out);

/* Moves the vertex `tail` into the edge's other end; weight in [0, 1], else MT_ERROR_ARGUMENT. O(valences + sides of
 * the faces at the tail and beside the edge). */
mt_surgery_verdict mt_winged_can_collapse_edge(const mt_winged_surgery *surgery, mt_index edge, mt_index tail);
mt_status mt_winged_collapse_edge(mt_context *context, mt_winged_surgery *surgery, mt_index edge, mt_index tail,
                                  double weight);

/* O(sides). */
mt_surgery_verdict mt_winged_can_remove_face(const mt_winged_surgery *surgery, mt_index face);
mt_status mt_winged_remove_face(mt_context *context, mt_winged_surgery *surgery, mt_index face);

/* `vertices` run counter-clockwise. *face, which may be NULL, receives the new face. O(valences). */
mt_surgery_verdict mt_winged_can_add_face(const mt_winged_surgery *surgery, mt_index count, const mt_index *vertices);
mt_status mt_winged_add_face(mt_context *context, mt_winged_surgery *surgery, mt_index count, const mt_index *vertices,
                             mt_index *face);

/* What is left, in its order, as a new structure. map may be NULL; on failure it is empty. O(size). */
mt_status mt_winged_surgery_compact(mt_context *context, const mt_winged_surgery *surgery, mt_surgery_map *map,
                                    mt_winged_edge_mesh **out);

/* What is left as a mesh, numbered as mt_winged_surgery_compact does, with everything that lies on `source`; as
 * mt_halfedge_surgery_to_mesh. O(size + log). */
mt_status mt_winged_surgery_to_mesh(mt_context *context, const mt_winged_surgery *surgery, const mt_mesh *source,
                                    mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
