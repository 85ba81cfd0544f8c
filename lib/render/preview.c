/* The order of a preview: what is drawn, its normals, a view, a frame, tiles. */
#include <meshtool/preview.h>

#include "lib/render/framing.h"
#include "lib/render/picture.h"
#include "lib/render/view.h"

#include <math.h>
#include <string.h>

#define DEFAULT_SIZE 1024
#define DEFAULT_SAMPLES 16

/* No regular solid or prism has this angle: prisms turn by 360/n, so 45, 40 and 36 are taken, and an icosahedron
 * by 41.8. */
#define DEFAULT_CREASE 41.0

/* When the mesh covers less than a line of this many pixels' width across the picture, faces are outlined. */
#define FAINT_WIDTH 0.25

/* What a preview makes on its way; released whatever happened. */
typedef struct job {
    const mt_preview_options *options;
    unsigned samples;
    mt_model model;
    mt_corner_normals normals;
    mt_frame frame;
    mt_look look;
    mt_stroke *marks; /* dots, then lines */
    unsigned char *mark_colors;
    mt_index mark_count;
    mt_picture picture;
} job;

static mt_status check_samples(mt_context *context, unsigned samples)
{
    for (unsigned n = 1; n * n <= MT_MAXIMUM_SAMPLES; n++) {
        if (n * n == samples) {
            return MT_OK;
        }
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "samples a pixel are a square number from 1 to %d, not %u",
                   MT_MAXIMUM_SAMPLES, samples);
}

static mt_status check_options(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options)
{
    uint32_t largest = options->width > options->height ? options->width : options->height;
    if (largest > MT_PREVIEW_MAXIMUM_SIZE) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture has up to %d pixels on a side, not %u",
                       MT_PREVIEW_MAXIMUM_SIZE, largest);
    }
    if (!(options->crease_degrees >= 0 && options->crease_degrees <= 180)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the crease angle lies between 0 and 180 degrees, not at %g",
                       options->crease_degrees);
    }
    for (size_t i = 0; i < 2 * options->edge_mark_count; i++) {
        if (options->edge_marks[i] >= mesh->vertex_count) {
            return mt_fail(context, MT_ERROR_ARGUMENT, "a marked edge names vertex %u of a mesh of %u vertices",
                           options->edge_marks[i], mesh->vertex_count);
        }
    }
    return options->samples ? check_samples(context, options->samples) : MT_OK;
}

/* One mark in the color that `colors` holds at `color`, or in the usual one. */
static void append_mark(job *j, mt_stroke mark, const unsigned char *colors, size_t color, const unsigned char usual[3])
{
    memcpy(j->mark_colors + 3 * (size_t)j->mark_count, colors ? colors + 3 * color : usual, 3);
    j->marks[j->mark_count++] = mark;
}

static mt_status collect_marks(mt_context *context, job *j)
{
    static const unsigned char orange[3] = {250, 140, 13}, red[3] = {219, 26, 41};
    const mt_preview_options *options = j->options;
    mt_index vertex_count = options->vertex_marks ? j->model.mesh->vertex_count : 0, dot_count = 0;
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        dot_count += options->vertex_marks[vertex] != 0;
    }
    uint64_t count = (uint64_t)dot_count + options->edge_mark_count;
    if (count > MT_INDEX_MAX / 2) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu marks are too many for one picture",
                       (unsigned long long)count);
    }
    j->marks = (mt_stroke *)mt_allocate_array(context, count, sizeof *j->marks);
    j->mark_colors = (unsigned char *)mt_allocate_array(context, count, 3);
    if (!j->marks || !j->mark_colors) {
        return mt_context_error(context)->status;
    }
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        if (options->vertex_marks[vertex]) {
            append_mark(j, (mt_stroke){vertex, vertex}, options->vertex_mark_colors, vertex, orange);
        }
    }
    for (size_t i = 0; i < options->edge_mark_count; i++) {
        mt_stroke edge = {options->edge_marks[2 * i], options->edge_marks[2 * i + 1]};
        append_mark(j, edge, options->edge_mark_colors, i, red);
    }
    return MT_OK;
}

static mt_status make_normals(mt_context *context, job *j)
{
    int part = mt_part_begin(context, "corner normals", "faces meet smoothly below the crease angle");
    double crease = j->options->crease_degrees > 0 ? j->options->crease_degrees : DEFAULT_CREASE;
    mt_status status = mt_corner_normals_init(context, &j->model, &j->normals);
    if (status == MT_OK) {
        status = mt_corner_normals_build(context, &j->model, crease, &j->normals);
    }
    mt_part_end(context, part);
    return status;
}

