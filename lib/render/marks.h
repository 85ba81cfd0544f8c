/* Lines and dots laid over the mesh: those of the caller, and the wireframe. */
#ifndef MESHTOOL_RENDER_MARKS_H
#define MESHTOOL_RENDER_MARKS_H

#include "lib/render/model.h"

#include <meshtool/preview.h>

typedef struct mt_marks {
    mt_stroke *strokes; /* dots, then lines, then the wireframe */
    unsigned char *colors;
    mt_index count;
    mt_index wire_first; /* the first of the wireframe's */
} mt_marks;

mt_status mt_marks_init(mt_context *context, const mt_model *model, const mt_preview_options *options, mt_marks *marks);
void mt_marks_release(mt_context *context, mt_marks *marks);

#endif
