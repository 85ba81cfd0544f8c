#include "lib/render/overlay.h"

#include <meshtool/elementary.h>

#include <stdio.h>

/* Sizes as parts of the picture's shorter side. */
#define MARGIN 0.035
#define AXIS_LENGTH 0.075
#define TEXT_HEIGHT 0.017
#define BAR_SHARE 0.25 /* of the width, at most */

static double shorter_side(const mt_camera *camera)
{
    return camera->width < camera->height ? camera->width : camera->height;
}

mt_vec3 mt_overlay_color(const mt_preview_options *options)
{
    const double *c = options->background_color;
    bool dark = options->background == MT_BACKGROUND_COLOR && 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] < 0.45;
    return dark ? mt_vec3_make(0.80, 0.82, 0.85) : mt_vec3_make(0.035, 0.045, 0.06);
}

/* An arrow of the axes, in pixels; back: how far its tip lies behind the others'. */
typedef struct arrow {
    const char *name;
    mt_vec3 color;
    double x, y, back;
} arrow;

static void draw_arrow(mt_ink ink, double x, double y, double length, const arrow *a)
{
    double tip_x = x + a->x * length, tip_y = y + a->y * length, thin = ink.radius;
    ink.color = a->color;
    mt_ink_line(&ink, x, y, tip_x, tip_y);
    for (int i = 0; i <= 8; i++) { /* a tapering head */
        double at = 0.80 + 0.025 * i;
        ink.radius = thin * (2.6 - 0.29 * i);
        mt_ink_line(&ink, x + a->x * length * at, y + a->y * length * at, x + a->x * length * (at + 0.02),
                    y + a->y * length * (at + 0.02));
    }
    double shown = sqrt(a->x * a->x + a->y * a->y);
    if (shown > 0.15) { /* an arrow towards the eye hides its own letter */
        double away = 0.22 * length / shown;
        ink.radius = thin * 0.7;
        mt_ink_text(&ink, tip_x + a->x * away, tip_y + a->y * away, 0.22 * length, a->name);
    }
}

static void draw_axes(const mt_camera *camera, mt_image *image)
{
    static const mt_vec3 colors[3] = {{0.60, 0.03, 0.03}, {0.04, 0.33, 0.05}, {0.04, 0.12, 0.65}};
    static const char *const names[3] = {"X", "Y", "Z"};
    arrow arrows[3];
    for (int i = 0; i < 3; i++) {
        mt_vec3 axis = mt_vec3_make(i == 0, i == 1, i == 2);
        double back = mt_vec3_dot(axis, camera->forward);
        double right = mt_vec3_dot(axis, camera->right) + camera->shear_x * back;
        double up = mt_vec3_dot(axis, camera->up) + camera->shear_y * back;
        arrows[i] = (arrow){names[i], colors[i], right, -up, back};
    }
    for (int i = 1; i < 3; i++) { /* those behind first */
        for (int k = i; k > 0 && arrows[k].back > arrows[k - 1].back; k--) {
            arrow swapped = arrows[k];
            arrows[k] = arrows[k - 1];
            arrows[k - 1] = swapped;
        }
    }
    double side = shorter_side(camera), length = AXIS_LENGTH * side, from_edge = MARGIN * side + 1.25 * length;
    const mt_ink ink = {image, colors[0], fmax(0.6, side / 700.0)};
    for (int i = 0; i < 3; i++) {
        draw_arrow(ink, from_edge, camera->height - from_edge, length, &arrows[i]);
    }
}

/* The largest of 1, 2 and 5 times a power of ten that is not above. */
static double round_length(double above)
{
    double power = 1;
    for (; power * 10 <= above && power < 1e300; power *= 10) {
    }
    for (; power > above && power > 1e-300; power /= 10) {
    }
    return power * 5 <= above ? power * 5 : power * 2 <= above ? power * 2 : power;
}

static double draw_scale_bar(const mt_preview_series *series, const mt_camera *camera, double units_per_pixel,
                             mt_image *image)
{
    double side = shorter_side(camera), length = round_length(BAR_SHARE * camera->width * units_per_pixel);
    double pixels = length / units_per_pixel, height = fmax(7.0, TEXT_HEIGHT * side);
    double right = camera->width - MARGIN * side, y = camera->height - MARGIN * side, tick = 0.35 * height;
    if (!(pixels > 0 && pixels <= camera->width)) {
        return 0;
    }
    char text[32];
    snprintf(text, sizeof text, "%.6g", length);
    const mt_ink ink = {image, mt_overlay_color(&series->options), fmax(0.5, height / 15.0)};
    mt_ink_line(&ink, right - pixels, y, right, y);
    mt_ink_line(&ink, right - pixels, y - tick, right - pixels, y + tick);
    mt_ink_line(&ink, right, y - tick, right, y + tick);
    mt_ink_text(&ink, right - 0.5 * pixels, y - 1.3 * height, height, text);
    return length;
}

void mt_overlay_draw(const mt_preview_series *series, const mt_camera *camera, mt_image *image,
                     mt_preview_report *report)
{
    const mt_preview_options *options = &series->options;
    const mt_model *model = &series->model;
    mt_vec3 target = mt_vec3_make(0, 0, 0);
    if (options->has_target) {
        target = mt_model_point(model, mt_vec3_make(options->target[0], options->target[1], options->target[2]));
    }
    double along = mt_vec3_dot(mt_vec3_subtract(target, camera->eye), camera->forward);
    mt_vec3 on_axis = mt_vec3_add(camera->eye, mt_vec3_scale(camera->forward, along));
    double extent = 2.0 * camera->half_width * (mt_camera_is_parallel(camera) ? 1.0 : along);
    mt_vec3 eye = mt_model_original(model, camera->eye), middle = mt_model_original(model, on_axis);
    report->eye[0] = eye.x, report->eye[1] = eye.y, report->eye[2] = eye.z;
    report->target[0] = middle.x, report->target[1] = middle.y, report->target[2] = middle.z;
    report->units_per_pixel = extent / camera->width / model->unit / model->scales[0] / model->scales[1];
    if (options->axes) {
        draw_axes(camera, image);
    }
    if (options->scale_bar && report->units_per_pixel > 0) {
        report->scale_bar_length = draw_scale_bar(series, camera, report->units_per_pixel, image);
    }
}
