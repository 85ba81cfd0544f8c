/* Interpolation over a triangle is linear in space, hence linear over the picture once divided by depth. */
#include "lib/render/facet.h"

#include "lib/render/crossing.h"
#include "lib/render/interpolate.h"
#include "lib/render/shadow.h"

#include <math.h>
#include <string.h>

/* A facet is lit as a whole where interpolation would not show: its sides are shorter than a pixel or so, or than a few
 * pixels with one colour and normals that lie within 3 degrees of their mean. */
#define TINY_SIZE (1.5 * MT_STEPS)
#define SMALL_SIZE (3.0 * MT_STEPS)
#define SMALL_COSINE 0.9986

static mt_vec3 toward_eye(const mt_look *look, double x, double y)
{
    return mt_camera_toward_eye(&look->frame->camera, x / MT_STEPS, y / MT_STEPS);
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

static bool is_placed(const source *from)
{
    return from->screen[0]->depth > 0 && from->screen[1]->depth > 0 && from->screen[2]->depth > 0;
}

/* Of a triangle that crosses the plane of the eye. */
static bool crossing_is_front(const mt_look *look, const source *from)
{
    const mt_model *model = look->frame->model;
    mt_vec3 p = mt_model_position(model, from->vertices[0]);
    mt_vec3 a = mt_vec3_subtract(mt_model_position(model, from->vertices[1]), p);
    mt_vec3 b = mt_vec3_subtract(mt_model_position(model, from->vertices[2]), p);
    return mt_vec3_dot(mt_vec3_cross(a, b), mt_vec3_subtract(look->frame->camera.eye, p)) > 0;
}

/* y runs down the picture, so what turns with the clock there is seen from the back. */
static bool is_front(const mt_look *look, const source *from)
{
    if (!is_placed(from)) {
        return crossing_is_front(look, from);
    }
    const mt_screen_vertex *p = from->screen[0], *q = from->screen[1], *r = from->screen[2];
    return (q->x - p->x) * (r->y - p->y) - (r->x - p->x) * (q->y - p->y) < 0;
}

static void prepare_geometry(const mt_look *look, const source *from, mt_facet *facet)
{
    if (!is_placed(from)) {
        facet->x = facet->y = 0;
        mt_crossing_forms(look->frame, facet->triangle, facet->forms);
        return;
    }
    const mt_screen_vertex *p = from->screen[0], *q = from->screen[1], *r = from->screen[2];
    double x1 = q->x - p->x, y1 = q->y - p->y, x2 = r->x - p->x, y2 = r->y - p->y;
    double scale = 1.0 / (x1 * y2 - x2 * y1);
    const double second[3] = {y2 * scale, -x2 * scale, 0}, third[3] = {-y1 * scale, x1 * scale, 0};
    bool parallel = mt_camera_is_parallel(&look->frame->camera);
    facet->x = p->x;
    facet->y = p->y;
    facet->depths[0] = p->depth, facet->depths[1] = q->depth, facet->depths[2] = r->depth;
    for (int i = 0; i < 3; i++) {
        double first = (i == 2 ? 1.0 : 0.0) - second[i] - third[i];
        facet->forms[0][i] = first * (parallel ? 1.0 : p->depth);
        facet->forms[1][i] = second[i] * (parallel ? 1.0 : q->depth);
        facet->forms[2][i] = third[i] * (parallel ? 1.0 : r->depth);
    }
}

static void prepare_colors(const mt_look *look, const source *from, mt_facet *facet)
{
    bool front = is_front(look, from);
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
    mt_vec3 side = mt_facing(mt_face_normal(look->normals, from->face), eye);
    facet->one_normal = true;
    facet->face_normal = side;
    for (int i = 0; i < 3; i++) {
        mt_vec3 normal = mt_corner_normal(look->normals, from->face, from->corners[i]);
        facet->normals[i] = mt_vec3_dot(normal, normal) > 0 ? mt_facing(normal, side) : eye;
        facet->one_normal = facet->one_normal && same(facet->normals[0], facet->normals[i]);
    }
    for (int i = 0; look->shadows && i < 3; i++) {
        facet->positions[i] = mt_model_position(look->frame->model, from->vertices[i]);
    }
}

static mt_vec3 smooth_position(const mt_facet *facet, const double weights[3])
{
    mt_vec3 p = mt_weigh(facet->positions, weights);
    return facet->one_normal ? p : mt_lifted_position(p, facet->positions, facet->normals, weights);
}

static bool is_shadowed(const mt_look *look, const mt_facet *facet, const double weights[3])
{
    return mt_is_shadowed(look, smooth_position(facet, weights), facet->face_normal, facet->triangle);
}

/* Lights the facet as a whole where that does not show. */
static bool light_small(const mt_look *look, double size, mt_vec3 eye, mt_facet *facet)
{
    static const double middle[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    const mt_vec3 *n = facet->normals, *c = facet->colors;
    bool varies = !facet->one_color || look->shadows;
    if (size >= SMALL_SIZE || (size >= TINY_SIZE && varies) || look->paint == MT_PAINT_DEPTH) {
        return false;
    }
    mt_vec3 normal = mt_unit_or(mt_vec3_add(mt_vec3_add(n[0], n[1]), n[2]), eye);
    bool flat = mt_vec3_dot(normal, n[0]) >= SMALL_COSINE && mt_vec3_dot(normal, n[1]) >= SMALL_COSINE &&
                mt_vec3_dot(normal, n[2]) >= SMALL_COSINE;
    if (size >= TINY_SIZE && !flat) {
        return false;
    }
    mt_shading_point point = {normal, eye, c[0], facet->depths[0], 1.0};
    if (!facet->one_color) {
        point.color = mt_vec3_scale(mt_vec3_add(mt_vec3_add(c[0], c[1]), c[2]), 1.0 / 3.0);
    }
    if (look->shadows && is_shadowed(look, facet, middle)) {
        point.lit = 0;
    }
    facet->light = mt_look_light(look, &point);
    return true;
}

void mt_facet_prepare(const mt_look *look, mt_index triangle, mt_facet *facet)
{
    source from = load(look, triangle);
    facet->triangle = triangle;
    if (look->seen) {
        __atomic_store_n(&look->seen[from.face], 1, __ATOMIC_RELAXED);
    }
    bool placed = is_placed(&from);
    mt_vec3 eye = placed ? toward_eye(look, from.screen[0]->x, from.screen[0]->y)
                         : mt_vec3_normalize(mt_vec3_subtract(look->frame->camera.eye,
                                                              mt_model_position(look->frame->model, from.vertices[0])));
    prepare_colors(look, &from, facet);
    prepare_normals(look, &from, eye, facet);
    facet->depths[0] = from.screen[0]->depth;
    facet->is_small = placed && light_small(look, size_of(&from), eye, facet);
    if (!facet->is_small) {
        prepare_geometry(look, &from, facet);
    }
}

/* The corners' weights at a place, clamped into the triangle; returns the depth. */
static double find_weights(const mt_look *look, const mt_facet *facet, double x, double y, double weights[3])
{
    double dx = x - facet->x, dy = y - facet->y, sum = 0, depth = 0;
    for (int i = 0; i < 3; i++) {
        const double *form = facet->forms[i];
        double weight = form[0] * dx + form[1] * dy + form[2];
        weights[i] = weight > 0 ? weight : 0.0;
        sum += weights[i];
    }
    double scale = sum > 0 ? 1.0 / sum : 0.0;
    for (int i = 0; i < 3; i++) {
        weights[i] *= scale;
        depth += weights[i] * facet->depths[i];
    }
    return mt_camera_is_parallel(&look->frame->camera) ? depth : sum;
}

mt_vec3 mt_facet_shade(const mt_look *look, const mt_facet *facet, double x, double y, double lit)
{
    double weights[3];
    mt_shading_point point = {.toward_eye = toward_eye(look, x, y), .lit = lit};
    point.depth = find_weights(look, facet, x, y, weights);
    point.normal = facet->normals[0];
    if (!facet->one_normal) {
        point.normal = mt_unit_or(mt_weigh(facet->normals, weights), point.toward_eye);
    }
    point.color = facet->one_color ? facet->colors[0] : mt_weigh(facet->colors, weights);
    return mt_look_light(look, &point);
}

static bool is_lit(const void *user, const mt_look *look, double x, double y)
{
    const mt_facet *facet = (const mt_facet *)user;
    double weights[3];
    find_weights(look, facet, x, y, weights);
    return !is_shadowed(look, facet, weights);
}

double mt_facet_lit(const mt_look *look, const mt_facet *facet, const mt_sampling *sampling, uint64_t samples,
                    uint32_t x, uint32_t y)
{
    return mt_lit_share(look, sampling, samples, x, y, is_lit, facet);
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
    return mt_look_light(look, &(mt_shading_point){normal, toward_eye(look, x, y), color, center->depth, 1.0});
}