static mt_status make_frame(mt_context *context, job *j)
{
    const mt_preview_options *options = j->options;
    mt_camera camera = {.width = options->width ? options->width : DEFAULT_SIZE,
                        .height = options->height ? options->height : DEFAULT_SIZE};
    mt_view view = mt_view_default(&j->normals);
    mt_camera_frame(&camera, view.toward_eye, view.up);
    int part = mt_part_begin(context, "projected vertices", "on a grid that makes edge tests exact");
    mt_status status = mt_camera_fit(context, &camera, &j->model, &(mt_framing){0});
    /* A marked vertex may be in nothing that is drawn; its mark is, where it falls into the picture. */
    for (mt_index i = 0; i < j->mark_count; i++) {
        mt_model_draw_vertex(&j->model, j->marks[i].a);
        mt_model_draw_vertex(&j->model, j->marks[i].b);
    }
    if (status == MT_OK) {
        status = mt_frame_init(context, &j->model, &camera, j->samples, MT_RAY_WATERTIGHT, &j->frame);
    }
    mt_part_end(context, part);
    if (status != MT_OK) {
        return status;
    }
    mt_look_init(&j->look, &j->frame, &j->normals, options->face_colors, view.up);
    return MT_OK;
}

static mt_backdrop make_backdrop(const mt_preview_options *options, const mt_surface *surface)
{
    mt_backdrop backdrop = {.transparent = options->background == MT_BACKGROUND_TRANSPARENT};
    if (options->background == MT_BACKGROUND_COLOR) {
        const double *c = options->background_color;
        backdrop.top = mt_linear_color(surface, c[0], c[1], c[2]);
        backdrop.bottom = backdrop.top;
    } else {
        backdrop.top = mt_linear_color(surface, 0.965, 0.97, 0.98);
        backdrop.bottom = mt_linear_color(surface, 0.83, 0.845, 0.865);
    }
    return backdrop;
}

/* Widths grow with the picture, and dots shrink where there are many. */
static void set_strokes(job *j)
{
    const mt_camera *camera = &j->frame.camera;
    double shorter = camera->width < camera->height ? camera->width : camera->height;
    double share = sqrt((double)camera->width * camera->height / (1.0 + j->model.dot_count));
    mt_stroke_set strokes = {.frame = &j->frame, .strokes = j->model.strokes, .count = j->model.stroke_count};
    strokes.line_radius = fmax(0.6, shorter / 900.0);
    strokes.dot_radius = fmax(0.9, fmin(0.12 * share, shorter / 90.0));
    strokes.nearness = 1.0005;
    mt_stroke_set marks = {.frame = &j->frame, .strokes = j->marks, .count = j->mark_count};
    marks.line_radius = fmax(0.8, shorter / 450.0);
    marks.dot_radius = fmax(1.5, shorter / 110.0);
    marks.nearness = 1.002;
    j->picture.strokes = strokes;
    j->picture.marks = marks;
    j->picture.mark_colors = j->mark_colors;
}

static bool is_faint(const job *j)
{
    const mt_camera *camera = &j->frame.camera;
    double longer = camera->width > camera->height ? camera->width : camera->height;
    return (double)j->picture.covered_samples < FAINT_WIDTH * longer * j->frame.sampling.sample_count;
}

static mt_status draw(mt_context *context, job *j, mt_image *image)
{
    j->picture.frame = &j->frame;
    j->picture.look = &j->look;
    j->picture.backdrop = make_backdrop(j->options, &j->look.surface);
    j->picture.image = image;
    set_strokes(j);
    mt_part_skip(context, "tree", "no tree: primary rays only");
    mt_status status = mt_picture_draw(context, &j->picture);
    if (status == MT_OK && j->model.stroke_count == 0 && is_faint(j)) {
        status = mt_model_outline(context, &j->model);
        set_strokes(j);
        if (status == MT_OK) {
            status = mt_picture_draw(context, &j->picture);
        }
    }
    return status;
}

static mt_status run(mt_context *context, const mt_mesh *mesh, job *j, mt_image **image)
{
    int part = mt_part_begin(context, "model", "what is drawn, its bounds, triangles");
    mt_status status = mt_model_init(context, mesh, &j->model);
    mt_part_end(context, part);
    if (status == MT_OK) {
        status = collect_marks(context, j);
    }
    if (status == MT_OK) {
        status = make_normals(context, j);
    }
    if (status == MT_OK) {
        status = make_frame(context, j);
    }
    if (status == MT_OK) {
        uint32_t channels = j->options->background == MT_BACKGROUND_TRANSPARENT ? 4 : 3;
        status = mt_image_create_unfilled(context, j->frame.camera.width, j->frame.camera.height, channels, image);
    }
    if (status == MT_OK) {
        (*image)->space = MT_COLOR_LINEAR;
        status = draw(context, j, *image);
    }
    return status;
}

mt_status mt_preview(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, mt_image **out)
{
    static const mt_preview_options defaults = {0};
    *out = NULL;
    job j;
    memset(&j, 0, sizeof j);
    j.options = options ? options : &defaults;
    mt_status status = check_options(context, mesh, j.options);
    if (status != MT_OK) {
        return status;
    }
    j.samples = j.options->samples ? j.options->samples : DEFAULT_SAMPLES;
    mt_image *image = NULL;
    status = run(context, mesh, &j, &image);
    mt_free(context, j.marks);
    mt_free(context, j.mark_colors);
    mt_frame_release(context, &j.frame);
    mt_corner_normals_release(context, &j.normals);
    mt_model_release(context, &j.model);
    if (status != MT_OK) {
        mt_image_destroy(context, image);
        return status;
    }
    *out = image;
    return MT_OK;
}
