/* The order of a preview: what is drawn, its colours and normals; then for each picture a camera, a frame, tiles. */
#include "lib/render/backdrop.h"
#include "lib/render/coloring.h"
#include "lib/render/ground.h"
#include "lib/render/overlay.h"
#include "lib/render/series.h"

#include <math.h>
#include <string.h>

#define DEFAULT_SIZE 1024
#define DEFAULT_SAMPLES 16
#define ADAPTIVE_COARSE 4
#define ADAPTIVE_FINE 64

/* No regular solid or prism has this angle: prisms turn by 360/n, so 45, 40 and 36 are taken, and an icosahedron
 * by 41.8. */
#define DEFAULT_CREASE 41.0

/* When the mesh covers less than a line of this many pixels' width across the picture, faces are outlined. */
#define FAINT_WIDTH 0.25

/* With fewer triangles a ray tries them all: a tree would not be paid for. */
#define FEW_TRIANGLES 64

static mt_status make_normals(mt_context *context, mt_preview_series *series)
{
    const mt_preview_options *options = &series->options;
    mt_status status = mt_corner_normals_init(context, &series->model, &series->normals);
    if (status != MT_OK) {
        return status;
    }
    if (options->shading == MT_SHADING_FLAT) {
        series->normals.flat = true;
        mt_part_skip(context, "corner normals", "flat shading: each face has its own");
        return MT_OK;
    }
    int part = mt_part_begin(context, "corner normals", "faces meet smoothly below the crease angle");
    double crease = options->crease_degrees > 0 ? options->crease_degrees : DEFAULT_CREASE;
    bool smooth = options->shading == MT_SHADING_SMOOTH;
    series->normals.own = smooth || options->crease_degrees > 0; /* asked for, not found */
    status = mt_corner_normals_build(context, &series->model, smooth ? 180.0 : crease, &series->normals);
    mt_part_end(context, part);
    return status;
}

/* What rays search. */
static mt_ray_structure_kind choose_structure(const mt_preview_options *options, mt_index count)
{
    static const mt_ray_structure_kind kinds[] = {
        [MT_ACCELERATION_NONE] = MT_RAY_STRUCTURE_NONE, [MT_ACCELERATION_AABB] = MT_RAY_STRUCTURE_AABB,
        [MT_ACCELERATION_OBB] = MT_RAY_STRUCTURE_OBB,   [MT_ACCELERATION_GRID] = MT_RAY_STRUCTURE_GRID,
        [MT_ACCELERATION_BSP] = MT_RAY_STRUCTURE_BSP,
    };
    if (options->acceleration == MT_ACCELERATION_AUTO) {
        return count > FEW_TRIANGLES ? MT_RAY_STRUCTURE_AABB : MT_RAY_STRUCTURE_NONE;
    }
    return kinds[options->acceleration];
}

/* Why there is a tree, or none. */
static mt_status make_occluder(mt_context *context, mt_preview_series *series)
{
    const mt_preview_options *options = &series->options;
    series->by_rays = options->method == MT_METHOD_RAY;
    series->has_occluder = series->by_rays || options->shadows;
    mt_ray_structure_kind kind = choose_structure(options, series->model.triangulation.triangle_count);
    if (!options->shadows) {
        mt_part_skip(context, "shadow rays", "no shadows asked for");
    }
    if (!series->has_occluder) {
        mt_part_skip(context, "tree", "primary rays only: triangles go to the pixels that they cover");
        return MT_OK;
    }
    if (kind == MT_RAY_STRUCTURE_NONE) {
        mt_part_skip(context, "tree",
                     options->acceleration == MT_ACCELERATION_NONE
                         ? "asked to do without: every ray meets every triangle"
                         : "few triangles: every ray meets them all");
    }
    return mt_occluder_init(context, &series->model, (mt_ray_profile)options->triangle_test, kind, &series->occluder);
}

