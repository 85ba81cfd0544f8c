/* Surgery on the triangle-neighbour structure; surgery.h says what each operation does and when it is allowed. Edges
 * have no numbers here: a corner names the edge of its side, either of the two where there are two, and, where the
 * direction matters, the vertex from which it is meant to run is told. */
#ifndef MESHTOOL_TRIANGLE_NEIGHBOR_SURGERY_H
#define MESHTOOL_TRIANGLE_NEIGHBOR_SURGERY_H

#include <meshtool/edit_log.h>
#include <meshtool/surgery.h>
#include <meshtool/triangle_neighbor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Deleted: triangles whose vertices are MT_NONE, vertices with their mark. The inline functions of triangle_neighbor.h
 * serve on `structure` for all that is left; a vertex_corner need not be the highest. */
typedef struct mt_triangle_surgery {
    mt_triangle_neighbor_mesh structure; /* counts include what is deleted */
    uint64_t vertex_capacity, triangle_capacity;
    uint8_t *vertex_deleted;
    uint8_t *marks; /* a vertex each, 0 between calls */
    mt_edit_log log;
} mt_triangle_surgery;

/* Works on a copy of `structure`. MT_ERROR_TOO_LARGE past 715 million triangles, here and where they are made. */
mt_status mt_triangle_surgery_create(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                     mt_triangle_surgery **out);
void mt_triangle_surgery_destroy(mt_context *context, mt_triangle_surgery *surgery); /* NULL is allowed */

/* The side from tail to head, or, where that is the outside, the one from head to tail; MT_NONE when there is none or a
 * vertex is deleted or out of range. O(valence). */
mt_index mt_triangle_surgery_find(const mt_triangle_surgery *surgery, mt_index tail, mt_index head);

/* O(valence). */
mt_surgery_verdict mt_triangle_can_swap_edge(const mt_triangle_surgery *surgery, mt_index side);
mt_status mt_triangle_swap_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side);

/* From the vertex `tail` to the side's other end; weight in [0, 1], else MT_ERROR_ARGUMENT. *vertex, which may be NULL,
 * receives the new vertex. O(1). */
mt_surgery_verdict mt_triangle_can_split_edge(const mt_triangle_surgery *surgery, mt_index side, mt_index tail);
mt_status mt_triangle_split_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side, mt_index tail,
                                 double weight, mt_index *vertex);

/* `from` and `to` are sides with the vertex at an end; one of them may be MT_NONE. *out, which may be NULL, receives
 * the new vertex, which lies where the old one does. O(valence). */
mt_surgery_verdict mt_triangle_can_split_vertex(const mt_triangle_surgery *surgery, mt_index vertex, mt_index from,
                                                mt_index to);
mt_status mt_triangle_split_vertex(mt_context *context, mt_triangle_surgery *surgery, mt_index vertex, mt_index from,
                                   mt_index to, mt_index *out);

/* Moves the vertex `tail` into the side's other end; weight in [0, 1], else MT_ERROR_ARGUMENT. O(valences). */
mt_surgery_verdict mt_triangle_can_collapse_edge(const mt_triangle_surgery *surgery, mt_index side, mt_index tail);
mt_status mt_triangle_collapse_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side, mt_index tail,
                                    double weight);

/* O(1). */
mt_surgery_verdict mt_triangle_can_remove_face(const mt_triangle_surgery *surgery, mt_index triangle);
mt_status mt_triangle_remove_face(mt_context *context, mt_triangle_surgery *surgery, mt_index triangle);

/* `vertices` run counter-clockwise; `count` that is allowed is 3. *face, which may be NULL, receives the new triangle.
 * O(valences). */
mt_surgery_verdict mt_triangle_can_add_face(const mt_triangle_surgery *surgery, mt_index count,
                                            const mt_index *vertices);
mt_status mt_triangle_add_face(mt_context *context, mt_triangle_surgery *surgery, mt_index count,
                               const mt_index *vertices, mt_index *face);

/* What is left, in its order, as a new structure. map may be NULL; on failure it is empty; its edges are NULL.
 * O(size). */
mt_status mt_triangle_surgery_compact(mt_context *context, const mt_triangle_surgery *surgery, mt_surgery_map *map,
                                      mt_triangle_neighbor_mesh **out);

/* What is left as a mesh, numbered as mt_triangle_surgery_compact does, with everything that lies on `source`; as
 * mt_halfedge_surgery_to_mesh. O(size + log). */
mt_status mt_triangle_surgery_to_mesh(mt_context *context, const mt_triangle_surgery *surgery, const mt_mesh *source,
                                      mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
