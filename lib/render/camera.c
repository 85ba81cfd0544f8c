#include "lib/render/camera.h"

void mt_camera_frame(mt_camera *camera, mt_vec3 toward_eye, mt_vec3 up)
{
    camera->forward = mt_vec3_scale(mt_vec3_normalize(toward_eye), -1.0);
    mt_vec3 right = mt_vec3_cross(camera->forward, mt_vec3_normalize(up));
    if (!(mt_vec3_dot(right, right) > 1e-20)) {
        mt_vec3 f = camera->forward;
        bool x_is_least = fabs(f.x) <= fabs(f.y) && fabs(f.x) <= fabs(f.z);
        bool y_is_least = fabs(f.y) <= fabs(f.z);
        mt_vec3 axis = x_is_least ? mt_vec3_make(1, 0, 0) : y_is_least ? mt_vec3_make(0, 1, 0) : mt_vec3_make(0, 0, 1);
        right = mt_vec3_cross(f, axis);
    }
    camera->right = mt_vec3_normalize(right);
    camera->up = mt_vec3_cross(camera->right, camera->forward);
}
