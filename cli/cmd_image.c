/* meshtool image: pictures from one format to another, with operations on the way. */
#include "files.h"
#include "image_chain.h"
#include "image_loss.h"
#include "message.h"

#include <string.h>

typedef struct image_settings {
    cli_common common;
    cli_image_chain chain;
    unsigned bits, quality;
} image_settings;

static bool parse_bits(const cli_option *option, const char *text, void *value)
{
    static const unsigned known[] = {1, 8, 16, 32};
    bool found = cli_parse_count(option, text, value);
    for (size_t i = 0; found && i < sizeof known / sizeof known[0]; i++) {
        if (*(unsigned *)value == known[i]) {
            return true;
        }
    }
    return false;
}

static const char *const patterns[] = {"RGGB", "BGGR", "GRBG", "GBRG", NULL}; /* as mt_bayer counts them */

#define CHAIN offsetof(image_settings, chain)
#define FULL "at most 64 operations"

static const cli_option options[] = {
    {.name = "bayer",
     .offset = CHAIN,
     .parse = cli_chain_parse_pattern,
     .argument = "PATTERN",
     .expects = "RGGB, BGGR, GRBG or GBRG",
     .choices = patterns,
     .help = "keep of each pixel the colour that a Bayer filter lets through: RGGB, BGGR, GRBG or GBRG"},
    {.name = "demosaic",
     .offset = CHAIN,
     .parse = cli_chain_parse_pattern,
     .argument = "PATTERN",
     .expects = "RGGB, BGGR, GRBG or GBRG",
     .choices = patterns,
     .help = "make colours of such samples, by the means of neighbours"},
    {.name = "desaturate",
     .offset = CHAIN,
     .parse = cli_chain_parse_number,
     .argument = "F",
     .expects = "a number from 0 to 1",
     .minimum = 0,
     .maximum = 1,
     .help = "multiply saturation by 1 - F"},
    {.name = "hue-shift",
     .offset = CHAIN,
     .parse = cli_chain_parse_number,
     .argument = "DEG",
     .expects = "a number of degrees",
     .minimum = -1e9,
     .maximum = 1e9,
     .help = "turn hues by DEG, modulo 360"},
    {.name = "gray",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help = "luminance, 0.2126 r + 0.7152 g + 0.0722 b; alpha stays"},
    {.name = "over",
     .offset = CHAIN,
     .parse = cli_chain_parse_background,
     .argument = "BG",
     .expects = "three numbers from 0 to 255, such as 255,128,0, or a picture's name",
     .help = "lay it over a colour R,G,B (0 to 255) or over another picture of its size"},
    {.name = "premultiply",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help = "multiply colours by alpha"},
    {.name = "unpremultiply",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help = "divide colours by alpha; where it is 0 they become 0"},
    {.name = "drop-alpha",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help = "leave alpha out and the colours as they are"},
    {.name = "linear",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help =
         "decode colours by the sRGB curve, so that what follows acts on light; what is written is encoded again, but "
         "for floats"},
    {.name = "srgb",
     .offset = CHAIN,
     .parse = cli_chain_parse_flag,
     .expects = FULL,
     .help = "encode colours by the sRGB curve"},
    {.name = "bits",
     .offset = offsetof(image_settings, bits),
     .parse = parse_bits,
     .argument = "N",
     .expects = "8 or 16; for TIFF also 1, or 32 for floats",
     .minimum = 1,
     .maximum = 32,
     .help = "write N bits a channel: 8 (default) or 16; TIFF also 1, and 32 for floats"},
    {.name = "quality",
     .offset = offsetof(image_settings, quality),
     .parse = cli_parse_count,
     .argument = "N",
     .expects = "a whole number from 1 to 100",
     .minimum = 1,
     .maximum = 100,
     .help = "of a JPEG, 1 to 100; 90 by default"},
    {.name = "strict-loss",
     .offset = offsetof(image_settings, common.strict_loss),
     .help = "fail rather than write fewer bits than IN has, or clip what is outside 0 to 1"},
    {0},
};

