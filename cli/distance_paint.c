/* distance --paint: the mesh with its distances as colours, as a file or a picture. */
#include "distance.h"
#include "files.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"

#include <meshtool/preview.h>

#include <string.h>

#define RAMP_SIZE 5

/* Equal steps of lightness, told apart by eyes that see fewer colours too. */
static const unsigned char plain_ramp[RAMP_SIZE][3] = {
    {68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
static const unsigned char signed_ramp[RAMP_SIZE][3] = {
    {33, 60, 180}, {140, 170, 225}, {245, 245, 245}, {235, 150, 120}, {180, 20, 40}};
static const unsigned char unknown[3] = {128, 128, 128};

static void color_of(double distance, double largest, bool is_signed, unsigned char rgb[3])
{
    if (!isfinite(distance)) {
        memcpy(rgb, unknown, 3);
        return;
    }
    double share = largest > 0 ? distance / largest : 0;
    double place = (is_signed ? 0.5 + 0.5 * share : share) * (RAMP_SIZE - 1);
    place = fmin(fmax(place, 0), RAMP_SIZE - 1);
    int step = place < RAMP_SIZE - 1 ? (int)place : RAMP_SIZE - 2;
    const unsigned char *low = is_signed ? signed_ramp[step] : plain_ramp[step];
    const unsigned char *high = is_signed ? signed_ramp[step + 1] : plain_ramp[step + 1];
    for (int i = 0; i < 3; i++) {
        rgb[i] = (unsigned char)(low[i] + (place - step) * (high[i] - low[i]) + 0.5);
    }
}

static bool is_picture(const cli_job *job, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *extension = job->common->to ? cli_extension(job->common->to) : dot ? dot + 1 : "";
    return mt_image_format_by_extension(extension) != NULL;
}

cli_exit cli_distance_check_paint(const cli_job *job, const char *path)
{
    if (is_picture(job, path)) {
        const mt_image_format *picture = NULL;
        return cli_check_image_output(job, path, &picture);
    }
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_check_mesh_output(job, path, &format);
    if (code == CLI_EXIT_DONE && !(format->abilities & MT_HOLDS_VERTEX_COLORS)) {
        return cli_wrong_usage(job->command, "--paint: %s files hold no colours of vertices; write a ply or a png",
                               format->name);
    }
    return code;
}

static mt_status paint_copy(mt_context *context, mt_mesh *copy, const double *distances, double largest, bool is_signed)
{
    for (mt_index i = copy->attribute_count; i-- > 0;) {
        if (copy->attributes[i].semantic == MT_SEMANTIC_COLOR) {
            mt_mesh_remove_attribute(context, copy, i);
        }
    }
    mt_attribute_layout layout = {.name = "color",
                                  .semantic = MT_SEMANTIC_COLOR,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = MT_U8,
                                  .component_count = 3,
                                  .value_count = copy->vertex_count};
    mt_attribute *attribute = NULL;
    mt_status status = mt_mesh_add_attribute(context, copy, &layout, &attribute);
    for (mt_index i = 0; status == MT_OK && i < copy->vertex_count; i++) {
        color_of(distances[i], largest, is_signed, (unsigned char *)attribute->values + 3 * (size_t)i);
    }
    return status;
}

static cli_exit write_picture(const cli_job *job, const mt_mesh *mesh, const char *path)
{
    mt_image *image = NULL;
    if (mt_preview(job->context, mesh, NULL, &image) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = cli_write_image(job, image, path);
    mt_image_destroy(job->context, image);
    return code;
}

static void say_legend(const cli_job *job, double largest, bool is_signed, const char *path)
{
    if (job->common->quiet) {
        return;
    }
    cli_progress_clear();
    fprintf(stderr,
            is_signed ? "meshtool: %s: blue %s inside, white 0, red %s outside\n"
                      : "meshtool: %s: violet 0, green %s, yellow %s\n",
            path, cli_real(is_signed ? largest : largest / 2).text, cli_real(largest).text);
}

cli_exit cli_distance_paint(const cli_job *job, const mt_mesh *mesh, const double *distances, double largest,
                            const char *path)
{
    const cli_distance_settings *settings = job->settings;
    mt_mesh *copy = NULL;
    mt_status status = mt_mesh_copy(job->context, mesh, &copy);
    if (status == MT_OK) {
        status = paint_copy(job->context, copy, distances, largest, settings->is_signed);
    }
    cli_exit code = CLI_EXIT_DONE;
    if (status != MT_OK) {
        code = cli_report_failure(job, job->operands[0]);
    } else {
        code = is_picture(job, path) ? write_picture(job, copy, path) : cli_write_mesh(job, copy, path, NULL);
    }
    if (code == CLI_EXIT_DONE) {
        say_legend(job, largest, settings->is_signed, path);
    }
    mt_mesh_destroy(job->context, copy);
    return code;
}
