#include "tradeoff/pixel_oracle.h"

#include "tradeoff/quad_triangle.h"
#include "tradeoff/random.h"

#include <meshtool/triangulate.h>

#include <string.h>

/* Boxes and triangles looked at from all pixels together. */
#define ORACLE_WORK 100000000U
#define PIXEL_COUNT 4000

/* Pixels' widths within which a side is too near. The renderer's corners are floats: they move by a tenth of this. */
#define DOUBT (1.0 / 256)

/* Of the diagonal: how far surfaces lie apart for sure. */
#define DEPTH_DOUBT 1e-5

/* A vertex in pixels from the top left corner, and how far in front of the eye; NaN: it is not finite. */
typedef struct place {
    double x, y, depth;
} place;

typedef struct view {
    const mt_mesh *mesh;
    double diagonal;
    mt_triangulation triangulation;
    triangle_blocks blocks;
    quad3 eye, right, up, forward;
    place *places;
    pixel_oracle *out;
} view;

static void aim(view *v)
{
    static const mt_vec3 toward_eye = {0.6, -0.7, 0.4}, up = {0, 0, 1};
    mt_bounds bounds = mt_mesh_bounds(v->mesh);
    pixel_oracle *out = v->out;
    out->target = mt_vec3_add(mt_vec3_scale(bounds.minimum, 0.5), mt_vec3_scale(bounds.maximum, 0.5));
    out->eye = mt_vec3_add(out->target, mt_vec3_scale(toward_eye, 0.75 * v->diagonal));
    out->up = up;
    v->eye = quad3_from(out->eye);
    v->forward = quad3_normalize(quad3_subtract(quad3_from(out->target), v->eye));
    v->right = quad3_normalize(quad3_cross(v->forward, quad3_from(up)));
    v->up = quad3_cross(v->right, v->forward);
}

static void project(void *user, uint64_t begin, uint64_t end)
{
    view *v = user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_vec3 position = mt_mesh_position(v->mesh, (mt_index)vertex);
        quad3 p = quad3_subtract(quad3_from(position), v->eye);
        quad along = quad3_dot(p, v->forward), half = PIXEL_ORACLE_SIZE / 2.0;
        place none = {(double)NAN, (double)NAN, (double)NAN};
        v->places[vertex] = none;
        if (mt_vec3_is_finite(position)) {
            v->places[vertex] = (place){(double)(half + half * quad3_dot(p, v->right) / along),
                                        (double)(half - half * quad3_dot(p, v->up) / along), (double)along};
        }
    }
}

/* Through the middle of a pixel. Its t is the distance in front of the eye. */
static mt_ray ray_through(const view *v, double x, double y)
{
    quad half = PIXEL_ORACLE_SIZE / 2.0;
    quad3 right = quad3_scale(v->right, x / half - 1), up = quad3_scale(v->up, 1 - y / half);
    return mt_ray_make(v->out->eye, quad3_round(quad3_add(v->forward, quad3_add(right, up))));
}

static double distance_to_side(const place *a, const place *b, double x, double y)
{
    double along_x = b->x - a->x, along_y = b->y - a->y, squared = along_x * along_x + along_y * along_y;
    double t = squared > 0 ? ((x - a->x) * along_x + (y - a->y) * along_y) / squared : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    double dx = a->x + t * along_x - x, dy = a->y + t * along_y - y;
    return sqrt(dx * dx + dy * dy);
}

/* False for NaN as well. */
static bool may_cover(const place *p[3], double x, double y)
{
    double low_x = fmin(p[0]->x, fmin(p[1]->x, p[2]->x)), high_x = fmax(p[0]->x, fmax(p[1]->x, p[2]->x));
    double low_y = fmin(p[0]->y, fmin(p[1]->y, p[2]->y)), high_y = fmax(p[0]->y, fmax(p[1]->y, p[2]->y));
    return low_x <= x + DOUBT && x - DOUBT <= high_x && low_y <= y + DOUBT && y - DOUBT <= high_y;
}

/* Faces with a vertex that is not finite are not drawn. */
static bool is_drawn(const view *v, mt_index face)
{
    bool drawn = true;
    for (mt_index corner = mt_mesh_face_begin(v->mesh, face); corner < mt_mesh_face_end(v->mesh, face); corner++) {
        drawn = drawn && !isnan(v->places[v->mesh->corner_vertices[corner]].depth);
    }
    return drawn;
}

/* What a ray has met so far. */
typedef struct sight {
    const view *view;
    mt_ray ray;
    double x, y;     /* of the pixel's middle */
    double t, slack; /* of the nearest triangle, and how far the renderer's own may lie from there */
    mt_index face;
    double rival; /* from where on another face, or one whose side is too near to tell, may lie */
} sight;

/* A triangle whose side is in doubt lies aside of the ray by less than a hundredth of a pixel's width, at most three
 * diagonals away. */
static bool may_be_seen(const void *user, const triangle_box *box)
{
    const sight *seen = user;
    return triangle_box_may_meet(box, &seen->ray, 3 * 2.0 / PIXEL_ORACLE_SIZE / 100 * seen->view->diagonal);
}

