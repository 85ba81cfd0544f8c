/* Places a camera so that what is drawn fills the picture. */
#ifndef MESHTOOL_RENDER_FRAMING_H
#define MESHTOOL_RENDER_FRAMING_H

#include "lib/render/camera.h"

/* What the user fixed; the rest is found. Points are in the model's coordinates. */
typedef struct mt_framing {
    bool has_eye, has_target;
    mt_vec3 eye, target;
    double fov_degrees; /* of the shorter side; 0: 28, or with an eye what shows all of the mesh */
} mt_framing;

/* Half the extent of the picture's shorter side at distance 1, when nobody says: 28 degrees in all. */
#define MT_USUAL_TANGENT 0.25

/* Finds the eye and the extent. Size, frame, projection and shear are set before.
 * Perspective: without an eye it comes as near as all stays inside the picture, with a margin, seen at the angle given;
 * with one, the angle is the least that shows all from there, up to 75 degrees. Parallel: the least extent that shows
 * all, around the target when there is one; an eye and an angle give the extent at the target instead. */
mt_status mt_camera_fit(mt_context *context, mt_camera *camera, const mt_model *model, const mt_framing *framing);

#endif