static mt_status build(mt_context *context, const mt_mesh *mesh, mt_preview_series *series)
{
    int part = mt_part_begin(context, "model", "what is drawn, its bounds, triangles");
    mt_status status = mt_model_init(context, mesh, &series->model);
    mt_part_end(context, part);
    if (status == MT_OK) {
        status = mt_marks_init(context, &series->model, &series->options, &series->marks);
    }
    if (status == MT_OK) {
        status = mt_coloring_faces(context, &series->model, series->options.coloring, &series->face_colors);
    }
    if (status == MT_OK) {
        status = make_normals(context, series);
    }
    return status == MT_OK ? make_occluder(context, series) : status;
}

mt_status mt_preview_series_create(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                                   mt_preview_series **out)
{
    static const mt_preview_options defaults = {0};
    *out = NULL;
    options = options ? options : &defaults;
    mt_status status = mt_preview_check(context, mesh, options);
    if (status != MT_OK) {
        return status;
    }
    mt_preview_series *series = (mt_preview_series *)mt_allocate_zeroed(context, sizeof *series);
    if (!series) {
        return mt_context_error(context)->status;
    }
    series->options = *options;
    series->options.width = options->width ? options->width : DEFAULT_SIZE;
    series->options.height = options->height ? options->height : DEFAULT_SIZE;
    bool adaptive = options->samples == MT_SAMPLES_ADAPTIVE;
    series->samples = adaptive ? ADAPTIVE_COARSE : options->samples ? options->samples : DEFAULT_SAMPLES;
    series->fine_samples = adaptive ? ADAPTIVE_FINE : 0;
    status = build(context, mesh, series);
    if (status != MT_OK) {
        mt_preview_series_destroy(context, series);
        return status;
    }
    *out = series;
    return MT_OK;
}

void mt_preview_series_destroy(mt_context *context, mt_preview_series *series)
{
    if (series) {
        mt_occluder_release(context, &series->occluder);
        mt_marks_release(context, &series->marks);
        mt_corner_normals_release(context, &series->normals);
        mt_model_release(context, &series->model);
        mt_free(context, series->face_colors);
        mt_free(context, series);
    }
}

/* What one picture needs beside the series. */
typedef struct job {
    mt_preview_series *series;
    mt_view view;
    mt_frame frame;
    mt_look look;
    mt_picture picture;
} job;

static mt_status make_frame(mt_context *context, job *j, mt_view_name view, double turn)
{
    mt_preview_series *series = j->series;
    mt_camera camera;
    int part = mt_part_begin(context, "projected vertices", "where each falls in the picture, and how deep");
    mt_status status = mt_series_camera(context, series, view, turn, &camera, &j->view);
    /* A marked vertex may be in nothing that is drawn; its mark is, where it falls into the picture. */
    for (mt_index i = 0; i < series->marks.count; i++) {
        mt_model_draw_vertex(&series->model, series->marks.strokes[i].a);
        mt_model_draw_vertex(&series->model, series->marks.strokes[i].b);
    }
    if (status == MT_OK) {
        mt_ray_profile profile = (mt_ray_profile)series->options.triangle_test;
        status = mt_frame_init(context, &series->model, &camera, series->samples, profile, &j->frame);
    }
    mt_part_end(context, part);
    return status;
}

static mt_status make_look(mt_context *context, job *j)
{
    const mt_preview_series *series = j->series;
    const mt_preview_options *options = &series->options;
    const unsigned char *colors = series->face_colors ? series->face_colors : options->face_colors;
    const mt_mesh *colored = options->coloring == MT_COLORING_DEFAULT ? series->model.mesh : NULL;
    mt_look_init(&j->look, &j->frame, &series->normals, colored, colors, j->view.axis);
    j->look.shadows = options->shadows ? &series->occluder : NULL;
    mt_coloring_apply(options, &j->look);
    if (!options->ground) {
        mt_part_skip(context, "ground", "not asked for");
        return MT_OK;
    }
    mt_status status = mt_ground_init(context, &series->model, j->view.axis, &j->look.ground);
    j->look.ground.color = mt_linear_color(&j->look.surface, 0.86, 0.865, 0.875);
    return status;
}

/* Widths grow with the picture, and dots shrink where there are many; a dense wireframe pales, so that the surface is
 * still seen. */
