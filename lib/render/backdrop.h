/* What is behind the mesh. */
#ifndef MESHTOOL_RENDER_BACKDROP_H
#define MESHTOOL_RENDER_BACKDROP_H

#include "lib/render/surface.h"

#include <meshtool/preview.h>

/* Linear light from behind the mesh; transparent: none, and the picture has alpha. */
typedef struct mt_backdrop {
    mt_vec3 top, bottom;
    bool transparent;
} mt_backdrop;

static inline mt_vec3 mt_backdrop_at(const mt_backdrop *backdrop, uint32_t y, uint32_t height)
{
    double t = (y + 0.5) / height;
    return mt_vec3_add(mt_vec3_scale(backdrop->top, 1.0 - t), mt_vec3_scale(backdrop->bottom, t));
}

mt_backdrop mt_backdrop_make(const mt_preview_options *options, const mt_surface *surface);

#endif
