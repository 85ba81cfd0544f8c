/* meshtool repair: mending step by step, each asked for, each accounted for. */
#include "files.h"
#include "line.h"
#include "message.h"
#include "quantity.h"

#include <meshtool/manifold.h>
#include <meshtool/repair.h>

typedef struct repair_settings {
    cli_common common;
    bool steps[MT_REPAIR_STEP_COUNT];
    bool all;
    unsigned max_hole;
    double tolerance;
} repair_settings;

#define STEP(step) .offset = offsetof(repair_settings, steps) + (step) * sizeof(bool)

static const cli_option options[] = {
    {.name = "weld", STEP(MT_REPAIR_WELD), .help = "make vertices at exactly the same place one"},
    {.name = "tolerance",
     .offset = offsetof(repair_settings, tolerance),
     .parse = cli_parse_number,
     .argument = "DISTANCE",
     .expects = "a distance above 0, in the mesh's units",
     .minimum = 0x1p-1074,
     .maximum = 0x1p1023,
     .help = "weld vertices up to this far apart (implies --weld)"},
    {.name = "drop-degenerate",
     STEP(MT_REPAIR_DROP_DEGENERATE),
     .help = "drop faces that name a vertex twice or have no area"},
    {.name = "drop-duplicates", STEP(MT_REPAIR_DROP_DUPLICATES), .help = "drop faces that repeat an earlier one"},
    {.name = "split",
     STEP(MT_REPAIR_SPLIT),
     .help = "copy vertices until every edge has two faces at most and every vertex one fan"},
    {.name = "orient", STEP(MT_REPAIR_ORIENT), .help = "turn faces alike, closed parts outwards"},
    {.name = "fill-holes",
     STEP(MT_REPAIR_FILL_HOLES),
     .help = "close boundary loops with triangles, the rims of open sheets too unless the sheet is flat"},
    {.name = "max-hole",
     .offset = offsetof(repair_settings, max_hole),
     .parse = cli_parse_count,
     .argument = "SIDES",
     .expects = "a whole number from 3 on",
     .minimum = 3,
     .maximum = MT_INDEX_MAX,
     .help = "fill only loops of at most so many sides (implies --fill-holes)"},
    {.name = "drop-isolated", STEP(MT_REPAIR_DROP_ISOLATED), .help = "drop vertices that no face, wire or point uses"},
    {.name = "all", .offset = offsetof(repair_settings, all), .help = "all of these, welding exactly"},
    {0},
};

/* What a step changes, for people: "turned 3 faces"; and what it had to leave. */
static const struct {
    const char *verb, *noun, *rest, *left_noun, *left_rest;
} words[MT_REPAIR_STEP_COUNT] = {
    [MT_REPAIR_WELD] = {"joined", "vertex", " to others at the same place", "", ""},
    [MT_REPAIR_DROP_DEGENERATE] = {"dropped", "face", " without area", "", ""},
    [MT_REPAIR_DROP_DUPLICATES] = {"dropped", "duplicate face", "", "", ""},
    [MT_REPAIR_SPLIT] = {"added", "vertex", ", to part surfaces that met in an edge or a point", "", ""},
    [MT_REPAIR_ORIENT] = {"turned", "face", "", "component", " as it was: no turning of faces orients all of it"},
    [MT_REPAIR_FILL_HOLES] = {"filled", "hole", "", "part",
                              " of the boundary open: the rim of a flat sheet, more sides than --max-hole, or "
                              "where triangles would be a new defect"},
    [MT_REPAIR_DROP_ISOLATED] = {"dropped", "isolated vertex", "", "", ""},
};

static bool print_step(mt_repair_step step, const mt_repair_result *result)
{
    if (result->count) {
        printf("  %-16s %s %s%s\n", mt_repair_step_option(step), words[step].verb,
               cli_counted(result->count, words[step].noun).text, words[step].rest);
    }
    if (result->left_count) {
        printf("  %-16s left %s%s\n", mt_repair_step_option(step),
               cli_counted(result->left_count, words[step].left_noun).text, words[step].left_rest);
    }
    return result->count || result->left_count;
}

