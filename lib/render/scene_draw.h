/* From a compiled scene to a picture. */
#ifndef MESHTOOL_RENDER_SCENE_DRAW_H
#define MESHTOOL_RENDER_SCENE_DRAW_H

#include "lib/render/scene_plan.h"

#include <meshtool/image.h>

/* Draws into an image of the plan's size; parts are built as rays come near them. */
mt_status mt_scene_draw(mt_context *context, mt_scene_plan *plan, mt_image *image, mt_scene_report *report);

#endif