static cli_exit check_input(const cli_job *job)
{
    const char *from = cli_extension(job->common->from);
    const mt_image_format *format = from ? mt_image_format_by_extension(from) : NULL;
    if (from && (!format || !format->read)) {
        return cli_wrong_usage(job->command, "--from %s: no picture format that is read has this extension", from);
    }
    return CLI_EXIT_DONE;
}

static cli_exit read_image(const cli_job *job, mt_image **image, mt_image_source *source)
{
    mt_image_read_options how = {.format = cli_extension(job->common->from)};
    const char *path = job->operands[0];
    int part = mt_part_begin(job->context, "input", "a picture to change");
    mt_status status = mt_image_read_file(job->context, path, &how, image, source);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, path);
    }
    cli_say(job, "%s: read %s, %u x %u pixels of %u x %u bits", path, source->format->title, (*image)->width,
            (*image)->height, (*image)->channel_count, source->bits);
    return CLI_EXIT_DONE;
}

static json_t *describe(const cli_job *job, const mt_image *image, const mt_image_source *source)
{
    const image_settings *settings = job->settings;
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "format", cli_json_text(source->format->name));
    cli_json_set(object, "width", cli_json_integer(image->width));
    cli_json_set(object, "height", cli_json_integer(image->height));
    cli_json_set(object, "channels", cli_json_integer(image->channel_count));
    cli_json_set(object, "bits", cli_json_integer(source->bits));
    cli_json_set(object, "operations", cli_chain_json(&settings->chain));
    return object;
}

static cli_exit process(const cli_job *job, const char *path, const mt_image_format *written,
                        const mt_image_write_options *how)
{
    const image_settings *settings = job->settings;
    mt_image *image = NULL;
    mt_image_source source;
    cli_exit code = read_image(job, &image, &source);
    json_t *object = code == CLI_EXIT_DONE ? describe(job, image, &source) : NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_chain_apply(job, &settings->chain, &image);
    }
    cli_image_loss loss = {.format = written, .bits_before = code == CLI_EXIT_DONE ? source.bits : 0};
    if (code == CLI_EXIT_DONE) {
        code = cli_image_loss_find(job, image, path, how, &loss);
    }
    if (code == CLI_EXIT_DONE) {
        code = cli_write_image_as(job, image, path, how);
    }
    if (code == CLI_EXIT_DONE) {
        cli_image_loss_warn(job, path, &loss);
    }
    if (code == CLI_EXIT_DONE && job->common->json) {
        cli_json_set(object, "lost", cli_image_loss_json(&loss));
        cli_json_set(object, "output", cli_json_text(path));
        cli_json_print_line(object);
    }
    json_decref(object);
    mt_image_destroy(job->context, image);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const image_settings *settings = job->settings;
    const char *path = NULL;
    const mt_image_format *written = NULL;
    mt_image_write_options how = {.bits = settings->bits, .quality = settings->quality};
    unsigned bits;
    cli_exit code = cli_output_operand(job, &path);
    if (code == CLI_EXIT_DONE) {
        code = check_input(job);
    }
    if (code == CLI_EXIT_DONE) {
        code = cli_check_image_output(job, path, &written);
    }
    if (code == CLI_EXIT_DONE && mt_image_written_bits(job->context, written, &how, &bits) != MT_OK) {
        code = cli_report_failure(job, path);
    }
    return code == CLI_EXIT_DONE ? process(job, path, written, &how) : code;
}

const cli_command cli_image_command = {
    .name = "image",
    .usage = "IN OUT",
    .summary = "Change pictures: Bayer patterns, hue, saturation, grey, alpha; and their format",
    .description =
        "The operations happen in the order given, and may be repeated. They act on the numbers that the file "
        "holds, unless --linear comes before them. The format goes by OUT's extension, or by --to. Bits that are "
        "lost and numbers that are clipped are said.",
    .examples = "  meshtool image photo.jpg grey.png --gray\n"
                "  meshtool image raw.pgm photo.png --demosaic RGGB --bits 16\n"
                "  meshtool image logo.png logo.jpg --over 255,255,255 --quality 95\n"
                "  meshtool image photo.png back.png --bayer GRBG --demosaic GRBG\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_READ | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(image_settings),
    .operand_minimum = 1,
    .operand_maximum = 2,
    .run = run,
};
