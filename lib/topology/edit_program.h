/* The log of surgery, read once: which element of the source each element that is left has its values from, and what
 * must be mixed on the way. Then each attribute runs through the mixing alone. */
#ifndef MT_TOPOLOGY_EDIT_PROGRAM_H
#define MT_TOPOLOGY_EDIT_PROGRAM_H

#include "lib/topology/surgery_mesh.h"

/* A slot is an element of the source, or element_count + k for the result of step k, or MT_NONE: no values. */
typedef struct mt_edit_step {
    bool is_wedge;
    mt_index own;              /* of a wedge: the corner's slot until then */
    mt_index end[2];           /* of a wedge: the slots at the same end in the faces beside the edge */
    mt_index kept[2], gone[2]; /* the slots to be mixed: for a wedge by face, otherwise the first ones */
    double weight;             /* of `gone` */
} mt_edit_step;

typedef struct mt_edit_program {
    mt_index element_count; /* of the source */
    mt_index step_count;
    mt_edit_step *steps;
} mt_edit_program;

/* All that the log says of one mesh. */
typedef struct mt_edit_reading {
    mt_index vertex_count, face_count, corner_count;    /* of what is left */
    mt_index *vertex_numbers;                           /* per vertex of the surgery the new number */
    mt_index *vertex_targets;                           /* per vertex of the source the new one that it went into */
    mt_index *vertex_slots, *face_slots, *corner_slots; /* per new element; faces have no steps */
    mt_edit_program vertices, corners;
} mt_edit_reading;

/* with_corners: whether the source has values on corners; otherwise corner_slots are MT_NONE. */
mt_status mt_edit_read(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                       const mt_surgery_shape *shape, bool with_corners, mt_edit_reading *reading);
void mt_edit_reading_release(mt_context *context, mt_edit_reading *reading);

/* Sets the attribute's values on the elements of `slots` (count of them) that have no source of their own:
 * sources[i] MT_NONE. `source` is the attribute before surgery. */
mt_status mt_edit_program_run(mt_context *context, const mt_edit_program *program, const mt_attribute *source,
                              const mt_index *slots, const mt_index *sources, mt_index count, mt_attribute *target);

#endif
