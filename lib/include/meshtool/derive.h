/* A new mesh from the elements of an old one: faces chosen, turned, re-ordered or added, vertices merged, copied or
 * dropped, with everything that lies on them. */
#ifndef MESHTOOL_DERIVE_H
#define MESHTOOL_DERIVE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Where the elements of the new mesh come from. A NULL array of sources means that the elements are those of the old
 * mesh in their order, and then the count must be the old one. MT_NONE as a source is a new element: its labels and
 * indexed values are none, its other values zero. */
typedef struct mt_derivation {
    uint64_t vertex_count;
    const mt_index *vertex_sources; /* new vertex -> old vertex */
    const mt_index *vertex_targets; /* old vertex -> new vertex, for wires, points and sharpness, which are dropped
                                       where it is MT_NONE; NULL: vertices keep their numbers */
    uint64_t face_count;
    mt_index face_size;           /* not 0: the sides of every new face; 0: face_offsets says */
    const mt_index *face_offsets; /* face_count + 1 first corners */
    const mt_index *face_sources; /* new face -> old face */
    uint64_t corner_count;
    const mt_index *corner_sources;  /* new corner -> old corner */
    const mt_index *corner_vertices; /* new corner -> new vertex; NULL: those of the old corners, by vertex_targets */
} mt_derivation;

/* Makes the mesh that the derivation describes; attributes, labels, wires, points and sharpness follow. A face that
 * runs the other way round than its source gets its corner and face normals turned. O(size), in parallel.
 * MT_ERROR_TOO_LARGE, MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_mesh_derive(mt_context *context, const mt_mesh *source, const mt_derivation *derivation, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
