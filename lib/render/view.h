/* From where a mesh is looked at. */
#ifndef MESHTOOL_RENDER_VIEW_H
#define MESHTOOL_RENDER_VIEW_H

#include "lib/render/corner_normals.h"

#include <meshtool/preview.h>

typedef struct mt_view {
    mt_vec3 toward_eye; /* unit */
    mt_vec3 up;         /* of the picture; unit */
    mt_vec3 axis;       /* of the mesh, upwards: where the sky is, and what a turntable turns around; unit */
} mt_view;

/* MT_VIEW_DEFAULT: three quarters from the right and slightly above, with the mesh's up axis up; when it shows its
 * faces nearly edge-on or its length end-on that way, the first of a few other directions that does not, else the best
 * of them. up: the axis, of any length; zero: the mesh's own. */
mt_view mt_view_make(const mt_corner_normals *normals, mt_view_name name, mt_vec3 up);

/* A vector turned around a unit axis, counter-clockwise seen from its tip. */
mt_vec3 mt_turned(mt_vec3 v, mt_vec3 axis, double degrees);

#endif
