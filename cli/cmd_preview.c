/* meshtool preview: a picture of any mesh. */
#include "files.h"
#include "message.h"
#include "quantity.h"

#include <meshtool/preview.h>

#include <string.h>

typedef struct preview_size {
    uint32_t width, height;
} preview_size;

typedef struct preview_background {
    mt_background kind;
    double color[3];
} preview_background;

typedef struct preview_settings {
    cli_common common;
    preview_size size;
    preview_background background;
    double crease;
    unsigned samples;
} preview_settings;

static bool parse_size(const cli_option *option, const char *text, void *value)
{
    (void)option;
    double width = 0, height = 0;
    if (!cli_scan_number(&text, &width) || *text++ != 'x' || !cli_scan_number(&text, &height) || *text) {
        return false;
    }
    if (width < 1 || height < 1 || width > MT_PREVIEW_MAXIMUM_SIZE || height > MT_PREVIEW_MAXIMUM_SIZE ||
        width != (uint32_t)width || height != (uint32_t)height) {
        return false;
    }
    *(preview_size *)value = (preview_size){(uint32_t)width, (uint32_t)height};
    return true;
}

static bool parse_background(const cli_option *option, const char *text, void *value)
{
    (void)option;
    preview_background *background = value;
    if (strcmp(text, "transparent") == 0) {
        background->kind = MT_BACKGROUND_TRANSPARENT;
        return true;
    }
    background->kind = MT_BACKGROUND_COLOR;
    if (!cli_scan_numbers(text, 3, background->color)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        background->color[i] /= 255;
        if (background->color[i] < 0 || background->color[i] > 1) {
            return false;
        }
    }
    return true;
}

static bool parse_samples(const cli_option *option, const char *text, void *value)
{
    static const unsigned known[] = {1, 4, 9, 16, 25, 36, 49, 64};
    bool found = cli_parse_count(option, text, value);
    for (size_t i = 0; found && i < sizeof known / sizeof known[0]; i++) {
        if (*(unsigned *)value == known[i]) {
            return true;
        }
    }
    return false;
}

static const cli_option options[] = {
    {.name = "size",
     .offset = offsetof(preview_settings, size),
     .parse = parse_size,
     .argument = "WxH",
     .expects = "a width and a height in pixels, such as 1920x1080",
     .help = "pixels; 1024x1024"},
    {.name = "background",
     .offset = offsetof(preview_settings, background),
     .parse = parse_background,
     .argument = "COLOUR",
     .expects = "transparent, or three numbers from 0 to 255, such as 255,255,255",
     .help = "R,G,B from 0 to 255, or transparent; a light grey"},
    {.name = "crease",
     .offset = offsetof(preview_settings, crease),
     .parse = cli_parse_number,
     .argument = "DEG",
     .expects = "degrees from 0.001 to 180",
     .minimum = 0.001,
     .maximum = 180,
     .help = "faces that meet at more than this show an edge; 42"},
    {.name = "samples",
     .offset = offsetof(preview_settings, samples),
     .parse = parse_samples,
     .argument = "N",
     .expects = "a square number from 1 to 64",
     .minimum = 1,
     .maximum = 64,
     .help = "samples a pixel, a square number; 16"},
    {0},
};

static void print_json(const cli_job *job, const mt_mesh_format *read, const mt_image *image)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(read->name));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "width", cli_json_integer(image->width));
    cli_json_set(object, "height", cli_json_integer(image->height));
    cli_json_print_line(object);
    json_decref(object);
}

static cli_exit draw(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read)
{
    const preview_settings *settings = job->settings;
    mt_preview_options how = {
        .width = settings->size.width,
        .height = settings->size.height,
        .background = settings->background.kind,
        .crease_degrees = settings->crease,
        .samples = settings->samples,
    };
    memcpy(how.background_color, settings->background.color, sizeof how.background_color);
    mt_image *image = NULL;
    if (mt_preview(job->context, mesh, &how, &image) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = cli_write_image(job, image, job->common->output);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, read, image);
    }
    mt_image_destroy(job->context, image);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const preview_settings *settings = job->settings;
    const mt_image_format *written = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_check_image_output(job, settings->common.output, &written);
    }
    if (code == CLI_EXIT_DONE && settings->background.kind == MT_BACKGROUND_TRANSPARENT && !written->holds_alpha) {
        code = cli_wrong_usage(job->command, "%s pictures cannot be transparent; write a png", written->name);
    }
    const mt_mesh_format *read = NULL;
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = draw(job, mesh, read);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

const cli_command cli_preview_command = {
    .name = "preview",
    .usage = "IN -o IMAGE",
    .summary = "Draw a picture of a mesh",
    .description =
        "Any mesh, with no further option: framed, lit, smooth where it is smooth, creased where it is creased, "
        "both sides of every face shown. +Z is up for STL, +Y for the others.",
    .examples = "  meshtool preview teapot.obj -o teapot.png\n"
                "  meshtool preview part.stl -o part.png --size 1920x1080 --background transparent\n",
    .options = options,
    .groups =
        CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(preview_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
