/* What the colours of faces stand for. */
#ifndef MESHTOOL_RENDER_COLORING_H
#define MESHTOOL_RENDER_COLORING_H

#include "lib/render/look.h"

#include <meshtool/preview.h>

/* sRGB triples, one a face, for the colourings that have them; *out is NULL for the others. Free with mt_free. */
mt_status mt_coloring_faces(mt_context *context, const mt_model *model, mt_coloring coloring, unsigned char **out);

/* Changes the look to what the colouring shows. */
void mt_coloring_apply(const mt_preview_options *options, mt_look *look);

/* The quality of a triangle: twice the radius of the circle inside by that of the one around; 0 without an area. */
double mt_radius_ratio(mt_vec3 a, mt_vec3 b, mt_vec3 c);

#endif
