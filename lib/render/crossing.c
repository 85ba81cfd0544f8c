/* Triangles that cross the plane of the eye are drawn without being cut, after Olano and Greer, "Triangle Scan
 * Conversion using 2D Homogeneous Coordinates" (1997): the weights with which a ray d meets the corners are d . (Pj x
 * Pk), linear over the picture wherever the corners lie, and of one sign exactly where the part in front is seen. */
#include "lib/render/crossing.h"

#include "lib/render/triangle.h"

/* A corner as right, up and forward, in which the ray through a place of the picture is (a, b, 1), a and b from -1
 * to 1. */
static mt_vec3 in_camera(const mt_frame *frame, mt_index triangle, mt_index side)
{
    const mt_model *model = frame->model;
    const mt_camera *camera = &frame->camera;
    mt_index corner = mt_triangulation_corner(&model->triangulation, triangle, side);
    mt_vec3 p = mt_vec3_subtract(mt_model_position(model, model->mesh->corner_vertices[corner]), camera->eye);
    return mt_vec3_make(mt_vec3_dot(p, camera->right) / camera->half_width,
                        mt_vec3_dot(p, camera->up) / camera->half_height, mt_vec3_dot(p, camera->forward));
}

/* Where an edge runs through the plane of the eye, its picture runs out to one side, or to one of two where rounding
 * cannot tell. */
static void run_out(double at, double doubt, int32_t *first, int32_t *last)
{
    if (at < doubt) {
        *first = -(int32_t)PIXEL_LIMIT;
    }
    if (at > -doubt) {
        *last = (int32_t)PIXEL_LIMIT;
    }
}

static void widen(int32_t first, int32_t last, int32_t *box_first, int32_t *box_last)
{
    *box_first = first < *box_first ? first : *box_first;
    *box_last = last > *box_last ? last : *box_last;
}

pixel_box mt_crossing_box(const mt_frame *frame, mt_index triangle)
{
    corners c = load_corners(frame, triangle);
    pixel_box box = {(int32_t)PIXEL_LIMIT, (int32_t)PIXEL_LIMIT, -(int32_t)PIXEL_LIMIT, -(int32_t)PIXEL_LIMIT};
    for (mt_index i = 0; i < 3; i++) {
        mt_index j = i == 2 ? 0 : i + 1;
        if (c.v[i]->depth > 0) {
            const corners alone = {{c.v[i], c.v[i], c.v[i]}};
            pixel_box own = box_of(frame, &alone);
            widen(own.first_x, own.last_x, &box.first_x, &box.last_x);
            widen(own.first_y, own.last_y, &box.first_y, &box.last_y);
        }
        if ((c.v[i]->depth > 0) != (c.v[j]->depth > 0)) {
            mt_vec3 p = in_camera(frame, triangle, i), q = in_camera(frame, triangle, j);
            double doubt = (fabs(p.x) + fabs(p.y) + fabs(p.z) + fabs(q.x) + fabs(q.y) + fabs(q.z)) * 0x1p-30;
            double s = p.z / (p.z - q.z);
            run_out(p.x + s * (q.x - p.x), doubt, &box.first_x, &box.last_x);
            run_out(-(p.y + s * (q.y - p.y)), doubt, &box.first_y, &box.last_y);
        }
    }
    return box;
}

/* What decides a side of the triangle, over a and b from -1 to 1, as an edge function over the picture. */
static edge edge_of(const mt_frame *frame, mt_vec3 p, mt_vec3 q, double sign)
{
    mt_vec3 n = mt_vec3_scale(mt_vec3_cross(p, q), sign);
    double sizes = mt_vec3_max_abs(p) * mt_vec3_max_abs(q),
           shift = frame->precision.edges * (frame->precision.by_shape ? 64.0 : 1.0);
    shift /= fmin(1.0, fmin(frame->camera.half_width, frame->camera.half_height));
    double doubt = 4.0 * (shift * (mt_vec3_max_abs(p) + mt_vec3_max_abs(q) + shift) + sizes * DOUBLE_ROUNDING);
    double width = (double)MT_STEPS * frame->camera.width, height = (double)MT_STEPS * frame->camera.height;
    return (edge){2.0 * n.x / width, -2.0 * n.y / height, n.z - n.x + n.y, doubt};
}

void mt_crossing_setup(const mt_frame *frame, mt_index triangle, triangle_setup *setup)
{
    mt_vec3 p = in_camera(frame, triangle, 0), q = in_camera(frame, triangle, 1), r = in_camera(frame, triangle, 2);
    double determinant = mt_vec3_dot(p, mt_vec3_cross(q, r)), sign = determinant < 0 ? -1.0 : 1.0;
    setup->edges[0] = edge_of(frame, p, q, sign);
    setup->edges[1] = edge_of(frame, q, r, sign);
    setup->edges[2] = edge_of(frame, r, p, sign);
    depth_plane plane = {.nearest = FLT_MAX};
    double doubt = 0, scale = 1.0 / fabs(determinant);
    for (int i = 0; i < 3; i++) {
        plane.depth += setup->edges[i].c * scale;
        plane.slope_x += setup->edges[i].a * scale;
        plane.slope_y += setup->edges[i].b * scale;
        doubt += setup->edges[i].doubt;
    }
    double slope = fabs(plane.slope_x) + fabs(plane.slope_y), farthest = INFINITY;
    corners c = load_corners(frame, triangle);
    for (int i = 0; i < 3; i++) {
        farthest = c.v[i]->depth > 0 ? fmin(farthest, c.v[i]->depth) : farthest;
    }
    /* With the eye next to the plane of the triangle the sign, and which side is inside, are a guess. */
    double edge_on = doubt * (mt_vec3_max_abs(p) + mt_vec3_max_abs(q) + mt_vec3_max_abs(r));
    bool guess = !(fabs(determinant) > edge_on);
    for (int i = 0; guess && i < 3; i++) {
        setup->edges[i] = (edge){0, 0, 0, INFINITY};
    }
    double error = 2.0 * doubt * scale + slope * MT_STEPS * (double)FLOAT_ROUNDING;
    setup->plane =
        !guess && error <= PLANE_ERROR * farthest && edge_on * scale <= PLANE_ERROR ? plane : vague_plane(INFINITY);
}

void mt_crossing_forms(const mt_frame *frame, mt_index triangle, double forms[3][3])
{
    mt_vec3 p[3];
    for (mt_index i = 0; i < 3; i++) {
        p[i] = in_camera(frame, triangle, i);
    }
    double determinant = mt_vec3_dot(p[0], mt_vec3_cross(p[1], p[2])), scale = 1.0 / fabs(determinant);
    for (int i = 0; i < 3; i++) {
        edge e = edge_of(frame, p[i == 2 ? 0 : i + 1], p[i == 0 ? 2 : i - 1], determinant < 0 ? -1.0 : 1.0);
        forms[i][0] = e.a * scale, forms[i][1] = e.b * scale, forms[i][2] = e.c * scale;
    }
}
