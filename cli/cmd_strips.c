/* meshtool strips: the triangles of a mesh as strips and fans. */
#include "files.h"
#include "message.h"
#include "paint.h"
#include "profile.h"
#include "quantity.h"
#include "strip_paint.h"

#include <meshtool/order.h>
#include <meshtool/strip_format.h>

typedef struct strips_settings {
    cli_common common;
    unsigned kind;     /* mt_strip_kind */
    unsigned join;     /* mt_strip_join */
    unsigned optimize; /* OPTIMIZE_NOTHING, or 1 + the place among the choices */
    bool thorough;
    const char *paint;
} strips_settings;

enum { OPTIMIZE_NOTHING, OPTIMIZE_CACHE, OPTIMIZE_FETCH };

/* In the order of the library's enumerations. */
static const char *const kinds[] = {"strip", "fan", "mixed", NULL};
static const char *const joins[] = {"restart", "degenerate", "none", NULL};

static const char *const orders[] = {"cache", "fetch", NULL};

static bool parse_order(const cli_option *option, const char *text, void *value)
{
    bool found = cli_parse_choice(option, text, value);
    *(unsigned *)value += found;
    return found;
}

#define SETTING(member) offsetof(strips_settings, member)

static const cli_option options[] = {
    {.name = "kind",
     .offset = SETTING(kind),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "strip, fan or mixed",
     .choices = kinds,
     .help = "strip, fan, or mixed: strips, and fans where they are shorter; strip"},
    {.name = "join",
     .offset = SETTING(join),
     .parse = cli_parse_choice,
     .argument = "HOW",
     .expects = "restart, degenerate or none",
     .choices = joins,
     .help = "restart: a restart index between strips, in text the end of a line; degenerate: all strips in one, by "
             "triangles without area; none: every strip by itself; restart"},
    {.name = "thorough",
     .offset = SETTING(thorough),
     .help = "search long for fewer indices; the result is the same on every machine"},
    {.name = "optimize",
     .offset = SETTING(optimize),
     .parse = parse_order,
     .argument = "WHAT",
     .expects = "cache or fetch",
     .choices = orders,
     .help = "first order the faces for the vertex cache (cache), or the vertices as faces use them (fetch; not for "
             "text, which has none)"},
    {.name = "paint",
     .offset = SETTING(paint),
     .parse = cli_parse_text,
     .argument = "OUT",
     .expects = "a file's name",
     .help = "also write the mesh (ply) or a picture (png) with each strip in its own colour"},
    {0},
};

/* --to is about -o alone. */
static cli_job paint_job(const cli_job *job, cli_common *common)
{
    cli_job paint = *job;
    *common = *job->common;
    common->to = NULL;
    paint.common = common;
    return paint;
}

static cli_exit check_usage(const cli_job *job)
{
    const strips_settings *settings = job->settings;
    const cli_common *common = job->common;
    if (settings->kind != MT_STRIP_KIND_STRIP && settings->join == MT_STRIP_JOIN_DEGENERATE) {
        return cli_wrong_usage(job->command, "fans cannot be joined by degenerate triangles; give --kind strip, or "
                                             "--join restart");
    }
    cli_exit code = cli_check_output(job, common->output);
    mt_strip_write_options how = {.format = cli_extension(common->to)};
    const mt_strip_format *format = NULL;
    if (code == CLI_EXIT_DONE) {
        format = mt_strip_format_for_output(job->context, common->output, &how);
        code = format ? CLI_EXIT_DONE : cli_report_failure(job, common->output);
    }
    if (code == CLI_EXIT_DONE && settings->optimize == OPTIMIZE_FETCH && !format->holds_vertices) {
        return cli_wrong_usage(job->command,
                               "--optimize fetch numbers the vertices anew, and %s has no vertices to go "
                               "with the numbers",
                               format->name);
    }
    if (code == CLI_EXIT_DONE && settings->paint) {
        cli_common without_to;
        cli_job paint = paint_job(job, &without_to);
        code = cli_paint_check_output(&paint, settings->paint, MT_HOLDS_FACE_COLORS, "faces");
    }
    return code;
}

typedef struct strips_report {
    const mt_strips *strips;
    uint64_t index_count;
    double indices_per_triangle, single_share;
    mt_cache_use small, large; /* of 16 and 32 vertices */
} strips_report;

static mt_status measure(mt_context *context, const mt_strips *strips, strips_report *report)
{
    *report = (strips_report){.strips = strips, .index_count = mt_strips_index_count(strips)};
    if (strips->triangle_count) {
        report->indices_per_triangle = (double)report->index_count / strips->triangle_count;
        report->single_share = (double)strips->single_count / strips->triangle_count;
    }
    mt_status status = mt_strips_cache_use(context, strips, 16, &report->small);
    return status == MT_OK ? mt_strips_cache_use(context, strips, 32, &report->large) : status;
}

static json_t *cache_json(double small, double large)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "fifo16", cli_json_real(small));
    cli_json_set(object, "fifo32", cli_json_real(large));
    return object;
}

