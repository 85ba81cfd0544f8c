/* The light that a point of a surface sends to the eye. */
#ifndef MESHTOOL_RENDER_SHADE_H
#define MESHTOOL_RENDER_SHADE_H

#include "lib/render/camera.h"

#define MT_LIGHT_COUNT 2

typedef struct mt_light {
    mt_vec3 direction; /* unit, towards the light */
    mt_vec3 color;     /* linear */
} mt_light;

typedef struct mt_lighting {
    mt_light lights[MT_LIGHT_COUNT];
    mt_vec3 up; /* ambient light fades from `sky` where the surface faces up to `ground` */
    mt_vec3 sky, ground;
    double gloss; /* strength of the Blinn-Phong highlight */
} mt_lighting;

/* A head light over the left shoulder, a fill light from the right, and ambient light: all move with the camera. */
mt_lighting mt_lighting_default(const mt_camera *camera, mt_vec3 up);

/* Ambient + Lambert + Blinn-Phong. normal and toward_eye are unit vectors; the colour is the surface's, linear. lit:
 * the share of the first light that arrives. */
mt_vec3 mt_shade(const mt_lighting *lighting, mt_vec3 normal, mt_vec3 toward_eye, mt_vec3 color, double lit);

#endif
