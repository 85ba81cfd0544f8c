#include "image_chain.h"

#include "line.h"
#include "message.h"

#include <meshtool/alpha.h>
#include <meshtool/bayer.h>
#include <meshtool/color.h>
#include <meshtool/image_format.h>

#include <string.h>

/* An operation changes the picture in place, or makes another. */
struct cli_image_operation {
    const char *name; /* the option's */
    mt_status (*change)(mt_context *context, mt_image *image, const cli_image_step *step);
    mt_status (*make)(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out);
};

static mt_status bayer(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out)
{
    return mt_bayer_mosaic(context, image, (mt_bayer)step->number, out);
}

static mt_status demosaic(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out)
{
    return mt_bayer_demosaic(context, image, (mt_bayer)step->number, out);
}

static mt_status desaturate(mt_context *context, mt_image *image, const cli_image_step *step)
{
    return mt_image_desaturate(context, image, step->number);
}

static mt_status shift_hue(mt_context *context, mt_image *image, const cli_image_step *step)
{
    return mt_image_shift_hue(context, image, step->number);
}

static mt_status gray(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out)
{
    (void)step;
    return mt_image_luminance(context, image, out);
}

/* The background goes with the picture: it is made linear when the picture was. */
static mt_status over(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out)
{
    bool is_linear = image->space == MT_COLOR_LINEAR;
    if (step->has_color) {
        double color[3];
        for (int k = 0; k < 3; k++) {
            color[k] = is_linear ? mt_srgb_decode(step->color[k]) : step->color[k];
        }
        return mt_image_over_color(context, image, color, out);
    }
    mt_image *background = NULL;
    mt_status status = mt_image_read_file(context, step->text, NULL, &background, NULL);
    if (status == MT_OK && is_linear) {
        status = mt_image_to_linear(context, background);
    }
    if (status == MT_OK) {
        status = mt_image_over(context, image, background, out);
    }
    mt_image_destroy(context, background);
    return status;
}

static mt_status premultiply(mt_context *context, mt_image *image, const cli_image_step *step)
{
    (void)step;
    return mt_image_premultiply(context, image);
}

static mt_status unpremultiply(mt_context *context, mt_image *image, const cli_image_step *step)
{
    (void)step;
    return mt_image_unpremultiply(context, image);
}

static mt_status drop_alpha(mt_context *context, const mt_image *image, const cli_image_step *step, mt_image **out)
{
    (void)step;
    return mt_image_drop_alpha(context, image, out);
}

static mt_status to_linear(mt_context *context, mt_image *image, const cli_image_step *step)
{
    (void)step;
    return mt_image_to_linear(context, image);
}

static mt_status to_srgb(mt_context *context, mt_image *image, const cli_image_step *step)
{
    (void)step;
    return mt_image_to_srgb(context, image);
}

static const cli_image_operation operations[] = {
    {.name = "bayer", .make = bayer},
    {.name = "demosaic", .make = demosaic},
    {.name = "desaturate", .change = desaturate},
    {.name = "hue-shift", .change = shift_hue},
    {.name = "gray", .make = gray},
    {.name = "over", .make = over},
    {.name = "premultiply", .change = premultiply},
    {.name = "unpremultiply", .change = unpremultiply},
    {.name = "drop-alpha", .make = drop_alpha},
    {.name = "linear", .change = to_linear},
    {.name = "srgb", .change = to_srgb},
};

/* A new step at the chain's end; NULL when it is full. */
static cli_image_step *append(const cli_option *option, const char *text, cli_image_chain *chain)
{
    if (chain->count == CLI_CHAIN_ROOM) {
        return NULL;
    }
    cli_image_step *step = &chain->steps[chain->count];
    for (size_t i = 0; i < sizeof operations / sizeof operations[0]; i++) {
        if (strcmp(operations[i].name, option->name) == 0) {
            step->operation = &operations[i];
        }
    }
    step->text = text;
    chain->count += step->operation != NULL;
    return step->operation ? step : NULL;
}

bool cli_chain_parse_flag(const cli_option *option, const char *text, void *value)
{
    return append(option, text, value) != NULL;
}

bool cli_chain_parse_number(const cli_option *option, const char *text, void *value)
{
    double number = 0;
    cli_image_step *step = cli_parse_number(option, text, &number) ? append(option, text, value) : NULL;
    if (step) {
        step->number = number;
    }
    return step != NULL;
}

bool cli_chain_parse_pattern(const cli_option *option, const char *text, void *value)
{
    unsigned pattern = 0;
    cli_image_step *step = cli_parse_choice(option, text, &pattern) ? append(option, text, value) : NULL;
    if (step) {
        step->number = pattern;
    }
    return step != NULL;
}

/* "255,128,0", or a file; what looks like numbers is no file. */
bool cli_chain_parse_background(const cli_option *option, const char *text, void *value)
{
    bool is_color = text[0] && text[strspn(text, "0123456789.,+-eE")] == '\0';
    double color[3] = {0, 0, 0};
    if (!text[0] || (is_color && !cli_scan_numbers(text, 3, color))) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        color[k] /= 255;
        if (!(color[k] >= 0 && color[k] <= 1)) {
            return false;
        }
    }
    cli_image_step *step = append(option, text, value);
    if (step) {
        step->has_color = is_color;
        memcpy(step->color, color, sizeof color);
    }
    return step != NULL;
}

cli_exit cli_chain_apply(const cli_job *job, const cli_image_chain *chain, mt_image **image)
{
    for (size_t i = 0; i < chain->count; i++) {
        const cli_image_step *step = &chain->steps[i];
        mt_image *made = NULL;
        int part = mt_part_begin(job->context, step->operation->name, "asked for");
        mt_status status = step->operation->change ? step->operation->change(job->context, *image, step)
                                                   : step->operation->make(job->context, *image, step, &made);
        mt_part_end(job->context, part);
        if (status != MT_OK) {
            return cli_report_failure(job, job->operands[0]);
        }
        if (made) {
            mt_image_destroy(job->context, *image);
            *image = made;
        }
    }
    return CLI_EXIT_DONE;
}

json_t *cli_chain_json(const cli_image_chain *chain)
{
    json_t *array = cli_json_array();
    for (size_t i = 0; i < chain->count; i++) {
        cli_line line = {0};
        const cli_image_step *step = &chain->steps[i];
        cli_line_add(&line, "%s%s%s", step->operation->name, step->text ? " " : "", step->text ? step->text : "");
        cli_json_append(array, cli_json_text(line.text));
    }
    return array;
}
