#include "lib/render/coloring.h"

#include <meshtool/components.h>
#include <meshtool/palette.h>

#include <math.h>
#include <string.h>

#define FACE_BLOCK 16384

typedef struct paint_task {
    const mt_model *model;
    const mt_components *components;
    unsigned char *colors;
} paint_task;

static void paint_each(void *user, uint64_t begin, uint64_t end)
{
    const paint_task *task = (const paint_task *)user;
    for (uint64_t face = begin; face < end; face++) {
        mt_palette_distinct_color((mt_index)face, task->colors + 3 * face);
    }
}

static void paint_components(void *user, uint64_t begin, uint64_t end)
{
    const paint_task *task = (const paint_task *)user;
    for (uint64_t face = begin; face < end; face++) {
        mt_palette_color(task->components->face_component[face], 0.42, 0.88, task->colors + 3 * face);
    }
}

/* From a blue that says good over green and yellow to red. */
static void set_quality(unsigned char *color, double quality)
{
    static const double stops[][3] = {{178, 24, 43}, {239, 138, 60}, {250, 219, 110}, {134, 190, 130}, {52, 114, 180}};
    double at = fmin(fmax(quality, 0.0), 1.0) * 4.0;
    int low = at < 3 ? (int)at : 3;
    for (int i = 0; i < 3; i++) {
        color[i] = (unsigned char)(stops[low][i] + (at - low) * (stops[low + 1][i] - stops[low][i]) + 0.5);
    }
}

/* 8 (s-a)(s-b)(s-c) / abc = (b+c-a)(c+a-b)(a+b-c) / abc. */
double mt_radius_ratio(mt_vec3 p, mt_vec3 q, mt_vec3 r)
{
    double a = mt_vec3_length(mt_vec3_subtract(q, r)), b = mt_vec3_length(mt_vec3_subtract(r, p)),
           c = mt_vec3_length(mt_vec3_subtract(p, q));
    double product = a * b * c;
    double ratio = product > 0 ? (b + c - a) * (c + a - b) * (a + b - c) / product : 0.0;
    return ratio > 0 ? fmin(ratio, 1.0) : 0.0;
}

static double triangle_quality(const mt_model *model, mt_index triangle)
{
    mt_vec3 p[3];
    for (mt_index i = 0; i < 3; i++) {
        mt_index corner = mt_triangulation_corner(&model->triangulation, triangle, i);
        p[i] = mt_model_position(model, model->mesh->corner_vertices[corner]);
    }
    return mt_radius_ratio(p[0], p[1], p[2]);
}

/* Triangles come in the order of the faces, each with two fewer than its corners. */
static void paint_quality(void *user, uint64_t begin, uint64_t end)
{
    const paint_task *task = (const paint_task *)user;
    const mt_mesh *mesh = task->model->mesh;
    for (uint64_t face = begin; face < end; face++) {
        mt_index corners = mt_mesh_face_begin(mesh, (mt_index)face), triangle = corners - 2 * (mt_index)face;
        mt_index count = mt_mesh_face_end(mesh, (mt_index)face) - corners - 2;
        double quality = 1.0;
        for (mt_index i = 0; i < count; i++) {
            quality = fmin(quality, triangle_quality(task->model, triangle + i));
        }
        set_quality(task->colors + 3 * face, quality);
    }
}

/* How each colouring is made. */
static const struct {
    mt_parallel_body paint;
    bool by_component;
} painters[MT_COLORING_COUNT] = {
    [MT_COLORING_FACE] = {paint_each, false},
    [MT_COLORING_COMPONENT] = {paint_components, true},
    [MT_COLORING_QUALITY] = {paint_quality, false},
};

static mt_status find_components(mt_context *context, const mt_mesh *mesh, mt_components **out)
{
    mt_edge_pairs *pairs = NULL;
    int part = mt_part_begin(context, "components", "colours by component");
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        status = mt_components_create(context, mesh, pairs, true, out);
    }
    mt_edge_pairs_destroy(context, pairs);
    mt_part_end(context, part);
    return status;
}

mt_status mt_coloring_faces(mt_context *context, const mt_model *model, mt_coloring coloring, unsigned char **out)
{
    *out = NULL;
    mt_parallel_body paint = painters[coloring].paint;
    mt_components *components = NULL;
    if (!paint) {
        return MT_OK;
    }
    if (painters[coloring].by_component) {
        mt_status status = find_components(context, model->mesh, &components);
        if (status != MT_OK) {
            return status;
        }
    }
    paint_task task = {.model = model, .components = components};
    task.colors = (unsigned char *)mt_allocate_array(context, model->mesh->face_count, 3);
    if (task.colors) {
        mt_parallel_for(context, model->mesh->face_count, FACE_BLOCK, paint, &task);
    }
    mt_components_destroy(context, components);
    *out = task.colors;
    return task.colors ? MT_OK : mt_context_error(context)->status;
}

void mt_coloring_apply(const mt_preview_options *options, mt_look *look)
{
    if (options->coloring == MT_COLORING_NORMAL) {
        look->paint = MT_PAINT_NORMAL;
    } else if (options->coloring == MT_COLORING_DEPTH) {
        look->paint = MT_PAINT_DEPTH;
    } else if (options->coloring == MT_COLORING_ORIENTATION) {
        look->front_color = mt_linear_color(&look->surface, 0.42, 0.60, 0.86);
        look->back_color = mt_linear_color(&look->surface, 0.86, 0.27, 0.22);
    }
    if (options->coloring != MT_COLORING_DEFAULT) {
        look->back_tint = mt_vec3_make(1, 1, 1); /* a colour that means something is the same on both sides */
    }
}