/* "7 misoriented edges (first: edge 12-13)" */
static cli_line describe_remaining(const mt_manifold_report *after, mt_defect_kind kind)
{
    cli_line line = {0};
    cli_line_add(&line, "%s", cli_counted(after->defect_counts[kind], mt_defect_words(kind)).text);
    for (size_t i = 0; i < after->defect_list_count; i++) {
        const mt_defect *defect = &after->defects[i];
        if (defect->kind != kind) {
            continue;
        }
        bool is_face =
            kind == MT_DEFECT_DEGENERATE_FACE || kind == MT_DEFECT_DUPLICATE_FACE || kind == MT_DEFECT_ZERO_AREA_FACE;
        if ((is_face || kind == MT_DEFECT_INSIDE_OUT_COMPONENT) && defect->face_count) {
            cli_line_add(&line, " (first: face %u)", defect->faces[0]);
        } else if (!is_face && defect->vertex_count == 2) {
            cli_line_add(&line, " (first: edge %u-%u)", defect->vertices[0], defect->vertices[1]);
        } else if (!is_face && defect->vertex_count) {
            cli_line_add(&line, " (first: vertex %u)", defect->vertices[0]);
        }
        break;
    }
    return line;
}

/* Whether the kind is told of what remains. Pinches are non-manifold vertices or lie on non-manifold edges. */
static bool remains(const mt_manifold_report *after, int kind)
{
    return after->defect_counts[kind] && kind != MT_DEFECT_BOUNDARY_PINCH;
}

/* The step that mends the kind; none for a boundary, which may be meant. */
static mt_repair_step step_for(mt_defect_kind kind)
{
    switch (kind) {
    case MT_DEFECT_DEGENERATE_FACE:
    case MT_DEFECT_ZERO_AREA_FACE:
        return MT_REPAIR_DROP_DEGENERATE;
    case MT_DEFECT_DUPLICATE_FACE:
        return MT_REPAIR_DROP_DUPLICATES;
    case MT_DEFECT_NON_MANIFOLD_EDGE:
    case MT_DEFECT_NON_MANIFOLD_VERTEX:
        return MT_REPAIR_SPLIT;
    case MT_DEFECT_MISORIENTED_EDGE:
    case MT_DEFECT_INSIDE_OUT_COMPONENT:
        return MT_REPAIR_ORIENT;
    case MT_DEFECT_ISOLATED_VERTEX:
        return MT_REPAIR_DROP_ISOLATED;
    default:
        return MT_REPAIR_STEP_COUNT;
    }
}

/* The steps that would mend more of it and were not asked for. */
static void print_advice(const mt_repair_report *report, const mt_manifold_report *after)
{
    bool helps[MT_REPAIR_STEP_COUNT + 1] = {false};
    size_t count = 0, index = 0;
    for (int kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        mt_repair_step step = step_for((mt_defect_kind)kind);
        if (remains(after, kind) && step != MT_REPAIR_STEP_COUNT && !report->results[step].asked && !helps[step]) {
            helps[step] = true;
            count++;
        }
    }
    cli_line line = {0};
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        if (helps[step]) {
            cli_line option = {0};
            cli_line_add(&option, "--%s", mt_repair_step_option((mt_repair_step)step));
            cli_line_add_item(&line, index++, count, option.text);
        }
    }
    if (count) {
        printf("%s would mend more of it.\n", line.text);
    }
}

static void print_remaining(const mt_manifold_report *after)
{
    static const char *const classes[] = {"manifold and closed", "manifold with boundary", "not manifold"};
    printf("Now it is %s", classes[after->manifold_class]);
    cli_line line = {0};
    size_t kinds = 0, index = 0;
    for (int kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        kinds += remains(after, kind);
    }
    for (int kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        if (remains(after, kind)) {
            cli_line_add_item(&line, index++, kinds, describe_remaining(after, (mt_defect_kind)kind).text);
        }
    }
    printf(kinds ? ", still with %s.\n" : ".%s\n", line.text);
}

static bool asks_for_all(const mt_repair_report *report)
{
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        if (!report->results[step].asked) {
            return false;
        }
    }
    return true;
}

