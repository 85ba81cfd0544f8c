/* meshtool normals: adds normals of faces, vertices or corners to a mesh. */
#include "files.h"
#include "message.h"
#include "quantity.h"

#include <meshtool/elementary.h>
#include <meshtool/normals.h>

#define NO_CREASE (-1.0)

typedef struct normals_settings {
    cli_common common;
    unsigned kind, weight;
    double crease;
    bool reachable;
} normals_settings;

/* In the order of the library's enumerations. */
static const char *const kinds[] = {"vertex", "face", "corner", NULL};
static const char *const weights[] = {"area", "angle", "max", "uniform", NULL};
#define KIND_OPEN 3   /* not given: vertex, or corner where a crease angle is */
#define WEIGHT_OPEN 4 /* not given: area */

static const cli_option options[] = {
    {.name = "kind",
     .offset = offsetof(normals_settings, kind),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "face, vertex or corner",
     .choices = kinds,
     .help = "face: flat; vertex: smooth; corner: smooth with creases; vertex, with --crease corner"},
    {.name = "weight",
     .offset = offsetof(normals_settings, weight),
     .parse = cli_parse_choice,
     .argument = "WEIGHT",
     .expects = "area, angle, max or uniform",
     .choices = weights,
     .help = "how much each face counts: by its area, by its angle, Nelson Max's weight (exact on spheres), or alike; "
             "area"},
    {.name = "crease",
     .offset = offsetof(normals_settings, crease),
     .parse = cli_parse_number,
     .argument = "DEG",
     .expects = "an angle from 0 to 180",
     .minimum = 0,
     .maximum = 180,
     .help = "corners do not count faces that are turned by as much or more; 41, which no regular polygon has"},
    {.name = "reachable",
     .offset = offsetof(normals_settings, reachable),
     .help = "corners count only faces that are reached around the vertex without crossing a crease"},
    {0},
};

static mt_normal_options choose(const normals_settings *settings)
{
    mt_normal_options how = {.reachable_only = settings->reachable};
    bool of_corners = settings->crease >= 0 || settings->reachable;
    how.kind = settings->kind != KIND_OPEN ? (mt_normal_kind)settings->kind
               : of_corners                ? MT_NORMALS_CORNER
                                           : MT_NORMALS_VERTEX;
    how.weight = settings->weight != WEIGHT_OPEN ? (mt_normal_weight)settings->weight : MT_NORMAL_WEIGHT_AREA;
    double angle = settings->crease * (MT_PI / 180);
    how.crease_angle = settings->crease < 0 ? MT_DEFAULT_CREASE_ANGLE : angle > 0 ? angle : -1;
    return how;
}

static double degrees_of(const normals_settings *settings)
{
    return settings->crease >= 0 ? settings->crease : MT_DEFAULT_CREASE_ANGLE * (180 / MT_PI);
}

static void print_json(const cli_job *job, const mt_mesh_format *format, const mt_normal_options *how,
                       const mt_normal_report *report, json_t *lost)
{
    json_t *object = cli_json_object();
    bool of_faces = how->kind == MT_NORMALS_FACE, of_corners = how->kind == MT_NORMALS_CORNER;
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(format->name));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "kind", cli_json_text(kinds[how->kind]));
    cli_json_set(object, "weight", of_faces ? json_null() : cli_json_text(weights[how->weight]));
    cli_json_set(object, "crease", of_corners ? cli_json_real(degrees_of(job->settings)) : json_null());
    cli_json_set(object, "elements", cli_json_integer(report->element_count));
    cli_json_set(object, "normals", cli_json_integer(report->value_count));
    cli_json_set(object, "undefined", cli_json_integer(report->undefined_count));
    cli_json_set(object, "lost", json_incref(lost));
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit add_and_write(const cli_job *job, mt_mesh *mesh, const mt_mesh_format *format)
{
    mt_normal_options how = choose(job->settings);
    mt_normal_report report;
    int part = mt_part_begin(job->context, "normals", "asked for");
    mt_part_skip(job->context, "edge pairs", "a normal needs the faces around its vertex, and no edges");
    mt_status status = mt_mesh_add_normals(job->context, mesh, &how, &report);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    if (report.undefined_count) {
        cli_say(job, "%s: %s without a direction, stored as 0 0 0", job->operands[0],
                cli_counted(report.undefined_count, kinds[how.kind]).text);
    }
    json_t *lost = NULL;
    cli_exit code = cli_write_mesh(job, mesh, job->common->output, &lost);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, format, &how, &report, lost);
    }
    json_decref(lost);
    return code;
}

/* What was asked for has a meaning together. */
static cli_exit check(const cli_job *job)
{
    const normals_settings *settings = job->settings;
    bool of_corners = settings->kind == KIND_OPEN || settings->kind == MT_NORMALS_CORNER;
    if (!of_corners && (settings->crease >= 0 || settings->reachable)) {
        return cli_wrong_usage(job->command, "%s is for corners, not for --kind %s",
                               settings->crease >= 0 ? "--crease" : "--reachable", kinds[settings->kind]);
    }
    if (settings->kind == MT_NORMALS_FACE && settings->weight != WEIGHT_OPEN) {
        return cli_wrong_usage(job->command, "--weight is for vertices and corners, not for --kind face");
    }
    return cli_check_inputs(job);
}

static cli_exit run(const cli_job *job)
{
    const mt_mesh_format *read = NULL, *written = NULL;
    cli_exit code = check(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_check_mesh_output(job, job->common->output, &written);
    }
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = add_and_write(job, mesh, read);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static const normals_settings defaults = {.kind = KIND_OPEN, .weight = WEIGHT_OPEN, .crease = NO_CREASE};

const cli_command cli_normals_command = {
    .name = "normals",
    .usage = "IN -o OUT",
    .summary = "Add normals of faces, vertices or corners to a mesh",
    .description =
        "Normals of vertices and of corners replace those that the mesh has on either, normals of faces those of "
        "faces. A bow-tie has a normal for each of its fans. What has no direction (a face without area, a "
        "vertex without faces) gets 0 0 0, and is counted. Normals are right whatever the size of the mesh, its "
        "distance from the origin and the shape of its faces, as far as its positions are.",
    .examples = "  meshtool normals cow.obj -o cow-smooth.ply\n"
                "  meshtool normals part.stl -o part.obj --kind corner --crease 30\n"
                "  meshtool normals ball.ply -o ball.ply --weight max\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION |
              CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(normals_settings),
    .defaults = &defaults,
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
