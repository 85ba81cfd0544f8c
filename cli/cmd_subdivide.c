/* meshtool subdivide: Catmull-Clark refinement. */
#include "files.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"

#include <meshtool/subdivide.h>

typedef struct subdivide_settings {
    cli_common common;
    unsigned levels;
    bool dry_run;
} subdivide_settings;

static const cli_option options[] = {
    {.name = "levels",
     .letter = 'n',
     .offset = offsetof(subdivide_settings, levels),
     .parse = cli_parse_count,
     .argument = "LEVELS",
     .expects = "a whole number from 0 to 31",
     .maximum = MT_SUBDIVIDE_LEVEL_LIMIT,
     .help = "how often to refine, each level making four times the faces; 1"},
    {.name = "dry-run",
     .offset = offsetof(subdivide_settings, dry_run),
     .help = "only say the counts and bytes of each level; needs no -o"},
    {0},
};

static json_t *counts_json(unsigned level, const mt_subdivide_counts *counts)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "level", cli_json_integer(level));
    cli_json_set(object, "vertices", cli_json_integer((int64_t)counts->vertex_count));
    cli_json_set(object, "edges", cli_json_integer((int64_t)counts->edge_count));
    cli_json_set(object, "faces", cli_json_integer((int64_t)counts->face_count));
    cli_json_set(object, "corners", cli_json_integer((int64_t)counts->corner_count));
    cli_json_set(object, "bytes", cli_json_integer((int64_t)counts->bytes));
    return object;
}

static void print_counts(unsigned level, const mt_subdivide_counts *counts)
{
    if (level == 0) {
        printf("level %15s %15s %15s %12s\n", "vertices", "edges", "faces", "memory");
    }
    printf("%5u %15s %15s %15s %12s\n", level, cli_count((int64_t)counts->vertex_count).text,
           cli_count((int64_t)counts->edge_count).text, cli_count((int64_t)counts->face_count).text,
           cli_bytes(counts->bytes).text);
}

/* One level after the other, up to one that a mesh cannot hold. */
static cli_exit list_levels(const cli_job *job, const mt_mesh *mesh, const mt_edge_pairs *pairs, json_t *levels)
{
    const subdivide_settings *settings = job->settings;
    for (unsigned level = 0; level <= settings->levels; level++) {
        mt_subdivide_counts counts;
        if (mt_subdivide_count(job->context, mesh, pairs, level, &counts) != MT_OK) {
            return cli_report_failure(job, job->operands[0]);
        }
        if (job->common->json) {
            cli_json_append(levels, counts_json(level, &counts));
        } else {
            print_counts(level, &counts);
        }
    }
    return CLI_EXIT_DONE;
}

static cli_exit print_levels(const cli_job *job, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    json_t *levels = cli_json_array(), *object = cli_json_object();
    cli_exit code = list_levels(job, mesh, pairs, levels);
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "levels", levels);
    if (job->common->json && code == CLI_EXIT_DONE) {
        cli_json_print_line(object);
    }
    json_decref(object);
    return code;
}

/* What the real run would refuse, the dry one refuses too, in the same words: one level is tried. */
static cli_exit check_refusals(const cli_job *job, const mt_mesh *mesh)
{
    mt_mesh *refined = NULL;
    mt_status status = mt_subdivide(job->context, mesh, NULL, &refined);
    mt_mesh_destroy(job->context, refined);
    if (status == MT_ERROR_NOT_MANIFOLD || status == MT_ERROR_NOT_ORIENTED || status == MT_ERROR_CANCELLED) {
        return cli_report_failure(job, job->operands[0]);
    }
    mt_context_clear_error(job->context);
    return CLI_EXIT_DONE;
}

static cli_exit dry_run(const cli_job *job, const mt_mesh *mesh)
{
    const subdivide_settings *settings = job->settings;
    cli_exit code = settings->levels ? check_refusals(job, mesh) : CLI_EXIT_DONE;
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    mt_edge_pairs *pairs = NULL;
    if (mt_edge_pairs_create(job->context, mesh, &pairs) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_progress_clear();
    code = print_levels(job, mesh, pairs);
    mt_edge_pairs_destroy(job->context, pairs);
    return code;
}

static void print_json(const cli_job *job, const mt_mesh_format *read, const mt_mesh *mesh, json_t *lost)
{
    const subdivide_settings *settings = job->settings;
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(read->name));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "levels", cli_json_integer(settings->levels));
    cli_json_set(object, "vertices", cli_json_integer(mesh->vertex_count));
    cli_json_set(object, "faces", cli_json_integer(mesh->face_count));
    cli_json_set(object, "lost", lost);
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit refine(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read)
{
    unsigned levels = ((const subdivide_settings *)job->settings)->levels;
    mt_subdivide_options how = {.level_count = levels, .no_levels = levels == 0};
    mt_mesh *refined = NULL;
    if (mt_subdivide(job->context, mesh, &how, &refined) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    json_t *lost = NULL;
    cli_exit code = cli_write_mesh(job, refined, job->common->output, &lost);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, read, refined, json_incref(lost));
    }
    json_decref(lost);
    mt_mesh_destroy(job->context, refined);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const subdivide_settings *settings = job->settings;
    const mt_mesh_format *read = NULL, *written = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE && !settings->dry_run) {
        code = cli_check_mesh_output(job, settings->common.output, &written);
    }
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = settings->dry_run ? dry_run(job, mesh) : refine(job, mesh, read);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static const subdivide_settings defaults = {.levels = 1};

const cli_command cli_subdivide_command = {
    .name = "subdivide",
    .usage = "IN -o OUT [-n LEVELS]",
    .summary = "Refine a mesh by Catmull-Clark subdivision",
    .description =
        "Takes faces of any number of sides and makes quads of them; boundaries become cubic B-splines. Colours "
        "follow the positions, texture coordinates are interpolated linearly. A mesh that is not manifold, "
        "or whose faces are not oriented alike, is refused (exit 3); check-manifold shows where.",
    .examples = "  meshtool subdivide cow.obj -o smooth.obj -n 2\n"
                "  meshtool subdivide cow.obj -n 5 --dry-run\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION |
              CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(subdivide_settings),
    .defaults = &defaults,
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
