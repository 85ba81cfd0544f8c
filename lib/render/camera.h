/* Where a picture is taken from, and where a point falls in it. */
#ifndef MESHTOOL_RENDER_CAMERA_H
#define MESHTOOL_RENDER_CAMERA_H

#include "lib/render/model.h"

/* A perspective camera. The three axes are unit vectors at right angles; picture x runs to the right, y down. */
typedef struct mt_camera {
    mt_vec3 eye;
    mt_vec3 right, up, forward;
    double tangent_x, tangent_y; /* half the picture's extent at distance 1 */
    uint32_t width, height;      /* pixels */
} mt_camera;

/* The frame of a camera that looks along -toward_eye with `up` upwards as far as possible: right = forward x up,
 * normalised. Where up is parallel to the view, the axis that is most at right angles to it takes its place. */
void mt_camera_frame(mt_camera *camera, mt_vec3 toward_eye, mt_vec3 up);

/* Puts the eye as near as the whole of what is drawn stays inside the picture, with a margin. The frame and the
 * size are set before. */
mt_status mt_camera_fit(mt_context *context, mt_camera *camera, const mt_model *model);

/* The point in pixels from the top left corner, and as depth the reciprocal of its distance along the view: larger
 * is nearer, and linear across the picture on a plane. Depth 0 or less: not in front of the eye. */
typedef struct mt_screen_point {
    double x, y, depth;
} mt_screen_point;

static inline mt_screen_point mt_camera_project(const mt_camera *camera, mt_vec3 p)
{
    mt_vec3 q = mt_vec3_subtract(p, camera->eye);
    double depth = 1.0 / mt_vec3_dot(q, camera->forward);
    double x = mt_vec3_dot(q, camera->right) * depth / camera->tangent_x;
    double y = mt_vec3_dot(q, camera->up) * depth / camera->tangent_y;
    mt_screen_point s = {0.5 * camera->width * (1.0 + x), 0.5 * camera->height * (1.0 - y), depth};
    return s;
}

/* Unit vector from a point of the picture towards the eye. */
static inline mt_vec3 mt_camera_toward_eye(const mt_camera *camera, double x, double y)
{
    double a = (2.0 * x / camera->width - 1.0) * camera->tangent_x;
    double b = (1.0 - 2.0 * y / camera->height) * camera->tangent_y;
    mt_vec3 ray =
        mt_vec3_add(camera->forward, mt_vec3_add(mt_vec3_scale(camera->right, a), mt_vec3_scale(camera->up, b)));
    return mt_vec3_scale(ray, -1.0 / mt_vec3_length(ray));
}

#endif
