/* Faces that name a vertex more than once: no connectivity structure can hold them. */
#ifndef MESHTOOL_DEGENERATE_FACES_H
#define MESHTOOL_DEGENERATE_FACES_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sets flags[face] (1 a face, the caller's) to 1 for faces that name a vertex more than once and 0 for others, and
 * counts them. O(corners) time; 4 bytes a vertex meanwhile when a face has more than 8 sides. */
mt_status mt_find_degenerate_faces(mt_context *context, const mt_mesh *mesh, uint8_t *flags, mt_index *count);

#ifdef __cplusplus
}
#endif
#endif
