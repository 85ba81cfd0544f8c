/* meshtool distance: how far two meshes lie apart, or points from a mesh. */
#include "distance.h"
#include "files.h"
#include "message.h"
#include "profile.h"
#include "progress.h"
#include "quantity.h"

#include <meshtool/signed_distance.h>

static const cli_option options[] = {
    {.name = "points",
     .offset = offsetof(cli_distance_settings, points),
     .parse = cli_parse_text,
     .argument = "FILE",
     .expects = "a file",
     .help = "instead of B: for each vertex of FILE its distance to A, the nearest point and its face, a line each"},
    {.name = "signed",
     .offset = offsetof(cli_distance_settings, is_signed),
     .help = "distances of A's vertices (of the points) with a sign: below 0 inside of B (of A), which must be closed"},
    {.name = "tolerance",
     .offset = offsetof(cli_distance_settings, tolerance),
     .parse = cli_parse_number,
     .argument = "DISTANCE",
     .expects = "a distance above 0, in the meshes' units",
     .minimum = 0x1p-1074,
     .maximum = 0x1p1023,
     .help = "how exact the largest distance is to be (default: 1/10000 of the diagonal)"},
    {.name = "spacing",
     .offset = offsetof(cli_distance_settings, spacing),
     .parse = cli_parse_number,
     .argument = "DISTANCE",
     .expects = "a distance above 0, in the meshes' units",
     .minimum = 0x1p-1074,
     .maximum = 0x1p1023,
     .help = "of the samples for mean, rms and normals (default: 1/100 of the diagonal)"},
    {.name = "paint",
     .offset = offsetof(cli_distance_settings, paint),
     .parse = cli_parse_text,
     .argument = "OUT",
     .expects = "a file",
     .help = "write A with its distances as colours of its vertices (ply), or a picture of it (png)"},
    {0},
};

/* Signed distances of A's vertices to B. */
typedef struct signed_range {
    double *distances;
    double deepest, farthest; /* the least and the largest; NAN: there is none */
    mt_index inside_count;
} signed_range;

#define SIGN_BLOCK_SIZE 1024

typedef struct sign_search {
    const mt_mesh *points;
    const mt_signed_distance *surface;
    double *distances;
} sign_search;

static void search_signs(void *user, uint64_t begin, uint64_t end)
{
    const sign_search *search = user;
    for (uint64_t i = begin; i < end; i++) {
        search->distances[i] =
            mt_signed_distance_at(search->surface, mt_mesh_position(search->points, (mt_index)i), NULL);
    }
}

static void find_range(const double *distances, mt_index count, signed_range *out)
{
    out->deepest = out->farthest = NAN;
    for (mt_index i = 0; i < count; i++) {
        out->deepest = fmin(out->deepest, distances[i]);
        out->farthest = fmax(out->farthest, distances[i]);
        out->inside_count += distances[i] < 0;
    }
}

static mt_status measure_signs(mt_context *context, const mt_mesh *a, const mt_mesh *b, signed_range *out)
{
    mt_signed_distance *surface = NULL;
    int part = mt_part_begin(context, "signs", "asked for");
    mt_status status = mt_signed_distance_create(context, b, &surface);
    out->distances = status == MT_OK ? mt_allocate_array(context, a->vertex_count, sizeof(double)) : NULL;
    if (out->distances) {
        sign_search search = {a, surface, out->distances};
        mt_parallel_for(context, a->vertex_count, SIGN_BLOCK_SIZE, search_signs, &search);
        find_range(out->distances, a->vertex_count, out);
    }
    mt_signed_distance_destroy(context, surface);
    mt_part_end(context, part);
    return status != MT_OK || out->distances ? status : MT_ERROR_OUT_OF_MEMORY;
}

static json_t *point_json(mt_vec3 p)
{
    json_t *array = cli_json_array();
    cli_json_append(array, cli_json_real(p.x));
    cli_json_append(array, cli_json_real(p.y));
    cli_json_append(array, cli_json_real(p.z));
    return array;
}

static json_t *side_json(const mt_deviation_side *side)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "max", cli_json_real(side->max));
    cli_json_set(object, "mean", cli_json_real(side->mean));
    cli_json_set(object, "rms", cli_json_real(side->rms));
    cli_json_set(object, "max_error", cli_json_real(side->max_error));
    cli_json_set(object, "from", point_json(side->from));
    cli_json_set(object, "to", point_json(side->to));
    cli_json_set(object, "normal_mean", cli_json_real(side->normal_mean));
    cli_json_set(object, "normal_max", cli_json_real(side->normal_max));
    cli_json_set(object, "samples", cli_json_integer(side->sample_count));
    return object;
}

static void print_json(const mt_deviation *d, const signed_range *range)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "a_to_b", side_json(&d->a_to_b));
    cli_json_set(object, "b_to_a", side_json(&d->b_to_a));
    cli_json_set(object, "hausdorff", cli_json_real(d->hausdorff));
    cli_json_set(object, "hausdorff_error", cli_json_real(d->hausdorff_error));
    cli_json_set(object, "diagonal", cli_json_real(d->diagonal));
    if (range->distances) {
        json_t *inner = cli_json_object();
        cli_json_set(inner, "min", cli_json_real(range->deepest));
        cli_json_set(inner, "max", cli_json_real(range->farthest));
        cli_json_set(inner, "inside", cli_json_integer(range->inside_count));
        cli_json_set(object, "signed", inner);
    }
    cli_json_print_line(object);
    json_decref(object);
}

