/* What surgery did to the things that lie on a mesh: values on vertices, faces, corners and edges. The log speaks of
 * numbers that all structures share, a corner is named by its face and its vertex, so one function lets everything
 * follow whatever the structure (mt_halfedge_surgery_to_mesh and its likes). 40 bytes an entry; a collapse writes one
 * for each face and edge around its ends.
 *
 * What follows from it, by operation: the corners that a swap makes copy what the other face had at their vertices. The
 * vertex on a split edge mixes the ends, its corners those of their own face, new faces are copies of the ones they
 * were part of, and both halves of the edge keep its sharpness. Both ends of a split vertex are copies; a triangle that
 * opens between them copies the face on the new vertex's side, else the one on the other. A collapse mixes the ends;
 * corners mix with the sheet that they belong to (MT_EDIT_WEDGE); two edges that become one keep the larger sharpness,
 * two vertices likewise. A swapped edge loses its sharpness, one whose faces are removed keeps it. An added face has no
 * values, nor have its corners: nothing says from where. */
#ifndef MESHTOOL_EDIT_LOG_H
#define MESHTOOL_EDIT_LOG_H

#include <meshtool/context.h>

#ifdef __cplusplus
extern "C" {
#endif

/* "mix(a, b)" is (1 - weight) * a + weight * b as the attribute's interpolation says; where values are copied and not
 * mixed, or one of the two is none, it is the heavier one, a at equal weight. */
typedef enum mt_edit_kind {
    MT_EDIT_VERTEX,  /* vertex target = mix(vertex a, vertex b) */
    MT_EDIT_MERGE,   /* vertex a is deleted, and its wires, points and sharpness pass to vertex target */
    MT_EDIT_FACE,    /* face target = face a */
    MT_EDIT_CORNER,  /* corner (target, target_vertex) = mix(corner (a, a_vertex), corner (b, b_vertex)) */
    MT_EDIT_WEDGE,   /* a face `target` at an end `a_vertex` of a collapsed edge, from b_vertex to target_vertex, with
                        faces a and b (each may be MT_NONE) beside it: when its corner there has the value that face a
                        has at that end, corner (target, target_vertex) = mix(corner (a, target_vertex),
                        corner (a, b_vertex)); else the same with face b; else it keeps its value, wherever the corner
                        goes. So values continuous across the edge stay so, and seams stay seams. */
    MT_EDIT_EDGE,    /* the edge of vertices target, target_vertex has the larger of its own value and that of the edge
                        a, a_vertex */
    MT_EDIT_NO_EDGE, /* the edge target, target_vertex loses its value */
} mt_edit_kind;

typedef struct mt_edit {
    mt_edit_kind kind;
    mt_index target, target_vertex;
    mt_index a, a_vertex;
    mt_index b, b_vertex;
    double weight;
} mt_edit;

typedef struct mt_edit_log {
    mt_index vertex_count, face_count; /* of the structure when the log began */
    bool is_off;                       /* nothing is recorded; may be set before the first operation */
    uint64_t count, capacity;
    mt_edit *edits;
} mt_edit_log;

/* Makes room for `more` entries. */
mt_status mt_edit_log_reserve(mt_context *context, mt_edit_log *log, uint64_t more);
void mt_edit_log_release(mt_context *context, mt_edit_log *log);

/* Appends, unless the log is off; room must have been reserved. */
void mt_edit_log_add(mt_edit_log *log, const mt_edit *edit);

#ifdef __cplusplus
}
#endif
#endif
