/* What a picture of a scene did without, built and measured all the same. */
#ifndef MESHTOOL_RENDER_SCENE_MEASURE_H
#define MESHTOOL_RENDER_SCENE_MEASURE_H

#include "lib/render/scene_draw.h"

/* Draws once more in the ways that were not needed, into a picture that nobody sees. */
mt_status mt_scene_measure_skipped(mt_context *context, mt_scene_plan *plan, bool had_world, const mt_image *image);

#endif