static void print_text(const cli_job *job, const mt_repair_report *report, const mt_manifold_report *after)
{
    bool changed = false;
    printf("%s -> %s:\n", job->operands[0], job->common->output);
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        changed = print_step((mt_repair_step)step, &report->results[step]) || changed;
    }
    if (!changed) {
        puts(asks_for_all(report) ? "  nothing to mend" : "  nothing for these steps to mend");
    }
    print_remaining(after);
    print_advice(report, after);
}

static json_t *numbers_json(const mt_index *numbers, uint64_t count)
{
    json_t *array = cli_json_array();
    for (uint64_t i = 0; i < count; i++) {
        cli_json_append(array, cli_json_integer(numbers[i]));
    }
    return array;
}

static json_t *result_json(const mt_repair_result *result)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "count", cli_json_integer((int64_t)result->count));
    cli_json_set(object, "faces", numbers_json(result->faces, result->face_count));
    cli_json_set(object, "vertices", numbers_json(result->vertices, result->vertex_count));
    cli_json_set(object, "left", cli_json_integer((int64_t)result->left_count));
    return object;
}

static void print_json(const cli_job *job, const mt_repair_report *report, const mt_manifold_report *after,
                       json_t *lost)
{
    static const char *const classes[] = {"manifold", "manifold-with-boundary", "non-manifold"};
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        if (report->results[step].asked) {
            cli_json_set(object, mt_repair_step_key((mt_repair_step)step), result_json(&report->results[step]));
        }
    }
    cli_json_set(object, "class", cli_json_text(classes[after->manifold_class]));
    cli_json_set(object, "lost", lost);
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit write_and_tell(const cli_job *job, const mt_mesh *mesh, const mt_repair_report *report)
{
    mt_manifold_report after;
    mt_manifold_options how = {.inside_out = true};
    if (mt_check_manifold(job->context, mesh, &how, &after) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    json_t *lost = NULL;
    cli_exit code = cli_write_mesh(job, mesh, job->common->output, &lost);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, report, &after, json_incref(lost));
    } else if (code == CLI_EXIT_DONE && !job->common->quiet && !cli_is_standard_output(job->common->output)) {
        print_text(job, report, &after);
    }
    json_decref(lost);
    mt_manifold_report_release(job->context, &after);
    return code;
}

static mt_repair_options choose_steps(const repair_settings *settings)
{
    mt_repair_options chosen = {.weld_tolerance = settings->tolerance, .hole_sides_maximum = settings->max_hole};
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        chosen.steps[step] = settings->steps[step] || settings->all;
    }
    chosen.steps[MT_REPAIR_WELD] = chosen.steps[MT_REPAIR_WELD] || settings->tolerance > 0;
    chosen.steps[MT_REPAIR_FILL_HOLES] = chosen.steps[MT_REPAIR_FILL_HOLES] || settings->max_hole > 0;
    return chosen;
}

static bool asks_for_nothing(const mt_repair_options *chosen)
{
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        if (chosen->steps[step]) {
            return false;
        }
    }
    return true;
}

static cli_exit mend(const cli_job *job, const mt_mesh *mesh, const mt_repair_options *chosen)
{
    mt_repair_report report;
    mt_mesh *mended = NULL;
    if (mt_repair(job->context, mesh, chosen, &report, &mended) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = write_and_tell(job, mended, &report);
    mt_repair_report_release(job->context, &report);
    mt_mesh_destroy(job->context, mended);
    return code;
}

static cli_exit run(const cli_job *job)
{
    mt_repair_options chosen = choose_steps(job->settings);
    if (asks_for_nothing(&chosen)) {
        return cli_wrong_usage(job->command, "no repair is asked for; --all does them all");
    }
    const mt_mesh_format *read = NULL, *written = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_check_mesh_output(job, job->common->output, &written);
    }
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = mend(job, mesh, &chosen);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

const cli_command cli_repair_command = {
    .name = "repair",
    .usage = "IN -o OUT --all",
    .summary = "Mend a mesh: weld, drop, split, orient, fill",
    .description =
        "Does only what is asked for, in the order of the options below, and says what each step changed. With "
        "--json the faces and vertices are named by their numbers in IN (from 0); what a step added has its "
        "number in OUT.",
    .examples = "  meshtool repair scan.obj -o clean.obj --all\n"
                "  meshtool repair part.stl -o part.ply --weld --tolerance 0.001 --orient\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION |
              CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(repair_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
