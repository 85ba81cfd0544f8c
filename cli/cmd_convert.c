/* meshtool convert: from one format to another, moved, turned, scaled, triangulated on the way. */
#include "files.h"
#include "message.h"
#include "profile.h"
#include "quantity.h"

#include <meshtool/transform.h>
#include <meshtool/triangulate.h>
#include <meshtool/weld.h>

#include <limits.h>
#include <string.h>

/* All transformations that were given, in their order. */
typedef struct convert_move {
    mt_transform transform;
    bool is_given;
} convert_move;

typedef struct convert_settings {
    cli_common common;
    convert_move move;
    bool weld, triangulate;
    bool draco;
    unsigned bits, speed, method; /* UNSET: not given */
} convert_settings;

#define UNSET UINT_MAX
#define MOST_BITS_OF_GLTF 16

static const char *const draco_methods[] = {"edgebreaker", "sequential", NULL};

static void append(convert_move *move, mt_transform next)
{
    move->transform = mt_transform_then(&move->transform, &next);
    move->is_given = true;
}

static bool parse_scale(const cli_option *option, const char *text, void *value)
{
    double factor = 0;
    if (!cli_parse_number(option, text, &factor) || factor <= 0) {
        return false;
    }
    append(value, mt_transform_scaling(factor));
    return true;
}

static bool parse_translate(const cli_option *option, const char *text, void *value)
{
    (void)option;
    double offset[3];
    if (!cli_scan_numbers(text, 3, offset)) {
        return false;
    }
    append(value, mt_transform_translation(mt_vec3_make(offset[0], offset[1], offset[2])));
    return true;
}

/* "z,90" or "1,1,0,45" */
static bool parse_rotate(const cli_option *option, const char *text, void *value)
{
    (void)option;
    double axis[4] = {0, 0, 0, 0}; /* and the angle */
    if (*text >= 'x' && *text <= 'z' && text[1] == ',') {
        axis[*text - 'x'] = 1;
        if (!cli_scan_numbers(text + 2, 1, &axis[3])) {
            return false;
        }
    } else if (!cli_scan_numbers(text, 4, axis) || (axis[0] == 0 && axis[1] == 0 && axis[2] == 0)) {
        return false;
    }
    append(value, mt_transform_rotation(mt_vec3_make(axis[0], axis[1], axis[2]), axis[3]));
    return true;
}

static const cli_option options[] = {
    {.name = "scale",
     .offset = offsetof(convert_settings, move),
     .parse = parse_scale,
     .argument = "F",
     .expects = "a number above 0",
     .minimum = 0,
     .maximum = 1e300,
     .help = "multiply positions by F"},
    {.name = "rotate",
     .offset = offsetof(convert_settings, move),
     .parse = parse_rotate,
     .argument = "AXIS,DEG",
     .expects = "an axis (x, y, z or three numbers) and degrees, such as z,90 or 1,1,0,45",
     .help = "turn about x, y, z or an axis X,Y,Z, counter-clockwise as it points at you"},
    {.name = "translate",
     .offset = offsetof(convert_settings, move),
     .parse = parse_translate,
     .argument = "X,Y,Z",
     .expects = "three numbers, such as 0,-1.5,2",
     .help = "move by X,Y,Z"},
    {.name = "weld",
     .offset = offsetof(convert_settings, weld),
     .help = "join vertices whose positions are equal bit for bit"},
    {.name = "triangulate",
     .offset = offsetof(convert_settings, triangulate),
     .help = "split faces of more than three sides into triangles"},
    {.name = "draco",
     .offset = offsetof(convert_settings, draco),
     .help = "compress glTF with Draco (.drc files always are)"},
    {.name = "quantize",
     .offset = offsetof(convert_settings, bits),
     .parse = cli_parse_count,
     .argument = "BITS",
     .expects = "a whole number from 0 to 30",
     .minimum = 0,
     .maximum = 30,
     .help = "round positions to BITS of their extent: with Draco (default: 14), or in glTF without it (up to 16); 0: "
             "round "
             "nothing but to the format's own numbers"},
    {.name = "draco-speed",
     .offset = offsetof(convert_settings, speed),
     .parse = cli_parse_count,
     .argument = "N",
     .expects = "a whole number from 0 to 10",
     .minimum = 0,
     .maximum = 10,
     .help = "with Draco: 0 is smallest, 10 fastest (default: 5)"},
    {.name = "draco-method",
     .offset = offsetof(convert_settings, method),
     .parse = cli_parse_choice,
     .argument = "NAME",
     .expects = "edgebreaker or sequential",
     .choices = draco_methods,
     .help = "with Draco: edgebreaker is smaller, sequential keeps every vertex and the order"},
    {0},
};

static cli_exit triangulate(const cli_job *job, mt_mesh **mesh)
{
    mt_mesh *triangles = NULL;
    int part = mt_part_begin(job->context, "triangles", "asked for");
    mt_status status = mt_mesh_triangulate(job->context, *mesh, &triangles);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    mt_mesh_destroy(job->context, *mesh);
    *mesh = triangles;
    return CLI_EXIT_DONE;
}

static cli_exit weld(const cli_job *job, mt_mesh *mesh)
{
    mt_index removed = 0;
    int part = mt_part_begin(job->context, "weld", "asked for");
    mt_status status = mt_mesh_weld(job->context, mesh, &removed);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_say(job, "%s: welding joined %s to others", job->operands[0], cli_counted(removed, "vertex").text);
    return CLI_EXIT_DONE;
}