static void print_json(const cli_job *job, const strips_report *report)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "triangles", cli_json_integer(report->strips->triangle_count));
    cli_json_set(object, "strips", cli_json_integer(report->strips->strip_count));
    cli_json_set(object, "fans", cli_json_integer(report->strips->strip_count - report->strips->fan_begin));
    cli_json_set(object, "indices", cli_json_integer((int64_t)report->index_count));
    cli_json_set(object, "indices_per_triangle", cli_json_real(report->indices_per_triangle));
    cli_json_set(object, "single_triangles", cli_json_real(report->single_share));
    cli_json_set(object, "acmr", cache_json(report->small.acmr, report->large.acmr));
    cli_json_set(object, "atvr", cache_json(report->small.atvr, report->large.atvr));
    cli_json_print_line(object);
    json_decref(object);
}

static void print_text(const cli_job *job, const strips_report *report)
{
    static const char *const joined[] = {", restarts counted", ", joins counted", ""};
    const mt_strips *strips = report->strips;
    mt_index fan_count = strips->strip_count - strips->fan_begin;
    printf("%s: %s in ", job->operands[0], cli_counted(strips->triangle_count, "triangle").text);
    if (strips->fan_begin || !fan_count) {
        printf("%s%s", cli_counted(strips->fan_begin, "strip").text, fan_count ? " and " : "");
    }
    if (fan_count) {
        printf("%s", cli_counted(fan_count, "fan").text);
    }
    printf("\n  indices        %s, %.4f a triangle%s\n", cli_count((int64_t)report->index_count).text,
           report->indices_per_triangle, joined[strips->join]);
    printf("  left alone     %s\n", cli_counted(strips->single_count, "triangle").text);
    printf("  vertex cache   %.3f misses a triangle with 16 entries, %.3f with 32 (%.3f and %.3f a vertex)\n",
           report->small.acmr, report->large.acmr, report->small.atvr, report->large.atvr);
}

static cli_exit write_and_tell(const cli_job *job, const mt_mesh *mesh, const mt_strips *strips)
{
    const strips_settings *settings = job->settings;
    const cli_common *common = job->common;
    mt_strip_write_options how = {.format = cli_extension(common->to), .no_clobber = common->no_clobber};
    strips_report report;
    int part = mt_part_begin(job->context, "vertex cache", "how well the strips use it");
    mt_status status = measure(job->context, strips, &report);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    part = mt_part_begin(job->context, "output", "asked for");
    status = mt_strips_write_file(job->context, mesh, strips, common->output, &how);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, common->output);
    }
    cli_exit code = CLI_EXIT_DONE;
    if (settings->paint) {
        cli_common without_to;
        cli_job paint = paint_job(job, &without_to);
        code = cli_strip_paint(&paint, mesh, strips, settings->paint);
    }
    bool text_fits = !common->quiet && !cli_is_standard_output(common->output) &&
                     !(settings->paint && cli_is_standard_output(settings->paint));
    if (code == CLI_EXIT_DONE && common->json) {
        print_json(job, &report);
    } else if (code == CLI_EXIT_DONE && text_fits) {
        print_text(job, &report);
    }
    return code;
}

static cli_exit optimize(const cli_job *job, mt_mesh **mesh)
{
    const strips_settings *settings = job->settings;
    mt_mesh *ordered = NULL;
    int part = mt_part_begin(job->context, "order", "asked for");
    mt_status status = settings->optimize == OPTIMIZE_CACHE ? mt_mesh_order_faces(job->context, *mesh, &ordered)
                                                            : mt_mesh_order_vertices(job->context, *mesh, &ordered);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    mt_mesh_destroy(job->context, *mesh);
    *mesh = ordered;
    return CLI_EXIT_DONE;
}

static cli_exit run(const cli_job *job)
{
    const strips_settings *settings = job->settings;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE) {
        code = check_usage(job);
    }
    const mt_mesh_format *read = NULL;
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE && settings->optimize) {
        code = optimize(job, &mesh);
    }
    mt_strips *strips = NULL;
    if (code == CLI_EXIT_DONE) {
        mt_strip_options how = {(mt_strip_kind)settings->kind, (mt_strip_join)settings->join,
                                settings->thorough || cli_profile_of(job->common)->is_thorough};
        int part = mt_part_begin(job->context, "strips", "asked for");
        mt_status status = mt_strips_create(job->context, mesh, &how, &strips);
        mt_part_end(job->context, part);
        code = status == MT_OK ? write_and_tell(job, mesh, strips) : cli_report_failure(job, job->operands[0]);
    }
    mt_strips_destroy(job->context, strips);
    mt_mesh_destroy(job->context, mesh);
    return code;
}

const cli_command cli_strips_command = {
    .name = "strips",
    .usage = "IN -o OUT",
    .summary = "Write the triangles of a mesh as strips and fans",
    .description =
        "Every triangle once, with its orientation, whatever the mesh. Text has one strip a line, vertices by their "
        "numbers from 0, and \"f\" before a fan. Indices a triangle count what joins the strips; separate triangles "
        "take 3.",
    .examples = "  meshtool strips bunny.obj -o bunny.txt\n"
                "  meshtool strips bunny.obj -o - --thorough --join degenerate\n"
                "  meshtool strips bunny.obj -o bunny.txt --paint strips.png --json\n",
    .options = options,
    .groups =
        CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(strips_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
