/* Interpolation over a triangle is linear in space, hence linear over the picture once divided by depth. */
#include "lib/render/facet.h"

#include <math.h>
#include <string.h>

void mt_look_init(mt_look *look, const mt_frame *frame, const mt_corner_normals *normals,
                  const unsigned char *face_colors, mt_vec3 up)
{
    memset(look, 0, sizeof *look);
    look->frame = frame;
    look->normals = normals;
    mt_surface_init(frame->model->mesh, face_colors, &look->surface);
    look->lighting = mt_lighting_default(&frame->camera, up);
    look->front_color = mt_linear_color(&look->surface, 0.84, 0.80, 0.74);
    look->back_color = mt_linear_color(&look->surface, 0.58, 0.68, 0.80);
    look->back_tint = mt_vec3_make(0.62, 0.72, 0.86);
    look->wire_color = mt_linear_color(&look->surface, 0.20, 0.25, 0.32);
    look->line_mark_color = mt_linear_color(&look->surface, 0.86, 0.10, 0.16);
    look->dot_mark_color = mt_linear_color(&look->surface, 0.98, 0.55, 0.05);
}

static mt_vec3 toward_eye(const mt_look *look, double x, double y)
{
    double unit = look->frame->unit;
    return mt_camera_toward_eye(&look->frame->camera, x / unit, y / unit);
}

static mt_vec3 facing(mt_vec3 normal, mt_vec3 side)
{
    return mt_vec3_dot(normal, side) < 0 ? mt_vec3_scale(normal, -1.0) : normal;
}

static bool same(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void prepare_geometry(const mt_look *look, const mt_index vertices[3], mt_facet *facet, bool *front)
{
    const mt_screen_vertex *v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = &look->frame->vertices[vertices[i]];
        facet->depths[i] = v[i]->depth;
    }
    double x1 = (double)v[1]->x - v[0]->x, y1 = (double)v[1]->y - v[0]->y;
    double x2 = (double)v[2]->x - v[0]->x, y2 = (double)v[2]->y - v[0]->y;
    double area = x1 * y2 - x2 * y1;
    facet->x = v[0]->x;
    facet->y = v[0]->y;
    facet->slopes[0][0] = y2 / area, facet->slopes[0][1] = -x2 / area;
    facet->slopes[1][0] = -y1 / area, facet->slopes[1][1] = x1 / area;
    *front = area < 0; /* y runs down the picture */
}

static void prepare_colors(const mt_look *look, mt_index face, const mt_index corners[3], bool front, mt_facet *facet)
{
    const mt_index *vertices = look->surface.corner_vertices;
    for (int i = 0; i < 3; i++) {
        mt_vec3 color;
        if (mt_surface_color(&look->surface, face, corners[i], vertices[corners[i]], &color)) {
            mt_vec3 tint = look->back_tint;
            facet->colors[i] = front ? color : mt_vec3_make(color.x * tint.x, color.y * tint.y, color.z * tint.z);
        } else {
            facet->colors[i] = front ? look->front_color : look->back_color;
        }
    }
    facet->one_color = same(facet->colors[0], facet->colors[1]) && same(facet->colors[0], facet->colors[2]);
}

void mt_facet_prepare(const mt_look *look, mt_index triangle, mt_facet *facet)
{
    const mt_triangulation *triangulation = &look->frame->model->triangulation;
    mt_index face = mt_triangulation_face(triangulation, triangle), corners[3], vertices[3];
    for (mt_index i = 0; i < 3; i++) {
        corners[i] = mt_triangulation_corner(triangulation, triangle, i);
        vertices[i] = look->surface.corner_vertices[corners[i]];
    }
    facet->triangle = triangle;
    bool front = false;
    prepare_geometry(look, vertices, facet, &front);
    prepare_colors(look, face, corners, front, facet);
    mt_vec3 eye = toward_eye(look, facet->x, facet->y);
    mt_vec3 side = facing(mt_face_normal(look->normals, face), eye);
    for (int i = 0; i < 3; i++) {
        mt_vec3 normal = mt_corner_normal(look->normals, face, corners[i]);
        facet->normals[i] = mt_vec3_dot(normal, normal) > 0 ? facing(normal, side) : eye;
    }
    facet->one_normal = same(facet->normals[0], facet->normals[1]) && same(facet->normals[0], facet->normals[2]);
}

static double clamp_unit(double x)
{
    return x > 0 ? (x < 1 ? x : 1.0) : 0.0;
}

static mt_vec3 weigh(const mt_vec3 values[3], const double weights[3])
{
    return mt_vec3_make(values[0].x * weights[0] + values[1].x * weights[1] + values[2].x * weights[2],
                        values[0].y * weights[0] + values[1].y * weights[1] + values[2].y * weights[2],
                        values[0].z * weights[0] + values[1].z * weights[1] + values[2].z * weights[2]);
}

mt_vec3 mt_facet_shade(const mt_look *look, const mt_facet *facet, double x, double y)
{
    double dx = x - facet->x, dy = y - facet->y;
    double second = clamp_unit(facet->slopes[0][0] * dx + facet->slopes[0][1] * dy);
    double third = clamp_unit(facet->slopes[1][0] * dx + facet->slopes[1][1] * dy);
    double first = clamp_unit(1.0 - second - third);
    double weights[3] = {first * facet->depths[0], second * facet->depths[1], third * facet->depths[2]};
    double scale = 1.0 / (weights[0] + weights[1] + weights[2]);
    for (int i = 0; i < 3; i++) {
        weights[i] *= scale;
    }
    mt_vec3 eye = toward_eye(look, x, y);
    mt_vec3 normal = facet->normals[0];
    if (!facet->one_normal) {
        mt_vec3 sum = weigh(facet->normals, weights);
        double length = mt_vec3_length(sum);
        normal = length > 0 ? mt_vec3_scale(sum, 1.0 / length) : eye;
    }
    mt_vec3 color = facet->one_color ? facet->colors[0] : weigh(facet->colors, weights);
    return mt_shade(&look->lighting, normal, eye, color);
}

mt_vec3 mt_dot_shade(const mt_look *look, mt_index vertex, double radius, double x, double y)
{
    const mt_screen_vertex *center = &look->frame->vertices[vertex];
    const mt_camera *camera = &look->frame->camera;
    double right = (x - center->x) / radius, up = (center->y - y) / radius;
    double back = sqrt(fmax(0.0, 1.0 - right * right - up * up));
    mt_vec3 normal = mt_vec3_add(mt_vec3_scale(camera->right, right), mt_vec3_scale(camera->up, up));
    normal = mt_vec3_normalize(mt_vec3_add(normal, mt_vec3_scale(camera->forward, -back)));
    mt_vec3 color;
    if (!mt_surface_color(&look->surface, MT_NONE, MT_NONE, vertex, &color)) {
        color = look->wire_color;
    }
    return mt_shade(&look->lighting, normal, toward_eye(look, x, y), color);
}
