/* The mesh under repair, and where its elements come from. */
#ifndef MT_ALGORITHMS_REPAIR_STATE_H
#define MT_ALGORITHMS_REPAIR_STATE_H

#include <meshtool/derive.h>
#include <meshtool/repair.h>

typedef struct repair_state {
    mt_context *context;
    mt_mesh *mesh;
    mt_index *face_origins;   /* face -> face of the mesh that was given; MT_NONE: made since */
    mt_index *vertex_origins; /* the same for vertices; a copy has the origin of its original */
} repair_state;

mt_status mt_repair_state_init(mt_context *context, const mt_mesh *mesh, repair_state *state);
void mt_repair_state_release(repair_state *state);

/* Appends a number to one of the result's lists. */
mt_status mt_repair_note_face(mt_context *context, mt_repair_result *result, mt_index face);
mt_status mt_repair_note_vertex(mt_context *context, mt_repair_result *result, mt_index vertex);

/* Replaces the mesh by one derived from it; the origins follow. */
mt_status mt_repair_replace(repair_state *state, const mt_derivation *derivation);

/* Drops the faces whose flag is not 0, and notes and counts them. */
mt_status mt_repair_drop_faces(repair_state *state, const uint8_t *drop, mt_repair_result *result);

/* Makes vertices of the same number one, and notes and counts those that joined an earlier one. */
mt_status mt_repair_join(repair_state *state, const mt_index *numbers, mt_index distinct_count,
                         mt_repair_result *result);

/* Gives vertices numbers of their own again where the split would undo joining them. */
mt_status mt_repair_choose_welds(repair_state *state, const mt_repair_options *options, mt_index *numbers,
                                 mt_index *distinct_count);

/* The steps, each in a file of its own. */
mt_status mt_repair_weld(repair_state *state, const mt_repair_options *options, mt_repair_result *result);
mt_status mt_repair_drop_degenerate(repair_state *state, mt_repair_result *result);
mt_status mt_repair_drop_duplicates(repair_state *state, mt_repair_result *result);
mt_status mt_repair_split(repair_state *state, mt_repair_result *result);
mt_status mt_repair_orient(repair_state *state, mt_repair_result *result);
mt_status mt_repair_fill_holes(repair_state *state, const mt_repair_options *options, mt_repair_result *result);
mt_status mt_repair_drop_isolated(repair_state *state, mt_repair_result *result);

#endif
