/* Splitting what no connectivity structure can hold, until it can: every builder takes the result, unless two faces run
 * along an edge in the same direction, which is for orientation to mend. */
#ifndef MESHTOOL_SPLIT_NON_MANIFOLD_H
#define MESHTOOL_SPLIT_NON_MANIFOLD_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a copy of the mesh in which vertices are repeated so that
 * - an edge of three faces or more is cut, but where two of them still meet around one of its ends,
 * - a vertex where several fans of faces meet is one vertex a fan,
 * - a face that names a vertex more than once names copies of it, and
 * - a face given twice in the same direction is cut free of the other.
 * Faces keep their numbers, corners and positions; none is dropped. Old vertices keep their numbers and new ones
 * follow; one of its fans keeps a vertex's number. What needs no splitting stays as it is, other misoriented edges too.
 * Attributes, labels, wires and sharpness follow; a new edge is as sharp as the one that it comes from.
 *
 * *vertex_sources (NULL: not wanted) receives per vertex of *out the vertex that it is a copy of; free it with mt_free.
 * O(vertices + corners) time; some 40 bytes a corner meanwhile. *out is NULL on failure: MT_ERROR_TOO_LARGE,
 * MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_split_non_manifold(mt_context *context, const mt_mesh *mesh, mt_mesh **out, mt_index **vertex_sources);

#ifdef __cplusplus
}
#endif
#endif
