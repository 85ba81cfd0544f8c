#include "lib/render/look.h"

#include <string.h>

/* sRGB grey of what is nearest and farthest; both darker than the usual background. */
#define NEAR_GREY 0.78
#define FAR_GREY 0.10

void mt_look_init(mt_look *look, const mt_frame *frame, const mt_corner_normals *normals, const mt_mesh *colored,
                  const unsigned char *face_colors, mt_vec3 up)
{
    memset(look, 0, sizeof *look);
    look->frame = frame;
    look->normals = normals;
    mt_surface_init(frame->model->mesh, colored, face_colors, &look->surface);
    look->has_colors = look->surface.face_colors || look->surface.colors;
    look->lighting = mt_lighting_default(&frame->camera, up);
    look->front_color = mt_linear_color(&look->surface, 0.87, 0.825, 0.765);
    look->back_color = mt_linear_color(&look->surface, 0.58, 0.68, 0.80);
    look->back_tint = mt_vec3_make(0.62, 0.72, 0.86);
    look->wire_color = mt_linear_color(&look->surface, 0.20, 0.25, 0.32);
}

static mt_vec3 normal_color(const mt_look *look, mt_vec3 n)
{
    return mt_linear_color(&look->surface, 0.5 + 0.5 * n.x, 0.5 + 0.5 * n.y, 0.5 + 0.5 * n.z);
}

static mt_vec3 depth_color(const mt_look *look, double depth)
{
    double range = look->farthest - look->nearest;
    double share = range > 0 ? (mt_camera_distance(&look->frame->camera, depth) - look->nearest) / range : 0.0;
    double grey = NEAR_GREY + (FAR_GREY - NEAR_GREY) * fmin(fmax(share, 0.0), 1.0);
    return mt_linear_color(&look->surface, grey, grey, grey);
}

mt_vec3 mt_look_light(const mt_look *look, const mt_shading_point *point)
{
    switch (look->paint) {
    case MT_PAINT_NORMAL:
        return normal_color(look, point->normal);
    case MT_PAINT_DEPTH:
        return depth_color(look, point->depth);
    default:
        return mt_shade(&look->lighting, point->normal, point->toward_eye, point->color, point->lit);
    }
}
