/* Reading TIFF by libtiff: the first picture of a file; grey, palette, RGB, with or without alpha; 1 to 16 bits whole,
 * 32 and 64 bits float; strips and tiles, channels together or apart, every compression that libtiff was built with.
 * What the header declares is checked against the file's size before libtiff decodes or anything is allocated. */
#include "formats/image/image_format.h"

#ifdef MESHTOOL_TIFF
#include "formats/image/samples.h"
#include "formats/image/tiff_file.h"

#include <stdio.h>
#include <string.h>

#define DECODER_BYTES ((uint64_t)1 << 20)

typedef struct tiff_reader {
    mt_context *context;
    mt_input *input;
    mt_tiff_file file;
    TIFF *tiff;
    uint32_t width, height;
    uint16_t bits, sample_count, photometric, planes, sample_format, compression;
    uint32_t color_count; /* samples of colour: 1 or 3, and 1 for palettes */
    bool has_alpha, is_premultiplied;
    uint16_t *palette[3];
    mt_image *image;
    /* A strip or a tile: its sides, and what of it lies in the picture. */
    uint32_t block_width, block_height;
    uint64_t block_size, row_size;
    uint8_t *block;
} tiff_reader;

static mt_status refuse(const tiff_reader *reader, const char *what, unsigned value)
{
    mt_place place = {.file = mt_input_name(reader->input)};
    return mt_fail_at(reader->context, MT_ERROR_UNSUPPORTED, place, "TIFF pictures with %s %u are not read", what,
                      value);
}

static mt_status fail_in_tiff(const tiff_reader *reader)
{
    mt_place place = {.file = mt_input_name(reader->input)};
    if (reader->file.is_short) {
        return mt_fail_at(reader->context, MT_ERROR_OUT_OF_MEMORY, place, "no memory for the TIFF decoder");
    }
    return mt_fail_at(reader->context, MT_ERROR_SYNTAX, place, "the TIFF data is damaged or incomplete: %s",
                      reader->file.message[0] ? reader->file.message : "it has no picture");
}

static void get_fields(tiff_reader *reader)
{
    TIFF *tiff = reader->tiff;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &reader->width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &reader->height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &reader->bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &reader->sample_count);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &reader->planes);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &reader->sample_format);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &reader->compression);
    if (!TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &reader->photometric)) {
        reader->photometric = PHOTOMETRIC_MINISBLACK;
    }
    if (reader->photometric == PHOTOMETRIC_YCBCR && reader->compression == COMPRESSION_JPEG) {
        TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
        reader->photometric = PHOTOMETRIC_RGB;
    }
}

static mt_status check_photometric(tiff_reader *reader)
{
    switch (reader->photometric) {
    case PHOTOMETRIC_MINISWHITE:
    case PHOTOMETRIC_MINISBLACK:
        reader->color_count = 1;
        return MT_OK;
    case PHOTOMETRIC_RGB:
        reader->color_count = 3;
        return MT_OK;
    case PHOTOMETRIC_PALETTE:
        reader->color_count = 1;
        if (reader->bits > 8 || !TIFFGetField(reader->tiff, TIFFTAG_COLORMAP, &reader->palette[0], &reader->palette[1],
                                              &reader->palette[2])) {
            return refuse(reader, "a palette, but no colours for it, at a bit depth of", reader->bits);
        }
        return MT_OK;
    default:
        return refuse(reader, "photometric interpretation", reader->photometric);
    }
}

