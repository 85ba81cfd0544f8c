#include "defect_paint.h"
#include "preview.h"
#include "profile.h"
#include "quantity.h"
#include "strip_paint.h"

#include <string.h>

static const struct {
    const char *name;
    preview_coloring value;
} colorings[] = {
    {"none", {.kind = MT_COLORING_NONE}},
    {"normal", {.kind = MT_COLORING_NORMAL}},
    {"face", {.kind = MT_COLORING_FACE}},
    {"component", {.kind = MT_COLORING_COMPONENT}},
    {"defect", {.kind = MT_COLORING_NONE, .defects = true}},
    {"quality", {.kind = MT_COLORING_QUALITY}},
    {"depth", {.kind = MT_COLORING_DEPTH}},
    {"orientation", {.kind = MT_COLORING_ORIENTATION}},
    {"strip", {.kind = MT_COLORING_NONE, .strips = true}},
};

static const struct {
    const char *name;
    mt_acceleration value;
} accelerations[] = {{"auto", MT_ACCELERATION_AUTO}, {"none", MT_ACCELERATION_NONE}, {"aabb", MT_ACCELERATION_AABB},
                     {"obb", MT_ACCELERATION_OBB},   {"grid", MT_ACCELERATION_GRID}, {"bsp", MT_ACCELERATION_BSP}};

bool preview_parse_coloring(const cli_option *option, const char *text, void *value)
{
    (void)option;
    for (size_t i = 0; i < sizeof colorings / sizeof *colorings; i++) {
        if (strcmp(text, colorings[i].name) == 0) {
            *(preview_coloring *)value = colorings[i].value;
            return true;
        }
    }
    return false;
}

bool preview_parse_acceleration(const cli_option *option, const char *text, void *value)
{
    (void)option;
    for (size_t i = 0; i < sizeof accelerations / sizeof *accelerations; i++) {
        if (strcmp(text, accelerations[i].name) == 0) {
            *(mt_acceleration *)value = accelerations[i].value;
            return true;
        }
    }
    return false;
}

bool preview_can_number(const char *path)
{
    return !cli_is_standard_output(path) && strncmp(path, "/dev/", 5) != 0;
}

static mt_projection projection_of(const preview_settings *settings)
{
    static const mt_projection choices[] = {MT_PROJECTION_PERSPECTIVE, MT_PROJECTION_ORTHOGRAPHIC,
                                            MT_PROJECTION_CABINET, MT_PROJECTION_CAVALIER, MT_PROJECTION_CABINET};
    if (settings->projection == PREVIEW_NO_PROJECTION) {
        bool sides = settings->sheet && settings->turntable == 0;
        return sides ? MT_PROJECTION_ORTHOGRAPHIC : MT_PROJECTION_PERSPECTIVE;
    }
    return choices[settings->projection];
}

static mt_preview_options options_of(const preview_settings *settings)
{
    const cli_profile *profile = cli_profile_of(&settings->common);
    mt_preview_options how = {
        .width = settings->size.width,
        .height = settings->size.height,
        .background = settings->background.kind,
        .crease_degrees = settings->crease,
        .samples = settings->samples ? settings->samples : profile->samples,
        .projection = projection_of(settings),
        .view = (mt_view_name)settings->view,
        .has_up = settings->up.is_given,
        .has_eye = settings->eye.is_given,
        .has_target = settings->target.is_given,
        .fov_degrees = settings->fov,
        .shading = (mt_shading)settings->shading,
        .coloring = settings->coloring.kind,
        .wireframe = settings->wireframe,
        .shadows = settings->shadows,
        .ground = settings->ground,
        .axes = settings->axes,
        .scale_bar = settings->scale_bar,
        .method = (mt_visibility_method)settings->method,
        .acceleration = settings->acceleration,
        .triangle_test = settings->test == PREVIEW_NO_TEST ? profile->triangle_test : (mt_ray_profile)settings->test,
        .turntable = settings->turntable > 0,
        .measure_skipped = settings->common.measure,
        .count_unseen = settings->common.json,
    };
    memcpy(how.background_color, settings->background.color, sizeof how.background_color);
    memcpy(how.up, settings->up.at, sizeof how.up);
    memcpy(how.eye, settings->eye.at, sizeof how.eye);
    memcpy(how.target, settings->target.at, sizeof how.target);
    return how;
}

static json_t *point_json(const double p[3])
{
    json_t *array = cli_json_array();
    for (int i = 0; i < 3; i++) {
        cli_json_append(array, cli_json_real(p[i]));
    }
    return array;
}

static void print_json(const cli_job *job, const mt_mesh_format *read, const mt_image *image, unsigned pictures,
                       const mt_preview_report *report)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(read->name));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "width", cli_json_integer(image->width));
    cli_json_set(object, "height", cli_json_integer(image->height));
    cli_json_set(object, "pictures", cli_json_integer(pictures));
    if (report) {
        cli_json_set(object, "eye", point_json(report->eye));
        cli_json_set(object, "target", point_json(report->target));
        cli_json_set(object, "units_per_pixel", cli_json_real(report->units_per_pixel));
        cli_json_set(object, "scale_bar",
                     report->scale_bar_length > 0 ? cli_json_real(report->scale_bar_length) : json_null());
        cli_json_set(object, "unseen_faces", cli_json_integer(report->unseen_faces));
    }
    cli_json_print_line(object);
    json_decref(object);
}