static void print_side(const char *from, const char *to, const mt_deviation_side *side)
{
    printf("%s to %s\n", from, to);
    printf("  largest  %s at %s, nearest %s\n", cli_real(side->max).text, cli_point(side->from).text,
           cli_point(side->to).text);
    printf("  mean     %s, rms %s\n", cli_real(side->mean).text, cli_real(side->rms).text);
    if (!isnan(side->normal_mean)) {
        printf("  normals  %s degrees apart on average, %s at most\n", cli_real(side->normal_mean).text,
               cli_real(side->normal_max).text);
    }
}

static void print_text(const cli_job *job, const mt_mesh *a, const mt_deviation *d, const signed_range *range)
{
    const char *first = job->operands[0], *second = job->operands[1];
    double share = d->diagonal > 0 ? 100 * d->hausdorff / d->diagonal : 0;
    printf("Hausdorff distance %s, exact to %s; %s %% of the diagonal, %s\n", cli_real(d->hausdorff).text,
           cli_real(d->hausdorff_error).text, cli_real(share).text, cli_real(d->diagonal).text);
    print_side(first, second, &d->a_to_b);
    print_side(second, first, &d->b_to_a);
    if (range->distances) {
        printf("Vertices of %s: %s of %s inside of %s, from %s to %s\n", first, cli_count(range->inside_count).text,
               cli_count(a->vertex_count).text, second, cli_real(range->deepest).text, cli_real(range->farthest).text);
    }
}

static cli_exit tell(const cli_job *job, const mt_mesh *a, const mt_deviation *d, const signed_range *range)
{
    const cli_distance_settings *settings = job->settings;
    cli_exit code = CLI_EXIT_DONE;
    if (settings->paint) {
        double largest = range->distances ? fmax(fabs(range->deepest), fabs(range->farthest)) : d->a_to_b.max;
        const double *distances = range->distances ? range->distances : d->a_to_b.vertex_distances;
        code = cli_distance_paint(job, a, distances, largest, settings->paint);
    }
    cli_progress_clear();
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(d, range);
    } else if (code == CLI_EXIT_DONE && !job->common->quiet &&
               !(settings->paint && cli_is_standard_output(settings->paint))) {
        print_text(job, a, d, range);
    }
    return code;
}

static cli_exit compare(const cli_job *job, const mt_mesh *a, const mt_mesh *b)
{
    const cli_distance_settings *settings = job->settings;
    mt_deviation_options how = {.tolerance = settings->tolerance,
                                .relative_tolerance = cli_profile_of(job->common)->tolerance,
                                .spacing = settings->spacing,
                                .keep_distances = settings->paint != NULL};
    mt_deviation deviation = {0};
    signed_range range = {0};
    cli_exit code = CLI_EXIT_DONE;
    if (!settings->is_signed) {
        mt_part_skip(job->context, "signs", "--signed asks for them");
    }
    if (settings->is_signed && measure_signs(job->context, a, b, &range) != MT_OK) {
        code = cli_report_failure(job, job->operands[1]);
    } else if (mt_measure_deviation(job->context, a, b, &how, &deviation) != MT_OK) {
        code = cli_report_failure(job, NULL);
    } else {
        code = tell(job, a, &deviation, &range);
    }
    mt_deviation_release(job->context, &deviation);
    mt_free(job->context, range.distances);
    return code;
}

static cli_exit check_usage(const cli_job *job)
{
    const cli_distance_settings *settings = job->settings;
    if (job->operand_count == 1 && !settings->points) {
        return cli_wrong_usage(job->command, "one mesh alone has no distance; give a second, or --points FILE");
    }
    if (job->operand_count == 2 && settings->points) {
        return cli_wrong_usage(job->command, "--points takes the place of the second mesh; leave one of them out");
    }
    if (settings->points && settings->paint) {
        return cli_wrong_usage(job->command, "--paint colours the first of two meshes, and --points has no second");
    }
    cli_exit code = cli_check_inputs(job);
    return code == CLI_EXIT_DONE && settings->paint ? cli_distance_check_paint(job, settings->paint) : code;
}

static cli_exit run(const cli_job *job)
{
    const cli_distance_settings *settings = job->settings;
    const mt_mesh_format *format = NULL;
    mt_mesh *a = NULL, *b = NULL;
    cli_exit code = check_usage(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &a, &format);
    }
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, settings->points ? settings->points : job->operands[1], &b, &format);
    }
    if (code == CLI_EXIT_DONE) {
        code = settings->points ? cli_distance_points(job, a, b) : compare(job, a, b);
    }
    mt_mesh_destroy(job->context, a);
    mt_mesh_destroy(job->context, b);
    return code;
}

const cli_command cli_distance_command = {
    .name = "distance",
    .usage = "A B [--signed] [--paint OUT]",
    .summary = "Say how far two meshes lie apart: Hausdorff, mean, RMS, normals",
    .description =
        "Distances from the surface of A to that of B, and back. The largest is searched for until it is exact to the "
        "tolerance, over all points of the surfaces and not vertices alone; mean, root mean square and normals are "
        "taken "
        "over the area. A mesh without faces stands for its wires, points or vertices.",
    .examples = "  meshtool distance scan.ply model.obj\n"
                "  meshtool distance simplified.obj original.obj --paint error.png\n"
                "  meshtool distance part.stl --points probes.ply --signed\n",
    .options = options,
    .groups =
        CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(cli_distance_settings),
    .operand_minimum = 1,
    .operand_maximum = 2,
    .run = run,
};