static mt_status check_samples(tiff_reader *reader)
{
    bool is_float = reader->sample_format == SAMPLEFORMAT_IEEEFP;
    bool is_whole = reader->sample_format == SAMPLEFORMAT_UINT || reader->sample_format == SAMPLEFORMAT_VOID;
    uint16_t bits = reader->bits, orientation = ORIENTATION_TOPLEFT;
    bool is_known = (is_whole && (bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16)) ||
                    (is_float && (bits == 32 || bits == 64));
    if (!is_float && !is_whole) {
        return refuse(reader, "sample format", reader->sample_format);
    }
    if (!is_known) {
        return refuse(reader, is_float ? "a float bit depth of" : "a bit depth of", bits);
    }
    TIFFGetFieldDefaulted(reader->tiff, TIFFTAG_ORIENTATION, &orientation);
    if (orientation != ORIENTATION_TOPLEFT) {
        return refuse(reader, "orientation", orientation);
    }
    return reader->sample_count < reader->color_count ? refuse(reader, "a sample count of", reader->sample_count)
                                                      : MT_OK;
}

/* The first sample past the colours may be alpha; all others are left out, and that is said. */
static void find_alpha(tiff_reader *reader)
{
    uint16_t count = 0, *kinds = NULL;
    uint32_t extra = reader->sample_count - reader->color_count;
    TIFFGetFieldDefaulted(reader->tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds);
    if (extra > 0 && count > 0) {
        reader->is_premultiplied = kinds[0] == EXTRASAMPLE_ASSOCALPHA;
        reader->has_alpha = reader->is_premultiplied || kinds[0] == EXTRASAMPLE_UNASSALPHA;
    }
    if (extra > (reader->has_alpha ? 1u : 0u)) {
        mt_warn(reader->context, "%s: %u channels that are neither colour nor alpha are left out",
                mt_input_name(reader->input), extra - (reader->has_alpha ? 1u : 0u));
    }
}

/* How many bytes one byte of the file can become at most. */
static uint64_t expansion(uint16_t compression)
{
    static const struct {
        uint16_t compression;
        uint16_t ratio;
    } ratios[] = {{COMPRESSION_NONE, 1},
                  {COMPRESSION_PACKBITS, 64},
                  {COMPRESSION_LZW, 2800},
                  {COMPRESSION_DEFLATE, 1032},
                  {COMPRESSION_ADOBE_DEFLATE, 1032}};
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++) {
        if (ratios[i].compression == compression) {
            return ratios[i].ratio;
        }
    }
    return 32768; /* blank rows of faxes, runs of zstd */
}

static mt_status measure_blocks(tiff_reader *reader)
{
    if (TIFFIsTiled(reader->tiff)) {
        TIFFGetField(reader->tiff, TIFFTAG_TILEWIDTH, &reader->block_width);
        TIFFGetField(reader->tiff, TIFFTAG_TILELENGTH, &reader->block_height);
        reader->block_size = TIFFTileSize64(reader->tiff);
        reader->row_size = TIFFTileRowSize64(reader->tiff);
    } else {
        TIFFGetFieldDefaulted(reader->tiff, TIFFTAG_ROWSPERSTRIP, &reader->block_height);
        reader->block_width = reader->width;
        reader->block_height = reader->block_height < reader->height ? reader->block_height : reader->height;
        reader->block_size = TIFFStripSize64(reader->tiff);
        reader->row_size = TIFFScanlineSize64(reader->tiff);
    }
    uint64_t apart = reader->planes == PLANARCONFIG_SEPARATE ? 1 : reader->sample_count;
    uint64_t row = ((uint64_t)reader->block_width * apart * reader->bits + 7) / 8;
    bool is_sound = reader->block_width && reader->block_height && reader->row_size >= row &&
                    reader->block_size / reader->block_height >= row && reader->block_size <= PTRDIFF_MAX / 2;
    return is_sound ? MT_OK : fail_in_tiff(reader);
}

