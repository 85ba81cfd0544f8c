/* meshtool generate: primitives by name. */
#include "files.h"
#include "help.h"
#include "line.h"
#include "memory.h"
#include "message.h"
#include "nearest.h"

#include <meshtool/generate.h>

#include <stdlib.h>
#include <string.h>

typedef struct generate_magnitude {
    bool is_given;
    double value;
} generate_magnitude;

typedef struct generate_settings {
    cli_common common;
    unsigned resolution;
    generate_magnitude magnitude;
} generate_settings;

static bool parse_magnitude(const cli_option *option, const char *text, void *value)
{
    generate_magnitude *magnitude = value;
    magnitude->is_given = true;
    return cli_parse_number(option, text, &magnitude->value);
}

static const cli_option options[] = {
    {.name = "resolution",
     .letter = 'n',
     .offset = offsetof(generate_settings, resolution),
     .parse = cli_parse_count,
     .argument = "N",
     .expects = "a whole number from 1 on",
     .minimum = 1,
     .maximum = MT_INDEX_MAX,
     .help = "how fine; what N means stands with each kind below"},
    {.name = "magnitude",
     .offset = offsetof(generate_settings, magnitude),
     .parse = parse_magnitude,
     .argument = "X",
     .expects = "a number, such as 1e7",
     .minimum = 0,
     .maximum = 0x1.fffffffffffffp1023,
     .help = "how extreme; what X means stands with each extreme below"},
    {0},
};

static void print_extremes(FILE *out)
{
    size_t count = 0;
    const mt_extreme *extremes = mt_extremes(&count);
    fputs("Extremes, which break naive programs:\n", out);
    for (size_t i = 0; i < count; i++) {
        cli_line line = {0}, name = {0};
        cli_line_add(&name, "extreme:%s", extremes[i].name);
        cli_line_add(&line, "%s; X: %s (default %g)", extremes[i].summary, extremes[i].meaning, extremes[i].magnitude);
        fprintf(out, "  %-20s ", name.text);
        cli_print_wrapped(out, line.text, 23, 23);
    }
}

static void print_kinds(FILE *out)
{
    size_t count = 0;
    const mt_primitive *primitives = mt_primitives(&count);
    fputs("Kinds:\n", out);
    for (size_t i = 0; i < count; i++) {
        cli_line line = {0};
        cli_line_add(&line, "%s", primitives[i].summary);
        if (primitives[i].resolution_meaning) {
            cli_line_add(&line, "; N: %s (default %u)", primitives[i].resolution_meaning, primitives[i].resolution);
        }
        fprintf(out, "  %-15s ", primitives[i].name);
        cli_print_wrapped(out, line.text, 18, 18);
    }
    print_extremes(out);
}

static const mt_primitive *find_kind(const char *name)
{
    size_t count = 0;
    const mt_primitive *primitives = mt_primitives(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(primitives[i].name, name) == 0) {
            return &primitives[i];
        }
    }
    return NULL;
}

static cli_exit unknown_kind(const cli_job *job, const char *name)
{
    size_t count = 0;
    const mt_primitive *primitives = mt_primitives(&count);
    const char **names = cli_allocate(count + 1, sizeof *names);
    for (size_t i = 0; i < count; i++) {
        names[i] = primitives[i].name;
    }
    const char *nearest = cli_nearest(name, names, count);
    cli_exit code = nearest ? cli_wrong_usage(job->command, "unknown kind \"%s\"; did you mean %s?", name, nearest)
                            : cli_wrong_usage(job->command, "unknown kind \"%s\"", name);
    free(names);
    return code;
}

static void print_json(const cli_job *job, const mt_mesh *mesh, json_t *lost)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "kind", cli_json_text(job->operands[0]));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "vertices", cli_json_integer(mesh->vertex_count));
    cli_json_set(object, "faces", cli_json_integer(mesh->face_count));
    cli_json_set(object, "lost", lost);
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit make(const cli_job *job)
{
    const generate_settings *settings = job->settings;
    mt_generate_options how = {
        .resolution = settings->resolution,
        .magnitude = settings->magnitude.value,
        .has_magnitude = settings->magnitude.is_given,
        .position_type = settings->common.precision == MT_PRECISION_F32 ? MT_F32 : MT_F64,
    };
    mt_mesh *mesh = NULL;
    int part = mt_part_begin(job->context, "mesh", "asked for");
    mt_status status = mt_generate(job->context, job->operands[0], &how, &mesh);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, NULL);
    }
    json_t *lost = NULL;
    cli_exit code = cli_write_mesh(job, mesh, settings->common.output, &lost);
    if (code == CLI_EXIT_DONE && settings->common.json) {
        print_json(job, mesh, json_incref(lost));
    }
    json_decref(lost);
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const generate_settings *settings = job->settings;
    bool is_extreme = strncmp(job->operands[0], "extreme:", 8) == 0;
    const mt_primitive *kind = find_kind(job->operands[0]);
    if (!kind && !is_extreme) {
        return unknown_kind(job, job->operands[0]);
    }
    if (kind && settings->magnitude.is_given) {
        return cli_wrong_usage(job->command, "a %s has no magnitude; extremes have one", kind->name);
    }
    if (kind && settings->resolution && !kind->resolution_meaning) {
        return cli_wrong_usage(job->command, "a %s has no resolution", kind->name);
    }
    const mt_mesh_format *written = NULL;
    cli_exit code = cli_check_mesh_output(job, settings->common.output, &written);
    return code == CLI_EXIT_DONE ? make(job) : code;
}

const cli_command cli_generate_command = {
    .name = "generate",
    .usage = "KIND -o OUT [--resolution N] [--magnitude X]",
    .summary = "Make a mesh: a cube, a torus, a teapot ...",
    .examples = "  meshtool generate torus -o torus.obj --resolution 64\n"
                "  meshtool generate cube -o - --to off | meshtool info -\n"
                "  meshtool generate extreme:offset -o far.ply --magnitude 1e9\n",
    .options = options,
    .groups =
        CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(generate_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .print_help = print_kinds,
    .run = run,
};