static void set_strokes(job *j)
{
    const mt_camera *camera = &j->frame.camera;
    const mt_preview_series *series = j->series;
    double shorter = camera->width < camera->height ? camera->width : camera->height;
    double area = (double)camera->width * camera->height, share = sqrt(area / (1.0 + series->model.dot_count));
    double near = mt_camera_is_parallel(camera) ? 0.25 : 1.0;
    mt_stroke_set strokes = {.frame = &j->frame, .strokes = series->model.strokes, .thin_first = MT_NONE};
    strokes.count = series->model.stroke_count;
    strokes.line_radius = fmax(0.6, shorter / 900.0);
    strokes.dot_radius = fmax(0.9, fmin(0.12 * share, shorter / 90.0));
    strokes.nearness = 1.0 + 0.0005 * near;
    mt_stroke_set marks = {.frame = &j->frame, .strokes = series->marks.strokes, .count = series->marks.count};
    marks.line_radius = fmax(0.8, shorter / 450.0);
    marks.dot_radius = fmax(1.5, shorter / 110.0);
    marks.nearness = 1.0 + 0.002 * near;
    marks.thin_first = series->marks.wire_first;
    marks.thin_radius = fmax(0.5, shorter / 1900.0);
    double edges = 1.0 + (series->marks.count - series->marks.wire_first);
    j->picture.faint_opacity = fmin(0.85, fmax(0.12, sqrt(area / edges) / (24.0 * marks.thin_radius)));
    j->picture.faint_mark = series->marks.wire_first;
    j->picture.strokes = strokes;
    j->picture.marks = marks;
    j->picture.mark_colors = series->marks.colors;
}

static bool is_faint(const job *j)
{
    const mt_camera *camera = &j->frame.camera;
    double longer = camera->width > camera->height ? camera->width : camera->height;
    return (double)j->picture.covered_samples < FAINT_WIDTH * longer * j->frame.sampling.sample_count;
}

static mt_status draw(mt_context *context, job *j, mt_image *image)
{
    mt_preview_series *series = j->series;
    j->picture.frame = &j->frame;
    j->picture.look = &j->look;
    j->picture.rays = series->by_rays ? &series->occluder : NULL;
    j->picture.fine_samples = series->fine_samples;
    j->picture.backdrop = mt_backdrop_make(&series->options, &j->look.surface);
    j->picture.image = image;
    set_strokes(j);
    mt_status status = mt_picture_draw(context, &j->picture);
    if (status == MT_OK && series->model.stroke_count == 0 && !series->options.has_eye && is_faint(j)) {
        status = mt_model_outline(context, &series->model);
        set_strokes(j);
        if (status == MT_OK) {
            status = mt_picture_draw(context, &j->picture);
        }
    }
    if (status == MT_OK && j->picture.covered_samples == 0) {
        mt_warn(context, "the picture shows nothing of the mesh: it lies outside of the view");
    }
    return status;
}

/* Distances that the depth colouring tells apart. */
static void find_depths(job *j)
{
    double low = INFINITY, high = 0;
    for (mt_index vertex = 0; vertex < j->series->model.mesh->vertex_count; vertex++) {
        double depth = j->frame.vertices[vertex].depth;
        if (depth != 0) {
            double distance = depth > 0 ? mt_camera_distance(&j->frame.camera, depth) : 0.0;
            low = fmin(low, distance);
            high = fmax(high, distance);
        }
    }
    j->look.nearest = low;
    j->look.farthest = high;
}

static mt_status run(mt_context *context, job *j, mt_view_name view, double turn, mt_image **image)
{
    const mt_preview_options *options = &j->series->options;
    mt_status status = make_frame(context, j, view, turn);
    if (status == MT_OK) {
        status = make_look(context, j);
    }
    if (status == MT_OK) {
        uint32_t channels = options->background == MT_BACKGROUND_TRANSPARENT ? 4 : 3;
        status = mt_image_create_unfilled(context, options->width, options->height, channels, image);
    }
    if (status == MT_OK) {
        (*image)->space = MT_COLOR_LINEAR;
        if (j->look.paint == MT_PAINT_DEPTH) {
            find_depths(j);
        }
        if (options->count_unseen) {
            j->look.seen = (unsigned char *)mt_allocate_zeroed(context, j->series->model.mesh->face_count);
            status = j->look.seen ? MT_OK : mt_context_error(context)->status;
        }
    }
    if (status == MT_OK) {
        status = draw(context, j, *image);
    }
    return status;
}