static mt_status check_header(tiff_reader *reader)
{
    get_fields(reader);
    mt_status status = mt_picture_check_size(reader->context, reader->input, reader->width, reader->height);
    if (status == MT_OK) {
        status = check_photometric(reader);
    }
    if (status == MT_OK) {
        status = check_samples(reader);
    }
    if (status == MT_OK) {
        status = measure_blocks(reader);
    }
    if (status != MT_OK) {
        return status;
    }
    find_alpha(reader);
    uint64_t row = ((uint64_t)reader->width * reader->sample_count * reader->bits + 7) / 8,
             ratio = expansion(reader->compression);
    status = mt_picture_check_bytes(reader->context, reader->input, reader->file.size, row * reader->height / ratio);
    /* A block larger than the picture is decoded whole. */
    return status == MT_OK ? mt_picture_check_bytes(reader->context, reader->input, reader->file.size,
                                                    reader->block_size / (ratio > 1 ? ratio : 64))
                           : status;
}

static double sample_at(const tiff_reader *reader, const uint8_t *row, size_t i)
{
    if (reader->bits == 32) {
        float value;
        memcpy(&value, row + 4 * i, sizeof value);
        return (double)value;
    }
    if (reader->bits == 64) {
        double value;
        memcpy(&value, row + 8 * i, sizeof value);
        return value;
    }
    uint16_t word = 0;
    if (reader->bits == 16) {
        memcpy(&word, row + 2 * i, sizeof word); /* libtiff gives them in the machine's order */
        return word / 65535.0;
    }
    return mt_sample_at(row, reader->bits, i) / (double)((1u << reader->bits) - 1u);
}

static void put_color(const tiff_reader *reader, const uint8_t *row, size_t i, float *pixel)
{
    uint32_t index = mt_sample_at(row, reader->bits, i);
    for (int k = 0; k < 3; k++) {
        pixel[k] = (float)(reader->palette[k][index] / 65535.0);
    }
}

/* Which channel of the picture a sample becomes; at least the picture's channels: none. */
static uint32_t channel_of(const tiff_reader *reader, uint32_t sample)
{
    bool is_color = sample < reader->color_count;
    bool is_alpha = reader->has_alpha && sample == reader->color_count;
    return is_color ? sample : is_alpha ? 3 : 4;
}

static void put_sample(const tiff_reader *reader, const uint8_t *row, size_t i, uint32_t channel, float *pixel)
{
    if (channel == 0 && reader->palette[0]) {
        put_color(reader, row, i, pixel);
        return;
    }
    double value = sample_at(reader, row, i);
    bool is_inverted = reader->photometric == PHOTOMETRIC_MINISWHITE && channel == 0;
    pixel[channel] = (float)(is_inverted ? 1.0 - value : value);
    if (channel == 0 && reader->color_count == 1 && reader->image->channel_count == 4) {
        pixel[1] = pixel[2] = pixel[0];
    }
}

/* A row of a block: `count` samples a pixel, of which the first is number `first` of the picture's. */
static void put_row(const tiff_reader *reader, const uint8_t *row, uint32_t x, uint32_t y, uint32_t first,
                    uint32_t count)
{
    uint32_t width = reader->width - x < reader->block_width ? reader->width - x : reader->block_width;
    float *pixel = mt_image_pixel(reader->image, x, y);
    for (uint32_t i = 0; i < width; i++, pixel += reader->image->channel_count) {
        for (uint32_t k = 0; k < count; k++) {
            uint32_t channel = channel_of(reader, first + k);
            if (channel < 4) {
                put_sample(reader, row, (size_t)i * count + k, channel, pixel);
            }
        }
    }
}

static mt_status read_block(tiff_reader *reader, uint32_t x, uint32_t y, uint32_t plane)
{
    bool is_tiled = TIFFIsTiled(reader->tiff), is_apart = reader->planes == PLANARCONFIG_SEPARATE;
    uint32_t rows = reader->height - y < reader->block_height ? reader->height - y : reader->block_height;
    uint64_t needed = is_tiled ? reader->block_size : reader->row_size * rows;
    tmsize_t got;
    if (is_tiled) {
        uint32_t tile = TIFFComputeTile(reader->tiff, x, y, 0, (uint16_t)plane);
        got = TIFFReadEncodedTile(reader->tiff, tile, reader->block, (tmsize_t)reader->block_size);
    } else {
        uint32_t strip = TIFFComputeStrip(reader->tiff, y, (uint16_t)plane);
        got = TIFFReadEncodedStrip(reader->tiff, strip, reader->block, (tmsize_t)needed);
    }
    if (got < 0 || (uint64_t)got < needed) {
        return fail_in_tiff(reader);
    }
    for (uint32_t row = 0; row < rows; row++) {
        put_row(reader, reader->block + row * reader->row_size, x, y + row, is_apart ? plane : 0,
                is_apart ? 1 : reader->sample_count);
    }
    return MT_OK;
}

