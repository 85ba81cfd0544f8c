/* From where a mesh is looked at when nobody says. */
#ifndef MESHTOOL_RENDER_VIEW_H
#define MESHTOOL_RENDER_VIEW_H

#include "lib/render/corner_normals.h"

typedef struct mt_view {
    mt_vec3 toward_eye; /* unit */
    mt_vec3 up;
} mt_view;

/* Three quarters from the right and slightly above, with the mesh's up axis up; when it shows its faces nearly
 * edge-on or its length end-on that way, the first of a few other directions that does not, else the best of them. */
mt_view mt_view_default(const mt_corner_normals *normals);

#endif
