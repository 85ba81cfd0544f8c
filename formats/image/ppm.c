/* The netpbm family: PBM (1 bit), PPM (colour), PGM (grey), PAM (either, with alpha), binary, 8 or 16 bits. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

typedef struct rows_writer {
    mt_output *output;
    size_t row_size;
} rows_writer;

static mt_status write_rows(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count)
{
    const rows_writer *writer = (const rows_writer *)user;
    return mt_output_write(context, writer->output, bytes, row_count * writer->row_size);
}

static mt_status write_body(mt_context *context, const mt_image *image, unsigned bits, mt_output *output)
{
    rows_writer writer = {output, (size_t)image->width * image->channel_count * (bits / 8)};
    return mt_image_write_bands(context, image, bits, write_rows, &writer);
}

/* P5 and P6 have the same header. */
static mt_status write_plain(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                             mt_output *output)
{
    unsigned bits = options && options->bits ? options->bits : 8;
    mt_status status = mt_output_format(context, output, "P%c\n%u %u\n%u\n", image->channel_count == 1 ? '5' : '6',
                                        image->width, image->height, (1u << bits) - 1u);
    return status == MT_OK ? write_body(context, image, bits, output) : status;
}

static mt_status write_ppm(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    if (image->channel_count == 4) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "PPM holds no transparency: write .png or .pam, or give a background");
    }
    return write_plain(context, image, options, output);
}

static mt_status write_pgm(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    if (image->channel_count != 1) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "PGM holds grey pictures only: make it grey, or write .ppm, .pam or .png");
    }
    return write_plain(context, image, options, output);
}

static mt_status write_pam(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    static const char *const kinds[] = {"", "GRAYSCALE", "", "RGB", "RGB_ALPHA"};
    unsigned bits = options && options->bits ? options->bits : 8;
    mt_status status = mt_output_format(
        context, output, "P7\nWIDTH %u\nHEIGHT %u\nDEPTH %u\nMAXVAL %u\nTUPLTYPE %s\nENDHDR\n", image->width,
        image->height, image->channel_count, (1u << bits) - 1u, kinds[image->channel_count]);
    return status == MT_OK ? write_body(context, image, bits, output) : status;
}

/* Eight pixels a byte, 1 is black. */
static mt_status write_bits(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count)
{
    const rows_writer *writer = (const rows_writer *)user;
    mt_status status = MT_OK;
    for (uint32_t row = 0; row < row_count && status == MT_OK; row++) {
        for (size_t x = 0; x < writer->row_size && status == MT_OK; x += 8) {
            unsigned char packed = 0;
            for (size_t k = 0; k < 8 && x + k < writer->row_size; k++) {
                packed |= (unsigned char)((bytes[x + k] < 128) << (7 - k));
            }
            status = mt_output_write(context, writer->output, &packed, 1);
        }
        bytes += writer->row_size;
    }
    return status;
}

static mt_status write_pbm(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    if (image->channel_count != 1) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "PBM holds grey pictures only: make it grey, or write .ppm, .pam or .png");
    }
    (void)options;
    rows_writer writer = {output, image->width};
    mt_status status = mt_output_format(context, output, "P4\n%u %u\n", image->width, image->height);
    return status == MT_OK ? mt_image_write_bands(context, image, 8, write_bits, &writer) : status;
}

static const char *const pbm_extensions[] = {"pbm", NULL};
static const char *const ppm_extensions[] = {"ppm", "pnm", NULL};
static const char *const pgm_extensions[] = {"pgm", NULL};
static const char *const pam_extensions[] = {"pam", NULL};

const mt_image_format mt_ppm_format = {.name = "ppm",
                                       .title = "Portable pixmap",
                                       .extensions = ppm_extensions,
                                       .bits = {8, 16},
                                       .sniff = mt_ppm_sniff,
                                       .read = mt_netpbm_read,
                                       .write = write_ppm};
const mt_image_format mt_pgm_format = {.name = "pgm",
                                       .title = "Portable graymap",
                                       .extensions = pgm_extensions,
                                       .bits = {8, 16},
                                       .sniff = mt_pgm_sniff,
                                       .read = mt_netpbm_read,
                                       .write = write_pgm};
const mt_image_format mt_pam_format = {.name = "pam",
                                       .title = "Portable arbitrary map",
                                       .extensions = pam_extensions,
                                       .holds_alpha = true,
                                       .bits = {8, 16},
                                       .sniff = mt_pam_sniff,
                                       .read = mt_netpbm_read,
                                       .write = write_pam};
const mt_image_format mt_pbm_format = {.name = "pbm",
                                       .title = "Portable bitmap",
                                       .extensions = pbm_extensions,
                                       .bits = {1},
                                       .sniff = mt_pbm_sniff,
                                       .read = mt_netpbm_read,
                                       .write = write_pbm};
