/* Interpolation over a triangle is linear in space, hence linear over the picture once divided by depth. */
#include "lib/render/facet.h"

#include <math.h>
#include <string.h>

/* A facet is lit as a whole where interpolation would not show: its sides are shorter than a pixel or so, or than a few
 * pixels with one colour and normals that lie within 3 degrees of their mean. */
#define TINY_SIZE (1.5 * MT_STEPS)
#define SMALL_SIZE (3.0 * MT_STEPS)
#define SMALL_COSINE 0.9986

void mt_look_init(mt_look *look, const mt_frame *frame, const mt_corner_normals *normals,
                  const unsigned char *face_colors, mt_vec3 up)
{
    memset(look, 0, sizeof *look);
    look->frame = frame;
    look->normals = normals;
    mt_surface_init(frame->model->mesh, face_colors, &look->surface);
    look->has_colors = look->surface.face_colors || look->surface.colors;
    look->lighting = mt_lighting_default(&frame->camera, up);
    look->front_color = mt_linear_color(&look->surface, 0.87, 0.825, 0.765);
    look->back_color = mt_linear_color(&look->surface, 0.58, 0.68, 0.80);
    look->back_tint = mt_vec3_make(0.62, 0.72, 0.86);
    look->wire_color = mt_linear_color(&look->surface, 0.20, 0.25, 0.32);
}

static mt_vec3 toward_eye(const mt_look *look, double x, double y)
{
    return mt_camera_toward_eye(&look->frame->camera, x / MT_STEPS, y / MT_STEPS);
}

static mt_vec3 facing(mt_vec3 normal, mt_vec3 side)
{
    return mt_vec3_dot(normal, side) < 0 ? mt_vec3_scale(normal, -1.0) : normal;
}

static bool same(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* What a facet is made from. */
typedef struct source {
    mt_index face, corners[3], vertices[3];
    const mt_screen_vertex *screen[3];
} source;

static source load(const mt_look *look, mt_index triangle)
{
    const mt_triangulation *triangulation = &look->frame->model->triangulation;
    source from = {.face = mt_triangulation_face(triangulation, triangle)};
    for (mt_index i = 0; i < 3; i++) {
        from.corners[i] = mt_triangulation_corner(triangulation, triangle, i);
        from.vertices[i] = look->surface.corner_vertices[from.corners[i]];
        from.screen[i] = &look->frame->vertices[from.vertices[i]];
    }
    return from;
}

static double size_of(const source *from)
{
    const mt_screen_vertex *p = from->screen[0], *q = from->screen[1], *r = from->screen[2];
    double x = fabs(q->x - p->x), y = fabs(q->y - p->y), x2 = fabs(r->x - p->x), y2 = fabs(r->y - p->y);
    x = x > x2 ? x : x2;
    y = y > y2 ? y : y2;
    return x > y ? x : y;
}

/* y runs down the picture, so what turns with the clock there is seen from the back. */
static bool is_front(const source *from)
{
    const mt_screen_vertex *p = from->screen[0], *q = from->screen[1], *r = from->screen[2];
    return (q->x - p->x) * (r->y - p->y) - (r->x - p->x) * (q->y - p->y) < 0;
}

static void prepare_geometry(const source *from, mt_facet *facet)
{
    const mt_screen_vertex *p = from->screen[0], *q = from->screen[1], *r = from->screen[2];
    double x1 = q->x - p->x, y1 = q->y - p->y, x2 = r->x - p->x, y2 = r->y - p->y;
    double scale = 1.0 / (x1 * y2 - x2 * y1);
    facet->x = p->x;
    facet->y = p->y;
    facet->slopes[0][0] = y2 * scale, facet->slopes[0][1] = -x2 * scale;
    facet->slopes[1][0] = -y1 * scale, facet->slopes[1][1] = x1 * scale;
    facet->depths[0] = p->depth, facet->depths[1] = q->depth, facet->depths[2] = r->depth;
}

static void prepare_colors(const mt_look *look, const source *from, mt_facet *facet)
{
    bool front = is_front(from);
    facet->one_color = true;
    facet->colors[0] = facet->colors[1] = facet->colors[2] = front ? look->front_color : look->back_color;
    for (int i = 0; look->has_colors && i < 3; i++) {
        mt_vec3 color, tint = look->back_tint;
        if (mt_surface_color(&look->surface, from->face, from->corners[i], from->vertices[i], &color)) {
            facet->colors[i] = front ? color : mt_vec3_make(color.x * tint.x, color.y * tint.y, color.z * tint.z);
        }
    }
    if (look->has_colors) {
        facet->one_color = same(facet->colors[0], facet->colors[1]) && same(facet->colors[0], facet->colors[2]);
    }
}

static void prepare_normals(const mt_look *look, const source *from, mt_vec3 eye, mt_facet *facet)
{
    mt_vec3 side = facing(mt_face_normal(look->normals, from->face), eye);
    facet->one_normal = true;
    for (int i = 0; i < 3; i++) {
        mt_vec3 normal = mt_corner_normal(look->normals, from->face, from->corners[i]);
        facet->normals[i] = mt_vec3_dot(normal, normal) > 0 ? facing(normal, side) : eye;
        facet->one_normal = facet->one_normal && same(facet->normals[0], facet->normals[i]);
    }
}

static mt_vec3 unit_or(mt_vec3 a, mt_vec3 otherwise)
{
    double length = mt_vec3_length(a);
    return length > 0 ? mt_vec3_scale(a, 1.0 / length) : otherwise;
}

/* Lights the facet as a whole where that does not show. */
static bool light_small(const mt_look *look, double size, mt_vec3 eye, mt_facet *facet)
{
    const mt_vec3 *n = facet->normals, *c = facet->colors;
    if (size >= SMALL_SIZE || (size >= TINY_SIZE && !facet->one_color)) {
        return false;
    }
    mt_vec3 normal = unit_or(mt_vec3_add(mt_vec3_add(n[0], n[1]), n[2]), eye);
    bool flat = mt_vec3_dot(normal, n[0]) >= SMALL_COSINE && mt_vec3_dot(normal, n[1]) >= SMALL_COSINE &&
                mt_vec3_dot(normal, n[2]) >= SMALL_COSINE;
    if (size >= TINY_SIZE && !flat) {
        return false;
    }
    mt_vec3 mean = facet->one_color ? c[0] : mt_vec3_scale(mt_vec3_add(mt_vec3_add(c[0], c[1]), c[2]), 1.0 / 3.0);
    facet->light = mt_shade(&look->lighting, normal, eye, mean);
    return true;
}

void mt_facet_prepare(const mt_look *look, mt_index triangle, mt_facet *facet)
{
    source from = load(look, triangle);
    facet->triangle = triangle;
    mt_vec3 eye = toward_eye(look, from.screen[0]->x, from.screen[0]->y);
    prepare_colors(look, &from, facet);
    prepare_normals(look, &from, eye, facet);
    facet->is_small = light_small(look, size_of(&from), eye, facet);
    if (!facet->is_small) {
        prepare_geometry(&from, facet);
    }
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
        normal = unit_or(weigh(facet->normals, weights), eye);
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
