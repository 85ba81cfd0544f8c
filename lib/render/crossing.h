/* Triangles some of whose corners are beside or behind the eye, for shading; for drawing see triangle.h. */
#ifndef MESHTOOL_RENDER_CROSSING_H
#define MESHTOOL_RENDER_CROSSING_H

#include "lib/render/frame.h"

/* The weights of the corners over the picture, as in mt_facet with x = y = 0. */
void mt_crossing_forms(const mt_frame *frame, mt_index triangle, double forms[3][3]);

#endif
