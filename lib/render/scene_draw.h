/* From a compiled scene to a picture. */
#ifndef MESHTOOL_RENDER_SCENE_DRAW_H
#define MESHTOOL_RENDER_SCENE_DRAW_H

#include "lib/render/scene_world.h"

#include <meshtool/image.h>

/* Draws into an image of the plan's size; parts are built as rays come near them. world: what samples see first; NULL:
 * their rays ask the plan. */
mt_status mt_scene_draw(mt_context *context, mt_scene_plan *plan, const mt_scene_world *world, mt_image *image,
                        mt_scene_report *report);

#endif