static mt_status read_blocks(tiff_reader *reader)
{
    uint32_t planes = reader->planes == PLANARCONFIG_SEPARATE ? reader->sample_count : 1;
    mt_status status = MT_OK;
    for (uint64_t y = 0; y < reader->height && status == MT_OK; y += reader->block_height) {
        for (uint64_t x = 0; x < reader->width && status == MT_OK; x += reader->block_width) {
            for (uint32_t plane = 0; plane < planes && status == MT_OK; plane++) {
                status = read_block(reader, (uint32_t)x, (uint32_t)y, plane);
            }
        }
        if (status == MT_OK) {
            status = mt_progress(reader->context, "reading the picture", (double)y / reader->height);
        }
    }
    return status;
}

/* The picture's numbers are not premultiplied; a colour that is all transparent is 0. */
static void unpremultiply(mt_image *image)
{
    size_t count = (size_t)image->width * image->height;
    for (float *pixel = image->pixels; count > 0; count--, pixel += 4) {
        for (int k = 0; k < 3; k++) {
            pixel[k] = pixel[3] > 0.0F ? pixel[k] / pixel[3] : 0.0F;
        }
    }
}

static mt_status read_picture(tiff_reader *reader)
{
    mt_status status = check_header(reader);
    bool is_grey = reader->color_count == 1 && !reader->palette[0];
    if (status == MT_OK) {
        status = mt_image_create(reader->context, reader->width, reader->height,
                                 reader->has_alpha ? 4
                                 : is_grey         ? 1
                                                   : 3,
                                 &reader->image);
    }
    if (status == MT_OK) {
        reader->block = mt_allocate_zeroed(reader->context, reader->block_size);
        status = reader->block ? read_blocks(reader) : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK && reader->is_premultiplied) {
        unpremultiply(reader->image);
    }
    mt_free(reader->context, reader->block);
    return status;
}

mt_status mt_tiff_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits)
{
    tiff_reader reader = {.context = context, .input = input, .file = {.context = context}};
    size_t size = 0;
    mt_status status = mt_picture_take_rest(context, input, &reader.file.bytes, &size);
    reader.file.size = size;
    uint64_t held = DECODER_BYTES + 2 * (uint64_t)size; /* a strip as it is in the file, and tags */
    if (status == MT_OK) {
        status = mt_hold_bytes(context, held);
        held = status == MT_OK ? held : 0;
    }
    if (status == MT_OK) {
        reader.tiff = mt_tiff_open(&reader.file, "rm", held);
        status = reader.tiff ? read_picture(&reader) : fail_in_tiff(&reader);
        mt_release_bytes(context, held);
    }
    if (status == MT_OK && !TIFFLastDirectory(reader.tiff)) {
        mt_warn(context, "%s: of several pictures only the first is read", mt_input_name(input));
    }
    if (reader.tiff) {
        TIFFClose(reader.tiff);
    }
    mt_free(context, reader.file.bytes);
    *out = reader.image;
    *bits = reader.bits;
    return status;
}

int mt_tiff_sniff(const uint8_t *bytes, size_t size)
{
    static const char *const magics[] = {"II*\0", "MM\0*", "II+\0", "MM\0+"};
    for (size_t i = 0; i < 4 && size >= 4; i++) {
        if (memcmp(bytes, magics[i], 4) == 0) {
            return 95;
        }
    }
    return 0;
}
#endif
