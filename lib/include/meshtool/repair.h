/* Mending a mesh, step by step, with an account of what was done. Nothing is done unasked. */
#ifndef MESHTOOL_REPAIR_H
#define MESHTOOL_REPAIR_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The steps, in the order in which they are taken: each needs what those before it leave. */
typedef enum mt_repair_step {
    MT_REPAIR_WELD,            /* vertices at the same place become one; with MT_REPAIR_SPLIT only those of connected
                                  parts that get fewer boundary sides or faces by it: others would be split again */
    MT_REPAIR_DROP_DEGENERATE, /* faces that name a vertex twice, and faces whose vertices all lie on one line */
    MT_REPAIR_DROP_DUPLICATES, /* faces with the vertices of an earlier face, in the same order or the reverse */
    MT_REPAIR_SPLIT,           /* vertices are copied until no edge has three faces and no vertex two fans */
    MT_REPAIR_ORIENT,          /* neighbours run alike, and closed components outwards */
    MT_REPAIR_FILL_HOLES,      /* boundary loops get triangles, but for the rim of a flat sheet: they would lie on it */
    MT_REPAIR_DROP_ISOLATED,   /* vertices in no face, wire or point */
    MT_REPAIR_STEP_COUNT
} mt_repair_step;

/* The step's JSON key and the option that asks for it: "drop_degenerate", "drop-degenerate". */
const char *mt_repair_step_key(mt_repair_step step);
const char *mt_repair_step_option(mt_repair_step step);

/* All zeros does nothing. */
typedef struct mt_repair_options {
    bool steps[MT_REPAIR_STEP_COUNT];
    double weld_tolerance; /* 0: only bit-equal positions; else the largest distance, in the mesh's units, at which a
                              vertex joins an earlier one */
    mt_index hole_sides_maximum; /* loops of more sides stay open; 0: none does for that */
} mt_repair_options;

/* What a step did. `count` is what it changed: vertices welded away, faces dropped or turned, vertices made by copying,
 * holes filled, vertices dropped. The lists name the faces and vertices by their numbers in the mesh that was given;
 * what the step made has its number in the mesh that results (copies made by split, triangles that fill holes). */
typedef struct mt_repair_result {
    bool asked;
    uint64_t count;
    uint64_t left_count; /* what the step met and could not mend: components that no turning orients, boundary loops
                            that are too long, or that no triangles fill without a new defect */
    uint64_t face_count, vertex_count;
    mt_index *faces;
    mt_index *vertices;
} mt_repair_result;

typedef struct mt_repair_report {
    mt_repair_result results[MT_REPAIR_STEP_COUNT];
} mt_repair_report;

/* Mends a copy of the mesh; attributes, labels and all else follow. Several steps are taken again until they change
 * nothing, so repairing the result with the same options changes nothing. MT_ERROR_ARGUMENT for a tolerance that is
 * negative or not a number. *report is filled on success, and released with mt_repair_report_release. */
mt_status mt_repair(mt_context *context, const mt_mesh *mesh, const mt_repair_options *options,
                    mt_repair_report *report, mt_mesh **out);
void mt_repair_report_release(mt_context *context, mt_repair_report *report);

#ifdef __cplusplus
}
#endif
#endif