static void meet(void *user, mt_index triangle)
{
    sight *seen = user;
    const view *v = seen->view;
    double x = seen->x, y = seen->y;
    const place *p[3];
    mt_vec3 corners[3];
    for (mt_index side = 0; side < 3; side++) {
        mt_index vertex = v->mesh->corner_vertices[mt_triangulation_corner(&v->triangulation, triangle, side)];
        p[side] = &v->places[vertex];
        corners[side] = mt_mesh_position(v->mesh, vertex);
    }
    mt_index face = mt_triangulation_face(&v->triangulation, triangle);
    if (!may_cover(p, x, y) || !is_drawn(v, face)) {
        return;
    }
    double near = fmin(p[0]->depth, fmin(p[1]->depth, p[2]->depth));
    double far = fmax(p[0]->depth, fmax(p[1]->depth, p[2]->depth));
    double aside = fmin(distance_to_side(p[0], p[1], x, y),
                        fmin(distance_to_side(p[1], p[2], x, y), distance_to_side(p[2], p[0], x, y)));
    if (!(aside > DOUBT)) {
        seen->rival = fmin(seen->rival, near - DEPTH_DOUBT * v->diagonal);
        return;
    }
    double t = quad_meet_triangle(corners, &seen->ray, 1e-9 * v->diagonal);
    double slack = (far - near) * (DOUBT / aside) + DEPTH_DOUBT * v->diagonal;
    if (t < seen->t) {
        seen->rival = face != seen->face ? fmin(seen->rival, seen->t - seen->slack) : seen->rival;
        seen->t = t, seen->slack = slack, seen->face = face;
    } else if (t < INFINITY && face != seen->face) {
        seen->rival = fmin(seen->rival, t - slack);
    }
}

static void look(void *user, uint64_t begin, uint64_t end)
{
    static const triangle_query query = {may_be_seen, meet};
    view *v = user;
    for (uint64_t i = begin; i < end; i++) {
        uint32_t pixel = v->out->pixels[i];
        double x = pixel % PIXEL_ORACLE_SIZE + 0.5, y = pixel / PIXEL_ORACLE_SIZE + 0.5;
        sight seen = {v, ray_through(v, x, y), x, y, INFINITY, 0, MT_NONE, INFINITY};
        triangle_blocks_visit(&v->blocks, &query, &seen);
        v->out->faces[i] = seen.face;
        v->out->is_clear[i] = seen.face == MT_NONE ? seen.rival == INFINITY : seen.t + seen.slack < seen.rival;
    }
}

static mt_status allocate_pixels(mt_context *context, pixel_oracle *out)
{
    out->pixels = mt_allocate_array(context, PIXEL_COUNT, sizeof *out->pixels);
    out->faces = mt_allocate_array(context, PIXEL_COUNT, sizeof *out->faces);
    out->is_clear = mt_allocate(context, PIXEL_COUNT);
    return out->pixels && out->faces && out->is_clear ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static double within_picture(double x)
{
    return x > 0 ? (x < PIXEL_ORACLE_SIZE - 1 ? x : PIXEL_ORACLE_SIZE - 1) : 0;
}

/* Where the mesh may be. */
static void choose_pixels(const view *v)
{
    double low_x = PIXEL_ORACLE_SIZE, low_y = PIXEL_ORACLE_SIZE, high_x = 0, high_y = 0;
    for (mt_index vertex = 0; vertex < v->mesh->vertex_count; vertex++) {
        const place *p = &v->places[vertex];
        low_x = fmin(low_x, p->x), high_x = fmax(high_x, p->x);
        low_y = fmin(low_y, p->y), high_y = fmax(high_y, p->y);
    }
    tradeoff_random random = {3};
    for (size_t i = 0; i < PIXEL_COUNT; i++) {
        double x = within_picture(low_x + (high_x - low_x) * tradeoff_random_unit(&random));
        double y = within_picture(low_y + (high_y - low_y) * tradeoff_random_unit(&random));
        v->out->pixels[i] = (uint32_t)y * PIXEL_ORACLE_SIZE + (uint32_t)x;
    }
}

mt_status pixel_oracle_make(mt_context *context, const mt_mesh *mesh, double diagonal, pixel_oracle *out)
{
    view v = {.mesh = mesh, .diagonal = diagonal, .out = out};
    aim(&v);
    if (!(diagonal > 0 && isfinite(diagonal) && mt_vec3_is_finite(out->eye))) {
        return MT_OK;
    }
    mt_status status = mt_triangulation_init(context, mesh, &v.triangulation);
    if (status == MT_OK) {
        v.places = mt_allocate_array(context, mesh->vertex_count, sizeof *v.places);
        status = v.places ? allocate_pixels(context, out) : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        status = triangle_blocks_make(context, mesh, &v.triangulation, &v.blocks);
    }
    if (status == MT_OK) {
        mt_parallel_for(context, mesh->vertex_count, 4096, project, &v);
        choose_pixels(&v);
        out->count = triangle_blocks_ask(context, &v.blocks, PIXEL_COUNT, ORACLE_WORK, look, &v);
    }
    triangle_blocks_release(context, &v.blocks);
    mt_free(context, v.places);
    mt_triangulation_release(context, &v.triangulation);
    return status;
}

void pixel_oracle_release(mt_context *context, pixel_oracle *oracle)
{
    mt_free(context, oracle->pixels);
    mt_free(context, oracle->faces);
    mt_free(context, oracle->is_clear);
    memset(oracle, 0, sizeof *oracle);
}
