/* meshtool subdivide --dry-run. The time is that of a few levels which are really made, until they take some
 * milliseconds, over their size. */
#include "json.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"
#include "subdivision.h"

#include <math.h>
#include <time.h>

#define PROBE_CORNERS 2000000 /* enough to take some milliseconds, and little beside what is worth asking about */

typedef struct level_plan {
    const cli_job *job;
    const mt_mesh *mesh;
    const mt_edge_pairs *pairs;
    const mt_subdivide_options *how;
    double seconds_per_corner; /* NaN: not known */
} level_plan;

static json_t *counts_json(const level_plan *plan, unsigned level, const mt_subdivide_counts *counts)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "level", cli_json_integer(level));
    cli_json_set(object, "vertices", cli_json_integer((int64_t)counts->vertex_count));
    cli_json_set(object, "edges", cli_json_integer((int64_t)counts->edge_count));
    cli_json_set(object, "faces", cli_json_integer((int64_t)counts->face_count));
    cli_json_set(object, "corners", cli_json_integer((int64_t)counts->corner_count));
    cli_json_set(object, "bytes", cli_json_integer((int64_t)counts->bytes));
    double seconds = level ? plan->seconds_per_corner * (double)counts->corner_count : 0;
    cli_json_set(object, "seconds", cli_json_real(seconds));
    return object;
}

static void print_time(double seconds)
{
    if (isnan(seconds)) {
        printf(" %10s\n", "?");
    } else if (seconds < 1) {
        printf(seconds < 0.01 ? " %7.1f ms\n" : " %7.0f ms\n", seconds * 1e3);
    } else {
        printf(" %8.3g s\n", seconds);
    }
}

static void print_counts(const level_plan *plan, unsigned level, const mt_subdivide_counts *counts)
{
    if (level == 0) {
        printf("level %15s %15s %15s %12s %10s\n", "vertices", "edges", "faces", "memory", "time");
    }
    printf("%5u %15s %15s %15s %12s", level, cli_count((int64_t)counts->vertex_count).text,
           cli_count((int64_t)counts->edge_count).text, cli_count((int64_t)counts->face_count).text,
           cli_bytes(counts->bytes).text);
    if (level == 0) {
        putchar('\n');
    } else {
        print_time(plan->seconds_per_corner * (double)counts->corner_count);
    }
}

/* One level after the other, up to one that a mesh cannot hold. */
static cli_exit list_levels(const level_plan *plan, unsigned last, json_t *levels)
{
    for (unsigned level = 0; level <= last; level++) {
        mt_subdivide_counts counts;
        if (mt_subdivide_count(plan->job->context, plan->mesh, plan->pairs, plan->how, level, &counts) != MT_OK) {
            return cli_report_failure(plan->job, plan->job->operands[0]);
        }
        if (plan->job->common->json) {
            cli_json_append(levels, counts_json(plan, level, &counts));
        } else {
            print_counts(plan, level, &counts);
        }
    }
    return CLI_EXIT_DONE;
}

static cli_exit print_levels(const level_plan *plan, unsigned last)
{
    json_t *levels = cli_json_array(), *object = cli_json_object();
    cli_exit code = list_levels(plan, last, levels);
    cli_json_set(object, "file", cli_json_text(plan->job->operands[0]));
    cli_json_set(object, "levels", levels);
    if (plan->job->common->json && code == CLI_EXIT_DONE) {
        cli_json_print_line(object);
    }
    json_decref(object);
    return code;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The fewest levels that are large enough to be measured. */
static unsigned probe_levels(const mt_mesh *mesh, unsigned last)
{
    uint64_t corners = 4 * (uint64_t)mesh->corner_count;
    unsigned levels = 1;
    while (levels < last && corners > 0 && corners < PROBE_CORNERS) {
        corners *= 4;
        levels++;
    }
    return levels;
}

/* What the real run would refuse, the dry one refuses too, in the same words, since it makes a few levels. */
static cli_exit probe(level_plan *plan, unsigned last)
{
    mt_subdivide_options how = *plan->how;
    mt_mesh *refined = NULL;
    how.level_count = probe_levels(plan->mesh, last);
    plan->seconds_per_corner = NAN;
    double begin = now();
    mt_status status = mt_subdivide(plan->job->context, plan->mesh, &how, &refined);
    if (refined && refined->corner_count) {
        plan->seconds_per_corner = (now() - begin) / (double)refined->corner_count;
    }
    mt_mesh_destroy(plan->job->context, refined);
    if (status != MT_OK && status != MT_ERROR_OUT_OF_MEMORY && status != MT_ERROR_TOO_LARGE) {
        return cli_report_failure(plan->job, plan->job->operands[0]);
    }
    mt_context_clear_error(plan->job->context);
    return CLI_EXIT_DONE;
}

cli_exit cli_subdivide_foretell(const cli_job *job, const mt_mesh *mesh, const mt_subdivide_options *how)
{
    unsigned last = ((const cli_subdivide_settings *)job->settings)->levels;
    level_plan plan = {.job = job, .mesh = mesh, .how = how};
    cli_exit code = last ? probe(&plan, last) : CLI_EXIT_DONE;
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    mt_edge_pairs *pairs = NULL;
    if (mt_edge_pairs_create(job->context, mesh, &pairs) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    plan.pairs = pairs;
    cli_progress_clear();
    code = print_levels(&plan, last);
    mt_edge_pairs_destroy(job->context, pairs);
    return code;
}
