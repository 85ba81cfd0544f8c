/* distance --paint: the mesh with its distances as colours, as a file or a picture. */
#include "distance.h"
#include "files.h"
#include "message.h"
#include "paint.h"
#include "progress.h"
#include "quantity.h"

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

cli_exit cli_distance_check_paint(const cli_job *job, const char *path)
{
    return cli_paint_check_output(job, path, MT_HOLDS_VERTEX_COLORS, "vertices");
}

static mt_status paint_copy(mt_context *context, mt_mesh *copy, const double *distances, double largest, bool is_signed)
{
    unsigned char *colors = NULL;
    cli_paint_clear(context, copy);
    mt_status status = cli_paint_add(context, copy, MT_DOMAIN_VERTEX, &colors);
    for (mt_index i = 0; status == MT_OK && i < copy->vertex_count; i++) {
        color_of(distances[i], largest, is_signed, colors + 3 * (size_t)i);
    }
    return status;
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
    cli_exit code = status == MT_OK ? cli_paint_write(job, copy, path) : cli_report_failure(job, job->operands[0]);
    if (code == CLI_EXIT_DONE) {
        say_legend(job, largest, settings->is_signed, path);
    }
    mt_mesh_destroy(job->context, copy);
    return code;
}
