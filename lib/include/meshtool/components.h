/* Connected components of faces, and whether faces could be turned to agree. */
#ifndef MESHTOOL_COMPONENTS_H
#define MESHTOOL_COMPONENTS_H

#include <meshtool/edge_pairs.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_components {
    mt_index component_count;
    bool orientable; /* faces could be turned so that every edge of two sides had them in opposite directions;
                        edges of three sides or more ask for nothing */
    mt_index unorientable_corner; /* the first corner whose edge contradicts, MT_NONE when orientable */
    mt_index face_count;
    mt_index *face_component; /* numbered in the order of their first faces; NULL unless asked for */
    uint8_t *face_turned;     /* 1 where the face runs against the first face of its component; NULL unless asked for */
} mt_components;

/* Joins faces across shared edges, of however many sides. With `details` face_component and face_turned are kept.
 * O(corners) time but for the inverse Ackermann function; 4 bytes a face meanwhile. */
mt_status mt_components_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, bool details,
                               mt_components **out);
void mt_components_destroy(mt_context *context, mt_components *components); /* NULL is allowed */

#ifdef __cplusplus
}
#endif
#endif