static cli_exit change(const cli_job *job, mt_mesh **mesh)
{
    const convert_settings *settings = job->settings;
    mt_part_skip(job->context, "connectivity", "no format holds more than faces and their corners");
    cli_exit code = settings->weld ? weld(job, *mesh) : CLI_EXIT_DONE;
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    if (settings->move.is_given && mt_mesh_transform(job->context, *mesh, &settings->move.transform) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    return settings->triangulate ? triangulate(job, mesh) : CLI_EXIT_DONE;
}

/* Draco's options need a format that takes them, and glTF needs to be told that they are meant. */
static cli_exit check_draco(const cli_job *job, const mt_mesh_format *format)
{
    const convert_settings *settings = job->settings;
    bool asked = settings->draco || settings->speed != UNSET || settings->method != UNSET;
    if (asked && !(format->abilities & MT_TAKES_DRACO)) {
        return cli_wrong_usage(job->command, "%s files are not compressed by Draco; drc, glb and gltf files can be",
                               format->name);
    }
    bool always = !(format->abilities & MT_HOLDS_PARTS); /* .drc */
    return !asked || settings->draco || always
               ? CLI_EXIT_DONE
               : cli_wrong_usage(job->command, "options of Draco need --draco for %s files", format->name);
}

/* glTF is quantised with Draco and without it. */
static cli_exit check_bits(const cli_job *job, const mt_mesh_format *format)
{
    const convert_settings *settings = job->settings;
    if (settings->bits == UNSET || settings->draco) {
        return CLI_EXIT_DONE;
    }
    if (!(format->abilities & (MT_TAKES_DRACO | MT_TAKES_QUANTIZATION))) {
        return cli_wrong_usage(job->command, "%s files are not quantised; drc, glb and gltf files can be",
                               format->name);
    }
    bool limited = format->abilities & MT_TAKES_QUANTIZATION;
    return limited && settings->bits > MOST_BITS_OF_GLTF
               ? cli_wrong_usage(job->command, "%s files hold positions in at most %d bits without --draco, not in %u",
                                 format->name, MOST_BITS_OF_GLTF, settings->bits)
               : CLI_EXIT_DONE;
}

static mt_mesh_write_options write_options(const convert_settings *settings, const mt_mesh_format *format)
{
    unsigned profiled = cli_profile_of(&settings->common)->quantization;
    unsigned bits = settings->bits == UNSET ? profiled : settings->bits;
    bool plain = settings->bits != UNSET && !settings->draco && (format->abilities & MT_TAKES_QUANTIZATION);
    return (mt_mesh_write_options){.draco = {.compress = settings->draco,
                                             .lossless = bits == 0,
                                             .position_bits = bits,
                                             .has_speed = settings->speed != UNSET,
                                             .speed = settings->speed == UNSET ? 0 : settings->speed,
                                             .sequential = settings->method == 1},
                                   .quantize_bits = plain ? bits : 0};
}

static cli_exit write(const cli_job *job, const mt_mesh *mesh, const char *path, const mt_mesh_format *format)
{
    json_t *lost = NULL;
    mt_mesh_write_options how = write_options(job->settings, format);
    cli_exit code = cli_write_mesh_as(job, mesh, path, &how, &lost);
    if (code == CLI_EXIT_DONE && job->common->json) {
        json_t *object = cli_json_object();
        cli_json_set(object, "lost", json_incref(lost));
        cli_json_print_line(object);
        json_decref(object);
    }
    json_decref(lost);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const char *path;
    cli_exit code = cli_output_operand(job, &path);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    cli_job input = *job;
    input.operand_count = 1;
    const mt_mesh_format *read = NULL, *written = NULL;
    code = cli_check_inputs(&input);
    if (code == CLI_EXIT_DONE) {
        code = cli_check_mesh_output(job, path, &written);
    }
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = check_draco(job, written);
    }
    if (code == CLI_EXIT_DONE) {
        code = check_bits(job, written);
    }
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = change(job, &mesh);
    }
    if (code == CLI_EXIT_DONE) {
        code = write(job, mesh, path, written);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

static const convert_settings defaults = {.bits = UNSET,
                                          .speed = UNSET,
                                          .method = UNSET,
                                          .move = {.transform = {.linear = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}};

const cli_command cli_convert_command = {
    .name = "convert",
    .usage = "IN OUT",
    .summary = "Write a mesh in another format, scaled, turned or moved",
    .description = "The format goes by OUT's extension, or by --to. What the format cannot hold is said; --strict-loss "
                   "makes it a failure. Scaling, turning and moving happen in the order given, and may be repeated.",
    .examples = "  meshtool convert part.stl part.ply\n"
                "  meshtool convert cow.obj cow.stl --rotate x,90 --scale 0.001\n"
                "  meshtool convert part.obj part.glb --draco --quantize 12\n"
                "  meshtool convert part.obj part.glb --quantize 16\n"
                "  meshtool convert - - --from obj --to off < cow.obj > cow.off\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_MESH | CLI_GROUP_READ | CLI_GROUP_PRECISION |
              CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(convert_settings),
    .defaults = &defaults,
    .operand_minimum = 1,
    .operand_maximum = 2,
    .run = run,
};