static mt_index count_unseen(const job *j)
{
    mt_index face_count = j->series->model.mesh->face_count, count = 0;
    for (mt_index face = 0; j->look.seen && face < face_count; face++) {
        count += !j->look.seen[face];
    }
    return count;
}

static mt_status draw_scratch(mt_context *context, job *j, mt_image *scratch, const char *name, const char *reason)
{
    int part = mt_part_begin_skipped(context, name, reason);
    j->picture.image = scratch;
    mt_status status = mt_picture_draw(context, &j->picture);
    mt_part_end(context, part);
    return status;
}

/* Draws once more in the ways that were not needed, into a picture that nobody sees. */
static mt_status measure_skipped(mt_context *context, job *j)
{
    mt_preview_series *series = j->series;
    mt_image *scratch = NULL, *kept = j->picture.image;
    mt_occluder own, *occluder = &series->occluder;
    mt_status status = MT_OK;
    memset(&own, 0, sizeof own);
    if (!series->has_occluder) {
        int part = mt_part_begin_skipped(context, "tree", "what a tree of boxes would have taken");
        mt_ray_profile profile = (mt_ray_profile)series->options.triangle_test;
        status = mt_occluder_init(context, &series->model, profile, MT_RAY_STRUCTURE_AABB, &own);
        mt_part_end(context, part);
        occluder = &own;
    }
    if (status == MT_OK) {
        status = mt_image_create_unfilled(context, kept->width, kept->height, kept->channel_count, &scratch);
    }
    if (status == MT_OK && !series->by_rays) {
        j->picture.rays = occluder;
        status = draw_scratch(context, j, scratch, "a ray for each sample", "the whole drawing, in image order");
    }
    j->picture.rays = series->by_rays ? occluder : NULL;
    if (status == MT_OK && !series->options.shadows) {
        j->look.shadows = occluder;
        status = draw_scratch(context, j, scratch, "shadow rays", "the whole drawing, with shadows");
        j->look.shadows = NULL;
    }
    mt_image_destroy(context, scratch);
    mt_occluder_release(context, &own);
    return status;
}

mt_status mt_preview_series_draw(mt_context *context, mt_preview_series *series, mt_view_name view, double turn_degrees,
                                 mt_image **out, mt_preview_report *report)
{
    *out = NULL;
    job j;
    memset(&j, 0, sizeof j);
    j.series = series;
    mt_image *image = NULL;
    mt_preview_report found = {.unseen_faces = 0};
    mt_status status = run(context, &j, view, turn_degrees, &image);
    if (status == MT_OK && series->options.measure_skipped) {
        status = measure_skipped(context, &j);
    }
    if (status == MT_OK) {
        found.unseen_faces = count_unseen(&j);
        mt_overlay_draw(series, &j.frame.camera, image, &found);
    }
    mt_free(context, j.look.seen);
    mt_frame_release(context, &j.frame);
    if (status != MT_OK) {
        mt_image_destroy(context, image);
        return status;
    }
    if (report) {
        *report = found;
    }
    *out = image;
    return MT_OK;
}

mt_status mt_preview_reported(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                              mt_image **out, mt_preview_report *report)
{
    *out = NULL;
    mt_preview_series *series = NULL;
    mt_status status = mt_preview_series_create(context, mesh, options, &series);
    if (status == MT_OK) {
        status = mt_preview_series_draw(context, series, MT_VIEW_DEFAULT, 0, out, report);
    }
    mt_preview_series_destroy(context, series);
    return status;
}

mt_status mt_preview(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, mt_image **out)
{
    return mt_preview_reported(context, mesh, options, out, NULL);
}
