/* Where a picture is taken from, where a point falls in it, and the ray through a place of it. */
#ifndef MESHTOOL_RENDER_CAMERA_H
#define MESHTOOL_RENDER_CAMERA_H

#include "lib/render/model.h"

#include <meshtool/preview.h>

/* The three axes are unit vectors at right angles; picture x runs to the right, y down. An oblique camera is a parallel
 * one whose rays lean: a point farther away by 1 falls shear_x to the right and shear_y above. */
typedef struct mt_camera {
    mt_projection projection;
    mt_vec3 eye; /* of a parallel camera: the middle of its picture plane */
    mt_vec3 right, up, forward;
    double half_width, half_height; /* half the picture's extent; in perspective that at distance 1 */
    double shear_x, shear_y;
    uint32_t width, height; /* pixels */
} mt_camera;

/* The depth of a parallel camera: 1 at its picture plane, 0 so far behind. What is drawn lies within half of that. */
#define MT_PARALLEL_REACH 8.0

static inline bool mt_camera_is_parallel(const mt_camera *camera)
{
    return camera->projection != MT_PROJECTION_PERSPECTIVE;
}

/* The frame of a camera that looks along -toward_eye with `up` upwards as far as possible: right = forward x up,
 * normalised. Where up is parallel to the view, the axis that is most at right angles to it takes its place. */
void mt_camera_frame(mt_camera *camera, mt_vec3 toward_eye, mt_vec3 up);

/* The point in pixels from the top left corner. depth: larger is nearer, and linear across the picture on a plane; in
 * perspective the reciprocal of the distance along the view. Depth 0 or less: not in front of the eye. */
typedef struct mt_screen_point {
    double x, y, depth;
} mt_screen_point;

static inline mt_screen_point mt_camera_project(const mt_camera *camera, mt_vec3 p)
{
    mt_vec3 q = mt_vec3_subtract(p, camera->eye);
    double along = mt_vec3_dot(q, camera->forward), right = mt_vec3_dot(q, camera->right);
    double up = mt_vec3_dot(q, camera->up), depth, x, y;
    if (mt_camera_is_parallel(camera)) {
        depth = 1.0 - along * (1.0 / MT_PARALLEL_REACH);
        x = (right + camera->shear_x * along) / camera->half_width;
        y = (up + camera->shear_y * along) / camera->half_height;
    } else {
        depth = 1.0 / along;
        x = right * depth / camera->half_width;
        y = up * depth / camera->half_height;
    }
    mt_screen_point s = {0.5 * camera->width * (1.0 + x), 0.5 * camera->height * (1.0 - y), depth};
    return s;
}

/* A half-line. Its t is the distance along the camera's view: the direction is not a unit vector. */
typedef struct mt_camera_ray {
    mt_vec3 origin, direction;
} mt_camera_ray;

/* The ray through a place of the picture, in pixels from the top left corner. */
static inline mt_camera_ray mt_camera_ray_at(const mt_camera *camera, double x, double y)
{
    double a = (2.0 * x / camera->width - 1.0) * camera->half_width;
    double b = (1.0 - 2.0 * y / camera->height) * camera->half_height;
    bool parallel = mt_camera_is_parallel(camera);
    double right = parallel ? -camera->shear_x : a, up = parallel ? -camera->shear_y : b;
    mt_camera_ray ray = {camera->eye, camera->forward};
    ray.direction = mt_vec3_add(ray.direction, mt_vec3_scale(camera->right, right));
    ray.direction = mt_vec3_add(ray.direction, mt_vec3_scale(camera->up, up));
    if (parallel) {
        ray.origin = mt_vec3_add(ray.origin, mt_vec3_scale(camera->right, a));
        ray.origin = mt_vec3_add(ray.origin, mt_vec3_scale(camera->up, b));
    }
    return ray;
}

/* Depth at a distance along the view, and the other way. */
static inline double mt_camera_depth(const mt_camera *camera, double t)
{
    return mt_camera_is_parallel(camera) ? 1.0 - t * (1.0 / MT_PARALLEL_REACH) : 1.0 / t;
}

static inline double mt_camera_distance(const mt_camera *camera, double depth)
{
    return mt_camera_is_parallel(camera) ? (1.0 - depth) * MT_PARALLEL_REACH : 1.0 / depth;
}

/* Unit vector from a point of the picture towards the eye. */
static inline mt_vec3 mt_camera_toward_eye(const mt_camera *camera, double x, double y)
{
    mt_vec3 direction = mt_camera_ray_at(camera, x, y).direction;
    return mt_vec3_scale(direction, -1.0 / mt_vec3_length(direction));
}

#endif
