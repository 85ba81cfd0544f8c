/* meshtool check-manifold: reads, checks, and reports in the form asked for. */
#include "check.h"
#include "message.h"
#include "progress.h"

#define LISTED_PER_KIND 100 /* by the contract, without --all-defects */

static const cli_option options[] = {
    {.name = "closed", .offset = offsetof(check_settings, closed), .help = "also demand that there is no boundary"},
    {.name = "oriented",
     .offset = offsetof(check_settings, oriented),
     .help = "also demand that neighbouring faces are oriented alike"},
    {.name = "all-defects",
     .offset = offsetof(check_settings, all_defects),
     .help = "list every defect in JSON, not the first 100 of each kind"},
    {.name = "paint",
     .offset = offsetof(check_settings, paint),
     .parse = cli_parse_text,
     .argument = "OUT",
     .expects = "a file's name",
     .help = "write the mesh (ply) or a picture (png) with the defects coloured"},
    {.name = "watertight",
     .offset = offsetof(check_settings, watertight),
     .help = "demand both, and that no two faces intersect"},
    {.name = "self-intersections",
     .offset = offsetof(check_settings, self_intersections),
     .help = "also search for pairs of faces that intersect, decided exactly"},
    {0},
};

bool cli_check_holds(const cli_check *check)
{
    return check->report->manifold_class != MT_NON_MANIFOLD && !check->fails_closed && !check->fails_oriented &&
           !check->fails_apart;
}

typedef enum check_form { CHECK_FORM_NONE, CHECK_FORM_JSON, CHECK_FORM_VERDICT, CHECK_FORM_TEXT } check_form;

static check_form form_of(const cli_job *job)
{
    const check_settings *settings = job->settings;
    if (settings->common.json) {
        return CHECK_FORM_JSON;
    }
    if (settings->common.quiet || (settings->paint && cli_is_standard_output(settings->paint))) {
        return CHECK_FORM_NONE;
    }
    return job->operand_count > 1 && !settings->common.verbose ? CHECK_FORM_VERDICT : CHECK_FORM_TEXT;
}

static void print_report(const cli_job *job, const cli_check *check)
{
    cli_progress_clear();
    switch (form_of(job)) {
    case CHECK_FORM_JSON:
        cli_check_print_json(check);
        break;
    case CHECK_FORM_VERDICT:
        cli_check_print_verdict(check);
        break;
    case CHECK_FORM_TEXT:
        cli_check_print_text(job->context, check);
        break;
    case CHECK_FORM_NONE:
        break;
    }
}

static cli_exit report_on(const cli_job *job, cli_check *check)
{
    const check_settings *settings = job->settings;
    const mt_manifold_report *report = check->report;
    bool watertight = settings->watertight;
    check->fails_closed = (watertight || settings->closed) && report->manifold_class != MT_MANIFOLD;
    check->fails_oriented = (watertight || settings->oriented) && report->oriented != MT_YES;
    check->fails_apart = watertight && report->defect_counts[MT_DEFECT_SELF_INTERSECTION] > 0;
    cli_exit code = settings->paint ? cli_check_paint(job, check, settings->paint) : CLI_EXIT_DONE;
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    print_report(job, check);
    return cli_check_holds(check) ? CLI_EXIT_DONE : CLI_EXIT_NO;
}

static cli_exit check_file(const cli_job *job, const char *file)
{
    const check_settings *settings = job->settings;
    mt_mesh *mesh = NULL;
    cli_check check = {.file = file, .listed_per_kind = settings->all_defects ? UINT64_MAX : LISTED_PER_KIND};
    cli_exit code = cli_read_mesh(job, file, &mesh, &check.format);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    check_form form = form_of(job);
    bool needs_all = settings->paint || form == CHECK_FORM_TEXT;
    mt_manifold_options how = {.defects_per_kind = needs_all ? UINT64_MAX : check.listed_per_kind,
                               .self_intersections = settings->self_intersections || settings->watertight,
                               .inside_out = true,
                               .as_welded = form == CHECK_FORM_JSON || form == CHECK_FORM_TEXT};
    mt_manifold_report report;
    if (mt_check_manifold(job->context, mesh, &how, &report) != MT_OK) {
        code = cli_report_failure(job, file);
    } else {
        check.mesh = mesh;
        check.report = &report;
        code = report_on(job, &check);
        mt_manifold_report_release(job->context, &report);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static cli_exit check_usage(const cli_job *job)
{
    const check_settings *settings = job->settings;
    cli_exit code = cli_check_inputs(job);
    if (code != CLI_EXIT_DONE || !settings->paint) {
        return code;
    }
    if (job->operand_count > 1) {
        return cli_wrong_usage(job->command, "--paint writes one file, so it takes one FILE");
    }
    return cli_check_paint_output(job, settings->paint);
}

static cli_exit run(const cli_job *job)
{
    cli_exit code = check_usage(job);
    return code == CLI_EXIT_DONE ? cli_for_each_file(job, check_file) : code;
}

const cli_command cli_check_manifold_command = {
    .name = "check-manifold",
    .usage = "FILE... [--closed] [--oriented] [--watertight] [--paint OUT]",
    .summary = "Say whether a mesh is manifold; if not, what is wrong and where",
    .description =
        "The exit code is 0 when every edge has one or two faces and every vertex one fan of them, and 1 when "
        "not. The verdict is on the mesh as indexed; STL, which has no indices, is welded where positions "
        "are equal bit for bit. Several FILEs get a line each; -v gives all of each.",
    .examples = "  meshtool check-manifold cow.obj\n"
                "  meshtool check-manifold cow.obj --closed --oriented --paint defects.png\n"
                "  meshtool check-manifold bracket.stl --watertight\n"
                "  meshtool check-manifold *.stl --json\n",
    .options = options,
    .groups =
        CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(check_settings),
    .operand_minimum = 1,
    .operand_maximum = SIZE_MAX,
    .run = run,
};
