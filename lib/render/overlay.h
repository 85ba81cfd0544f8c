/* What is written over a finished picture. */
#ifndef MESHTOOL_RENDER_OVERLAY_H
#define MESHTOOL_RENDER_OVERLAY_H

#include "lib/render/series.h"

#include <meshtool/ink.h>

/* Draws axes and scale bar where they are asked for; fills the report. */
void mt_overlay_draw(const mt_preview_series *series, const mt_camera *camera, mt_image *image,
                     mt_preview_report *report);

/* A colour that can be read on the picture's background. */
mt_vec3 mt_overlay_color(const mt_preview_options *options);

#endif
