/* The camera of one picture of a series. */
#include "lib/render/series.h"

#include <meshtool/elementary.h>

#include <string.h>

/* Directions in which a turntable is tried for its size. */
#define TRIED_TURNS 24

/* Receding lines of an oblique picture rise at 45 degrees. */
#define OBLIQUE_COMPONENT 0.70710678118654752

static const double obliquities[] = {[MT_PROJECTION_PERSPECTIVE] = 0,
                                     [MT_PROJECTION_ORTHOGRAPHIC] = 0,
                                     [MT_PROJECTION_CABINET] = 0.5,
                                     [MT_PROJECTION_CAVALIER] = 1};

static mt_vec3 to_model(const mt_model *model, const double p[3])
{
    return mt_model_point(model, mt_vec3_make(p[0], p[1], p[2]));
}

static mt_framing framing_of(const mt_preview_series *series)
{
    const mt_preview_options *options = &series->options;
    mt_framing framing = {.has_eye = options->has_eye, .has_target = options->has_target};
    framing.has_target = framing.has_target || options->turntable || (options->has_eye && options->fov_degrees > 0);
    framing.eye = options->has_eye ? to_model(&series->model, options->eye) : framing.eye;
    framing.target = options->has_target ? to_model(&series->model, options->target) : framing.target;
    framing.fov_degrees = options->fov_degrees;
    return framing;
}

static mt_view_name usual_view(const mt_preview_series *series, mt_view_name view)
{
    const mt_preview_options *options = &series->options;
    view = view == MT_VIEW_DEFAULT ? options->view : view;
    bool oblique = obliquities[options->projection] > 0;
    return view == MT_VIEW_DEFAULT && oblique && !options->has_eye ? MT_VIEW_FRONT : view;
}

static mt_view find_view(const mt_preview_series *series, mt_view_name name, double turn, mt_framing *framing)
{
    const mt_preview_options *options = &series->options;
    mt_vec3 up = options->has_up ? mt_vec3_make(options->up[0], options->up[1], options->up[2]) : mt_vec3_make(0, 0, 0);
    mt_view view = mt_view_make(&series->normals, usual_view(series, name), up);
    if (framing->has_eye) {
        mt_vec3 away = mt_vec3_normalize(mt_vec3_subtract(framing->eye, framing->target));
        view.toward_eye = mt_vec3_dot(away, away) > 0 ? away : view.toward_eye;
        view.up = view.axis;
    }
    view.toward_eye = mt_turned(view.toward_eye, view.axis, turn);
    view.up = mt_turned(view.up, view.axis, turn);
    mt_vec3 from_target = mt_vec3_subtract(framing->eye, framing->target);
    framing->eye = mt_vec3_add(framing->target, mt_turned(from_target, view.axis, turn));
    return view;
}

static mt_status take(mt_context *context, const mt_preview_series *series, mt_view_name name, double turn,
                      mt_camera *camera, mt_view *seen)
{
    mt_framing framing = framing_of(series);
    *seen = find_view(series, name, turn, &framing);
    double shear = obliquities[series->options.projection] * OBLIQUE_COMPONENT;
    camera->projection = series->options.projection;
    camera->shear_x = camera->shear_y = shear;
    mt_camera_frame(camera, seen->toward_eye, seen->up);
    return mt_camera_fit(context, camera, &series->model, &framing);
}

/* Turns the mesh once around, or to its six sides, to see how much room it needs. */
static mt_status find_steady(mt_context *context, mt_preview_series *series, mt_view_name name, mt_camera camera)
{
    mt_vec3 target = framing_of(series).target;
    mt_status status = MT_OK;
    mt_steady steady = {.is_set = true};
    int tries = series->shows_sides ? MT_VIEW_BOTTOM : TRIED_TURNS;
    for (int i = 0; status == MT_OK && i < tries; i++) {
        mt_view seen;
        double turn = series->shows_sides ? 0.0 : 360.0 * i / TRIED_TURNS;
        mt_view_name side = series->shows_sides ? (mt_view_name)(MT_VIEW_FRONT + i) : name;
        status = take(context, series, side, turn, &camera, &seen);
        steady.distance = fmax(steady.distance, mt_vec3_length(mt_vec3_subtract(camera.eye, target)));
        steady.half_width = fmax(steady.half_width, camera.half_width);
        steady.half_height = fmax(steady.half_height, camera.half_height);
    }
    series->steady = steady;
    return status;
}

static void apply_steady(const mt_preview_series *series, mt_camera *camera)
{
    camera->half_width = series->steady.half_width;
    camera->half_height = series->steady.half_height;
    if (!series->options.has_eye && !mt_camera_is_parallel(camera)) {
        mt_vec3 away = mt_vec3_scale(camera->forward, -series->steady.distance);
        camera->eye = mt_vec3_add(framing_of(series).target, away);
    }
}

mt_status mt_series_camera(mt_context *context, mt_preview_series *series, mt_view_name view, double turn_degrees,
                           mt_camera *camera, mt_view *seen)
{
    uint32_t width = series->options.width, height = series->options.height;
    memset(camera, 0, sizeof *camera);
    camera->width = width;
    camera->height = height;
    mt_status status = MT_OK;
    if (series->options.turntable && !series->steady.is_set) {
        status = find_steady(context, series, view, *camera);
    }
    if (status == MT_OK) {
        status = take(context, series, view, turn_degrees, camera, seen);
    }
    if (status == MT_OK && series->options.turntable) {
        apply_steady(series, camera);
    }
    if (status == MT_OK && !mt_vec3_is_finite(camera->eye)) {
        status =
            mt_fail(context, MT_ERROR_ARGUMENT, "the eye is too far from the mesh to see it: its distance overflows");
    }
    return status;
}
