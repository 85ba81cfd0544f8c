/* TIFF by libtiff: 1 (grey), 8 and 16 bits, or floats as they are; deflate with differences where libtiff has it, low
 * byte first. The file is composed in memory, as its directory is written behind the pixels. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#ifdef MESHTOOL_TIFF
#include "formats/image/tiff_file.h"

#include <stdlib.h>
#include <string.h>

#define STRIP_SIZE ((uint64_t)256 << 10)
#define ENCODER_BYTES ((uint64_t)1 << 20)

typedef struct tiff_writer {
    mt_context *context;
    mt_tiff_file file;
    TIFF *tiff;
    unsigned bits;
    size_t value_count; /* of a row */
    uint32_t next_row;
    uint8_t *row; /* libtiff takes differences in place */
} tiff_writer;

static mt_status fail_to_write(const tiff_writer *writer)
{
    if (writer->file.is_full) {
        return mt_context_error(writer->context)->status;
    }
    if (writer->file.is_short) {
        return mt_fail(writer->context, MT_ERROR_OUT_OF_MEMORY, "no memory for the TIFF encoder");
    }
    return mt_fail(writer->context, MT_ERROR_UNSUPPORTED, "the picture cannot be written as TIFF: %s",
                   writer->file.message[0] ? writer->file.message : "libtiff refuses it");
}

static mt_status put_row(tiff_writer *writer)
{
    bool is_written = TIFFWriteScanline(writer->tiff, writer->row, writer->next_row++, 0) == 1;
    return is_written ? MT_OK : fail_to_write(writer);
}

/* Rows of 8 and 16 bits as they are encoded for every format, and of 1 bit as the halves of 8. */
static mt_status write_encoded(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count)
{
    (void)context;
    tiff_writer *writer = (tiff_writer *)user;
    mt_status status = MT_OK;
    size_t count = writer->value_count;
    for (uint32_t row = 0; row < row_count && status == MT_OK; row++) {
        if (writer->bits == 16) {
            for (size_t i = 0; i < count; i++, bytes += 2) {
                uint16_t word = (uint16_t)(bytes[0] << 8 | bytes[1]);
                memcpy(writer->row + 2 * i, &word, sizeof word);
            }
        } else if (writer->bits == 8) {
            memcpy(writer->row, bytes, count);
            bytes += count;
        } else {
            memset(writer->row, 0, (count + 7) / 8);
            for (size_t i = 0; i < count; i++) {
                writer->row[i / 8] |= (uint8_t)((*bytes++ >> 7) << (7 - i % 8));
            }
        }
        status = put_row(writer);
    }
    return status;
}

static mt_status write_floats(tiff_writer *writer, const mt_image *image)
{
    mt_status status = MT_OK;
    for (uint32_t y = 0; y < image->height && status == MT_OK; y++) {
        memcpy(writer->row, mt_image_pixel(image, 0, y), 4 * writer->value_count);
        status = put_row(writer);
    }
    return status;
}

static void set_compression(TIFF *tiff, unsigned bits)
{
    if (TIFFIsCODECConfigured(COMPRESSION_ADOBE_DEFLATE)) {
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
        if (bits > 1) {
            TIFFSetField(tiff, TIFFTAG_PREDICTOR, bits == 32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
        }
    }
}

static void set_fields(TIFF *tiff, const mt_image *image, unsigned bits)
{
    uint64_t row = ((uint64_t)image->width * image->channel_count * bits + 7) / 8;
    uint64_t rows = row < STRIP_SIZE ? STRIP_SIZE / row : 1;
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, image->width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, image->height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, (int)bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, (int)image->channel_count);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, image->channel_count == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, (uint32_t)(rows < image->height ? rows : image->height));
    if (image->channel_count == 4) {
        uint16_t kind = image->is_premultiplied ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind);
    }
    set_compression(tiff, bits);
}

static mt_status compose(tiff_writer *writer, const mt_image *image)
{
    writer->tiff = mt_tiff_open(&writer->file, "wl", ENCODER_BYTES + 8 * writer->value_count);
    if (!writer->tiff) {
        return fail_to_write(writer);
    }
    set_fields(writer->tiff, image, writer->bits);
    writer->row = mt_allocate_array(writer->context, writer->value_count, 4);
    mt_status status = writer->row ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        status = writer->bits == 32
                     ? write_floats(writer, image)
                     : mt_image_write_bands(writer->context, image, writer->bits == 16 ? 16 : 8, write_encoded, writer);
    }
    if (status == MT_OK && TIFFFlush(writer->tiff) != 1) {
        status = fail_to_write(writer);
    }
    TIFFClose(writer->tiff);
    mt_free(writer->context, writer->row);
    return status;
}

static mt_status check_request(mt_context *context, const mt_image *image, unsigned bits)
{
    if (bits == 1 && image->channel_count != 1) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED, "pictures of 1 bit are grey, and this one has %u channels",
                       image->channel_count);
    }
    return MT_OK;
}

static mt_status write_tiff(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                            mt_output *output)
{
    tiff_writer writer = {.context = context, .file = {.context = context}};
    writer.bits = options && options->bits ? options->bits : 8;
    writer.value_count = (size_t)image->width * image->channel_count;
    uint64_t held = ENCODER_BYTES + 8 * (uint64_t)writer.value_count;
    mt_status status = check_request(context, image, writer.bits);
    if (status == MT_OK) {
        status = mt_hold_bytes(context, held);
    }
    if (status != MT_OK) {
        return status;
    }
    status = compose(&writer, image);
    if (status == MT_OK) {
        status = mt_output_write(context, output, writer.file.bytes, (size_t)writer.file.size);
    }
    mt_free(context, writer.file.bytes);
    mt_release_bytes(context, held);
    return status;
}

static const char *const extensions[] = {"tiff", "tif", NULL};

const mt_image_format mt_tiff_format = {.name = "tiff",
                                        .title = "Tagged Image File Format",
                                        .extensions = extensions,
                                        .holds_alpha = true,
                                        .bits = {1, 8, 16, 32},
                                        .sniff = mt_tiff_sniff,
                                        .read = mt_tiff_read,
                                        .write = write_tiff};
#endif
