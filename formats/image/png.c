/* PNG by libspng. Every row is filtered as the difference to its left neighbour, and deflate looks for runs alone: a
 * drawn picture is smooth or flat, so that takes half the time of deflate's level 1 and gives smaller files. Trying all
 * five filters would cost more than deflate itself. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#ifdef MESHTOOL_PNG
#include <spng.h>

#define COMPRESSION_LEVEL 1
#define RUNS_ALONE 3 /* zlib's Z_RLE */

typedef struct png_writer {
    mt_context *context;
    mt_output *output;
    spng_ctx *png;
    size_t row_size;
    mt_status status; /* of the output: spng itself only knows that writing failed */
} png_writer;

static int write_stream(spng_ctx *png, void *user, void *bytes, size_t size)
{
    (void)png;
    png_writer *writer = (png_writer *)user;
    writer->status = mt_output_write(writer->context, writer->output, bytes, size);
    return writer->status == MT_OK ? 0 : SPNG_IO_ERROR;
}

static mt_status check(png_writer *writer, int error)
{
    if (error == 0 || error == SPNG_EOI) {
        return MT_OK;
    }
    if (writer->status != MT_OK) {
        return writer->status;
    }
    mt_status status = error == SPNG_EMEM ? MT_ERROR_OUT_OF_MEMORY : MT_ERROR_UNSUPPORTED;
    return mt_fail(writer->context, status, "the picture cannot be written as PNG: %s", spng_strerror(error));
}

static mt_status write_rows(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count)
{
    (void)context;
    png_writer *writer = (png_writer *)user;
    mt_status status = MT_OK;
    for (uint32_t row = 0; row < row_count && status == MT_OK; row++) {
        status = check(writer, spng_encode_row(writer->png, bytes + row * writer->row_size, writer->row_size));
    }
    return status;
}

static uint8_t png_color_type(const mt_image *image)
{
    switch (image->channel_count) {
    case 1:
        return SPNG_COLOR_TYPE_GRAYSCALE;
    case 3:
        return SPNG_COLOR_TYPE_TRUECOLOR;
    default:
        return SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    }
}

static mt_status begin(png_writer *writer, const mt_image *image, unsigned bits)
{
    struct spng_ihdr header = {.width = image->width,
                               .height = image->height,
                               .bit_depth = (uint8_t)bits,
                               .color_type = png_color_type(image)};
    int error = spng_set_png_stream(writer->png, write_stream, writer);
    error = error ? error : spng_set_option(writer->png, SPNG_IMG_COMPRESSION_LEVEL, COMPRESSION_LEVEL);
    error = error ? error : spng_set_option(writer->png, SPNG_IMG_COMPRESSION_STRATEGY, RUNS_ALONE);
    error = error ? error : spng_set_option(writer->png, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
    error = error ? error : spng_set_ihdr(writer->png, &header);
    error = error ? error : spng_set_srgb(writer->png, 0);
    int flags = SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE;
    error = error ? error : spng_encode_image(writer->png, NULL, 0, SPNG_FMT_RAW, flags);
    return check(writer, error);
}

static mt_status write_png(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    unsigned bits = options && options->bits ? options->bits : 8;
    if (bits != 8 && bits != 16) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "PNG holds 8 or 16 bits a channel, not %u", bits);
    }
    png_writer writer = {.context = context, .output = output};
    writer.row_size = (size_t)image->width * image->channel_count * (bits / 8);
    writer.png = spng_ctx_new(SPNG_CTX_ENCODER);
    if (!writer.png) {
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory for the PNG encoder");
    }
    mt_status status = begin(&writer, image, bits);
    if (status == MT_OK) {
        status = mt_image_write_bands(context, image, bits, write_rows, &writer);
    }
    spng_ctx_free(writer.png);
    return status;
}

static const char *const extensions[] = {"png", NULL};

const mt_image_format mt_png_format = {.name = "png",
                                       .title = "Portable Network Graphics",
                                       .extensions = extensions,
                                       .holds_alpha = true,
                                       .sniff = mt_png_sniff,
                                       .read = mt_png_read,
                                       .write = write_png};
#endif
