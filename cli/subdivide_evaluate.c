/* meshtool subdivide --evaluate. */
#include "json.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"
#include "subdivision.h"

static double diagonal_of(const mt_mesh *mesh)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    return bounds.finite_count ? mt_vec3_length(mt_vec3_subtract(bounds.maximum, bounds.minimum)) : 0;
}

static json_t *distance_json(unsigned level, const mt_limit_distance *distance)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "level", cli_json_integer(level));
    cli_json_set(object, "max", cli_json_real(distance->max));
    cli_json_set(object, "rms", cli_json_real(distance->root_mean_square));
    cli_json_set(object, "vertex", distance->vertex == MT_NONE ? json_null() : cli_json_integer(distance->vertex));
    return object;
}

static void print_distance(FILE *to, unsigned level, const mt_limit_distance *distance, double diagonal)
{
    fprintf(to, "%5u %14.6g %14.6g", level, distance->max, distance->root_mean_square);
    if (diagonal > 0) {
        fprintf(to, " %14.4g %%", 100 * (distance->max / diagonal));
    }
    fputc('\n', to);
}

/* Level 0 has a limit in closed form when its faces are quads. */
static unsigned first_level(const mt_mesh *mesh)
{
    return !mesh->face_offsets && mesh->face_size == 4 ? 0 : 1;
}

cli_exit cli_subdivide_evaluate(const cli_job *job, const mt_mesh *mesh, const mt_subdivide_options *how, json_t **out)
{
    unsigned last = how->no_levels ? 0 : how->level_count, first = first_level(mesh);
    double diagonal = diagonal_of(mesh);
    FILE *to = job->common->output ? stderr : stdout;
    mt_subdivide_options at = *how;
    json_t *rows = cli_json_array();
    for (unsigned level = first < last ? first : last; level <= last; level++) {
        mt_limit_distance distance;
        at.level_count = level;
        at.no_levels = level == 0;
        if (mt_subdivide_evaluate(job->context, mesh, &at, &distance) != MT_OK) {
            json_decref(rows);
            return cli_report_failure(job, job->operands[0]);
        }
        cli_json_append(rows, distance_json(level, &distance));
        cli_progress_clear();
        if (!job->common->json && json_array_size(rows) == 1) {
            fprintf(to, "level   to the limit           RMS   of the diagonal\n");
        }
        if (!job->common->json) {
            print_distance(to, level, &distance, diagonal);
        }
    }
    *out = rows;
    return CLI_EXIT_DONE;
}
