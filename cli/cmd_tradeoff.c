/* meshtool tradeoff: speed and error side by side, on the user's own mesh and machine. */
#include "files.h"
#include "message.h"
#include "nearest.h"
#include "progress.h"
#include "tradeoff/extremes.h"
#include "tradeoff/knobs.h"

#include <math.h>
#include <string.h>

typedef struct tradeoff_settings {
    cli_common common;
    const char *knob, *plot;
    double budget;
    bool extremes;
} tradeoff_settings;

#define SETTING(member) offsetof(tradeoff_settings, member)

static const cli_option options[] = {
    {.name = "knob",
     .offset = SETTING(knob),
     .parse = cli_parse_text,
     .argument = "NAME",
     .expects = "the name of a knob",
     .help = "measure this one alone"},
    {.name = "budget",
     .offset = SETTING(budget),
     .parse = cli_parse_number,
     .argument = "SECONDS",
     .expects = "seconds, from 0 to 86400",
     .minimum = 0,
     .maximum = 86400,
     .help = "about how long all knobs take together, oracles included (default 20; twice that on a mesh of a million "
             "faces); a level whose first run takes too much of its knob's share is left out where it can be stopped; "
             "0: every level once, whatever it takes"},
    {.name = "plot",
     .offset = SETTING(plot),
     .parse = cli_parse_text,
     .argument = "OUT",
     .expects = "a file ending in .svg, or in an image format's extension",
     .help = "draw time against error, a panel a knob, into an svg or a png"},
    {.name = "extremes",
     .offset = SETTING(extremes),
     .help = "instead of a mesh: sweep generated extremes over the operations, and say where each breaks and why"},
    {0},
};

static size_t knob_count(void)
{
    size_t count = 0;
    while (tradeoff_knobs[count]) {
        count++;
    }
    return count;
}

/* The knob that was asked for; NULL and wrong usage when there is none of that name. */
static const tradeoff_knob *find_knob(const cli_job *job, const char *name)
{
    const char *names[TRADEOFF_KNOB_MAXIMUM];
    size_t count = knob_count();
    for (size_t i = 0; i < count; i++) {
        names[i] = tradeoff_knobs[i]->name;
        if (strcmp(name, names[i]) == 0) {
            return tradeoff_knobs[i];
        }
    }
    const char *nearest = cli_nearest(name, names, count);
    cli_wrong_usage(job->command, "no knob is called \"%s\"%s%s%s", name, nearest ? "; did you mean " : "",
                    nearest ? nearest : "", nearest ? "?" : "");
    return NULL;
}

/* What is left of the time is shared by the knobs that are left; where all is used up, each still has a little. */
static double share_of(double budget, double spent, size_t done)
{
    double all = (double)knob_count();
    return fmax((budget - spent) / (all - (double)done), budget / (4 * all));
}

static mt_status measure(const tradeoff_subject *subject, const tradeoff_knob *only, tradeoff_table *table)
{
    const tradeoff_settings *settings = subject->job->settings;
    mt_status status = MT_OK;
    table->reference_seconds = tradeoff_reference();
    double begin = tradeoff_now();
    for (size_t i = 0; status == MT_OK && tradeoff_knobs[i]; i++) {
        if (!only || only == tradeoff_knobs[i]) {
            double share = only ? settings->budget : share_of(settings->budget, tradeoff_now() - begin, i);
            int part = mt_part_begin(subject->job->context, tradeoff_knobs[i]->name, tradeoff_knobs[i]->question);
            status = tradeoff_measure(subject, tradeoff_knobs[i], share, table);
            mt_part_end(subject->job->context, part);
        }
    }
    return status;
}

static cli_exit tell(const cli_job *job, const tradeoff_subject *subject, const tradeoff_table *table)
{
    const tradeoff_settings *settings = job->settings;
    cli_exit code = settings->plot ? tradeoff_plot(job, subject, table, settings->plot) : CLI_EXIT_DONE;
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    cli_progress_clear();
    if (job->common->json) {
        tradeoff_print_json(subject, table);
    } else if (!job->common->quiet && !(settings->plot && cli_is_standard_output(settings->plot))) {
        tradeoff_print_text(subject, table);
    }
    for (size_t i = 0; i < table->row_count; i++) {
        const tradeoff_row *row = &table->rows[i];
        if (row->is_defect) {
            fprintf(stderr, "meshtool: a defect: %s, %s: %s; please report it with this mesh\n", row->knob->name,
                    row->level, row->says);
            code = CLI_EXIT_DEFECT;
        }
    }
    return code;
}

static tradeoff_subject subject_of(const cli_job *job, const mt_mesh *mesh)
{
    tradeoff_subject subject = {.job = job, .name = job->operands[0], .mesh = mesh};
    mt_bounds bounds = mt_mesh_bounds(mesh);
    if (bounds.finite_count > 0) {
        mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
        double scale = mt_power_of_two_scale(mt_vec3_max_abs(size));
        subject.diagonal = mt_vec3_length(mt_vec3_scale(size, scale)) / scale;
        subject.reach = fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum));
    }
    return subject;
}

static cli_exit run(const cli_job *job)
{
    const tradeoff_settings *settings = job->settings;
    if (settings->extremes) {
        return job->operand_count == 0 ? tradeoff_extremes(job)
                                       : cli_wrong_usage(job->command, "--extremes makes its own meshes; name none");
    }
    if (job->operand_count == 0) {
        return cli_wrong_usage(job->command, "which mesh? expected: meshtool tradeoff %s", job->command->usage);
    }
    const tradeoff_knob *only = settings->knob ? find_knob(job, settings->knob) : NULL;
    if (settings->knob && !only) {
        return CLI_EXIT_USAGE;
    }
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE && settings->plot) {
        code = tradeoff_check_plot(job, settings->plot);
    }
    const mt_mesh_format *format = NULL;
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &format);
    }
    if (code == CLI_EXIT_DONE) {
        static tradeoff_table table;
        tradeoff_subject subject = subject_of(job, mesh);
        code = measure(&subject, only, &table) == MT_OK ? tell(job, &subject, &table)
                                                        : cli_report_failure(job, job->operands[0]);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static void print_knobs(FILE *out)
{
    fputs("Knobs:\n", out);
    for (size_t i = 0; tradeoff_knobs[i]; i++) {
        fprintf(out, "  %-16s %s\n", tradeoff_knobs[i]->name, tradeoff_knobs[i]->question);
    }
}

static const tradeoff_settings defaults = {.budget = 20};

const cli_command cli_tradeoff_command = {
    .name = "tradeoff",
    .usage = "IN [--knob NAME] [--plot OUT] | --extremes",
    .summary = "Measure what speed costs in accuracy, on your own mesh",
    .description =
        "For each choice that the toolkit leaves to you (a knob), every level is run on this mesh and this machine, "
        "timed in turn with the others, and judged beside an oracle that shares no code with it: what it takes, what "
        "it "
        "gets wrong, and what you lose. Errors are the same on every machine; times are yours.",
    .examples = "  meshtool tradeoff bunny.obj\n"
                "  meshtool tradeoff bunny.obj --knob triangle-test --budget 5\n"
                "  meshtool tradeoff teapot.obj --plot tradeoff.svg --json\n",
    .options = options,
    .groups = CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(tradeoff_settings),
    .defaults = &defaults,
    .operand_minimum = 0,
    .operand_maximum = 1,
    .print_help = print_knobs,
    .run = run,
};