/* name.png -> name-007.png, with as many digits as the last needs. */
static char *numbered_path(const cli_job *job, const char *path, unsigned number, unsigned last)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    size_t stem = dot && (!slash || dot > slash + 1) && dot > path ? (size_t)(dot - path) : strlen(path);
    size_t room = strlen(path) + 16;
    int digits = last < 10 ? 1 : last < 100 ? 2 : last < 1000 ? 3 : 4;
    char *name = mt_allocate(job->context, room);
    if (name) {
        snprintf(name, room, "%.*s-%0*u%s", (int)stem, path, digits, number, path + stem);
    }
    return name;
}

static cli_exit write_turns(const cli_job *job, const mt_mesh_format *read, mt_preview_series *series, unsigned turns)
{
    cli_exit code = CLI_EXIT_DONE;
    for (unsigned i = 0; code == CLI_EXIT_DONE && i < turns; i++) {
        mt_image *image = NULL;
        mt_preview_report report;
        char *path = numbered_path(job, job->common->output, i + 1, turns);
        mt_status status =
            path ? mt_preview_series_draw(job->context, series, MT_VIEW_DEFAULT, 360.0 * i / turns, &image, &report)
                 : MT_ERROR_OUT_OF_MEMORY;
        code = status == MT_OK ? cli_write_image(job, image, path) : cli_report_failure(job, job->operands[0]);
        if (code == CLI_EXIT_DONE && i + 1 == turns && job->common->json) {
            print_json(job, read, image, turns, NULL);
        }
        mt_image_destroy(job->context, image);
        mt_free(job->context, path);
    }
    return code;
}

static cli_exit draw_turns(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read,
                           const mt_preview_options *how, unsigned turns)
{
    mt_preview_series *series = NULL;
    if (mt_preview_series_create(job->context, mesh, how, &series) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = write_turns(job, read, series, turns);
    mt_preview_series_destroy(job->context, series);
    return code;
}

static cli_exit draw_one(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read,
                         const mt_preview_options *how)
{
    const preview_settings *settings = job->settings;
    mt_image *image = NULL;
    mt_preview_report report;
    mt_status status = settings->sheet ? mt_preview_sheet(job->context, mesh, how, settings->turntable, &image)
                                       : mt_preview_reported(job->context, mesh, how, &image, &report);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = cli_write_image(job, image, job->common->output);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, read, image, 1, settings->sheet ? NULL : &report);
    } else if (code == CLI_EXIT_DONE && how->scale_bar && !settings->sheet) {
        cli_say(job, "the scale bar is %s long", cli_real(report.scale_bar_length).text);
    }
    mt_image_destroy(job->context, image);
    return code;
}

static cli_exit draw(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read, const mt_preview_options *how)
{
    const preview_settings *settings = job->settings;
    bool many = settings->turntable > 0 && !settings->sheet;
    return many ? draw_turns(job, mesh, read, how, settings->turntable) : draw_one(job, mesh, read, how);
}

/* With the colours of all defects that the check finds. */
static cli_exit draw_defects(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read,
                             mt_preview_options how)
{
    const mt_manifold_options all = {.defects_per_kind = UINT64_MAX};
    mt_manifold_report report;
    cli_defect_paint paint;
    cli_check check = {.file = job->operands[0], .format = read, .mesh = mesh, .report = &report};
    if (mt_check_manifold(job->context, mesh, &all, &report) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code;
    if (cli_defect_paint_init(job->context, &check, true, &paint) != MT_OK) {
        code = cli_report_failure(job, job->operands[0]);
    } else {
        cli_defect_paint_apply(&paint, &how);
        code = draw(job, &paint.shown, read, &how);
        if (code == CLI_EXIT_DONE) {
            cli_defect_legend(job, &check, job->common->output);
        }
        cli_defect_paint_release(job->context, &paint);
    }
    mt_manifold_report_release(job->context, &report);
    return code;
}

/* Each strip in a colour of its own. */
static cli_exit draw_strips(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read, mt_preview_options how)
{
    unsigned char *colors = NULL;
    if (cli_strip_colors(job->context, mesh, &colors) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    how.face_colors = colors;
    cli_exit code = draw(job, mesh, read, &how);
    mt_free(job->context, colors);
    return code;
}

cli_exit preview_draw(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read)
{
    const preview_settings *settings = job->settings;
    mt_preview_options how = options_of(settings);
    if (settings->coloring.strips) {
        return draw_strips(job, mesh, read, how);
    }
    return settings->coloring.defects ? draw_defects(job, mesh, read, how) : draw(job, mesh, read, &how);
}
