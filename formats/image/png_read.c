/* Reading PNG by libspng: every depth and kind of colour as it is stored, palettes looked up, transparent colours made
 * an alpha channel. Sums of chunks are checked; so is that the file has bytes enough for its size, before anything is
 * allocated for it. */
#include "formats/image/image_format.h"

#ifdef MESHTOOL_PNG
#include "formats/image/samples.h"

#include <errno.h>
#include <spng.h>
#include <string.h>

#define DEFLATE_RATIO 1032                  /* no byte of deflate makes more than so many */
#define DECODER_BYTES ((uint64_t)256 << 10) /* of libspng and zlib, besides rows and chunks */
#define CHUNK_CACHE ((uint64_t)16 << 20)    /* most bytes of side chunks, expanded, that are kept */

typedef struct png_reader {
    mt_context *context;
    mt_input *input;
    spng_ctx *png;
    struct spng_ihdr header;
    struct spng_plte palette;
    struct spng_trns transparency;
    bool has_palette, has_transparency;
    mt_status status; /* of the input */
    bool is_cut;      /* it ended where more was wanted */
    mt_sample_layout layout;
    uint32_t channel_count; /* of the picture */
    size_t row_size;
    uint64_t cache; /* bytes of side chunks that libspng may keep */
} png_reader;

static int read_stream(spng_ctx *png, void *user, void *bytes, size_t size)
{
    (void)png;
    png_reader *reader = (png_reader *)user;
    size_t got = 0;
    reader->status = mt_input_read(reader->context, reader->input, bytes, size, &got);
    reader->is_cut = reader->is_cut || got < size;
    return reader->status != MT_OK ? SPNG_IO_ERROR : got < size ? SPNG_IO_EOF : 0;
}

static mt_status check(png_reader *reader, int error)
{
    if (error == 0 || error == SPNG_EOI) {
        return MT_OK;
    }
    if (reader->status != MT_OK) {
        return reader->status;
    }
    mt_place place = mt_input_place_offset(reader->input, mt_input_offset(reader->input));
    if (error == SPNG_EMEM || errno == ENOMEM) { /* zlib's want of memory has no code of its own */
        return mt_fail_at(reader->context, MT_ERROR_OUT_OF_MEMORY, place, "no memory for the PNG decoder");
    }
    if (error == SPNG_ECHUNK_LIMITS) {
        return mt_fail_at(reader->context, MT_ERROR_TOO_LARGE, place,
                          "what is written beside the picture expands to more than %llu bytes",
                          (unsigned long long)reader->cache);
    }
    if (error == SPNG_IO_EOF) {
        return mt_fail_at(reader->context, MT_ERROR_SYNTAX, place, "the file ends here, expected more of the picture");
    }
    return mt_fail_at(reader->context, MT_ERROR_SYNTAX, place, "the PNG data is damaged: %s", spng_strerror(error));
}

static const uint8_t channels_of_type[] = {[SPNG_COLOR_TYPE_GRAYSCALE] = 1,
                                           [SPNG_COLOR_TYPE_TRUECOLOR] = 3,
                                           [SPNG_COLOR_TYPE_INDEXED] = 1,
                                           [SPNG_COLOR_TYPE_GRAYSCALE_ALPHA] = 2,
                                           [SPNG_COLOR_TYPE_TRUECOLOR_ALPHA] = 4};

/* Everything that the header and the chunks before the pixels say. */
static mt_status read_header(png_reader *reader)
{
    mt_status status = check(reader, spng_get_ihdr(reader->png, &reader->header));
    if (status == MT_OK) {
        status = mt_picture_check_size(reader->context, reader->input, reader->header.width, reader->header.height);
    }
    if (status != MT_OK) {
        return status;
    }
    reader->layout.bits = reader->header.bit_depth;
    reader->layout.maximum = (1u << reader->layout.bits) - 1u;
    reader->layout.channel_count = channels_of_type[reader->header.color_type];
    reader->row_size = (size_t)mt_sample_row_size(&reader->layout, reader->header.width);
    uint64_t needed = reader->row_size * (uint64_t)reader->header.height / DEFLATE_RATIO;
    return mt_picture_check_bytes(reader->context, reader->input, mt_input_size(reader->input), needed);
}

static mt_status read_colors(png_reader *reader)
{
    int error = spng_get_plte(reader->png, &reader->palette);
    reader->has_palette = error == 0;
    if (error != 0 && error != SPNG_ECHUNKAVAIL) {
        return check(reader, error);
    }
    error = spng_get_trns(reader->png, &reader->transparency);
    reader->has_transparency = error == 0;
    if (error != 0 && error != SPNG_ECHUNKAVAIL) {
        return check(reader, error);
    }
    bool is_indexed = reader->header.color_type == SPNG_COLOR_TYPE_INDEXED;
    uint32_t colors = is_indexed ? 3 : mt_sample_channels(&reader->layout);
    reader->channel_count = reader->has_transparency ? 4 : colors;
    return MT_OK;
}

static mt_status fill_indexed(png_reader *reader, const uint8_t *row, mt_image *image, uint32_t y)
{
    float *pixel = mt_image_pixel(image, 0, y);
    for (uint32_t x = 0; x < image->width; x++, pixel += image->channel_count) {
        uint32_t index = mt_sample_at(row, reader->layout.bits, x);
        if (index >= reader->palette.n_entries) {
            return mt_fail_at(reader->context, MT_ERROR_SYNTAX,
                              mt_input_place_offset(reader->input, mt_input_offset(reader->input)),
                              "a pixel has colour %u of a palette of %u", index, reader->palette.n_entries);
        }
        const struct spng_plte_entry *entry = &reader->palette.entries[index];
        pixel[0] = (float)(entry->red / 255.0);
        pixel[1] = (float)(entry->green / 255.0);
        pixel[2] = (float)(entry->blue / 255.0);
        if (image->channel_count == 4) {
            bool is_listed = index < reader->transparency.n_type3_entries;
            pixel[3] = is_listed ? (float)(reader->transparency.type3_alpha[index] / 255.0) : 1.0F;
        }
    }
    return MT_OK;
}

/* Pixels of one colour are transparent, all others are not. */
static void fill_keyed(const png_reader *reader, const uint8_t *row, mt_image *image, uint32_t y)
{
    const struct spng_trns *key = &reader->transparency;
    uint32_t count = reader->layout.channel_count, mask = reader->layout.maximum;
    const uint32_t keys[3] = {(count == 1 ? key->gray : key->red) & mask, key->green & mask, key->blue & mask};
    float *pixel = mt_image_pixel(image, 0, y);
    for (uint32_t x = 0; x < image->width; x++, pixel += 4) {
        bool is_key = true;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t channel = count == 1 ? 0 : k;
            uint32_t sample = mt_sample_at(row, reader->layout.bits, (size_t)x * count + channel);
            is_key = is_key && sample == keys[channel];
            pixel[k] = (float)((double)sample / reader->layout.maximum);
        }
        pixel[3] = is_key ? 0.0F : 1.0F;
    }
}

static mt_status fill_row(png_reader *reader, const uint8_t *row, mt_image *image, uint32_t y)
{
    if (reader->header.color_type == SPNG_COLOR_TYPE_INDEXED) {
        return fill_indexed(reader, row, image, y);
    }
    if (reader->has_transparency) {
        fill_keyed(reader, row, image, y);
    } else {
        mt_sample_fill_row(&reader->layout, row, image, y);
    }
    return MT_OK;
}

/* libspng does not mind a last chunk that is cut short. */
static mt_status read_end(png_reader *reader)
{
    if (reader->is_cut) {
        return check(reader, SPNG_IO_EOF);
    }
    uint64_t rest = mt_input_size(reader->input) - mt_input_offset(reader->input);
    mt_picture_warn_of_rest(reader->context, reader->input, rest);
    return MT_OK;
}

/* Row by row; interlaced pictures at once, as their rows are ready at the end only. */
static mt_status read_rows(png_reader *reader, mt_image *image)
{
    bool is_interlaced = reader->header.interlace_method != 0;
    uint32_t held = is_interlaced ? image->height : 1;
    size_t size = reader->row_size * held;
    /* Zeros: libspng adds the samples of an interlaced row to what is there when several share a byte. */
    uint8_t *rows = mt_allocate_array_zeroed(reader->context, held, reader->row_size);
    if (!rows) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    int flags = is_interlaced ? 0 : SPNG_DECODE_PROGRESSIVE;
    int error =
        spng_decode_image(reader->png, is_interlaced ? rows : NULL, is_interlaced ? size : 0, SPNG_FMT_RAW, flags);
    mt_status status = check(reader, error);
    for (uint32_t y = 0; y < image->height && status == MT_OK; y++) {
        if (!is_interlaced) {
            status = check(reader, spng_decode_row(reader->png, rows, size));
        }
        if (status == MT_OK) {
            status = fill_row(reader, is_interlaced ? rows + y * reader->row_size : rows, image, y);
        }
        if (status == MT_OK && y % 256 == 0) {
            status = mt_progress(reader->context, "reading the picture", (double)y / image->height);
        }
    }
    mt_free(reader->context, rows);
    if (status == MT_OK) {
        status = check(reader, spng_decode_chunks(reader->png));
    }
    return status == MT_OK ? read_end(reader) : status;
}

static mt_status read_picture(png_reader *reader, mt_image **out)
{
    int error = spng_set_png_stream(reader->png, read_stream, reader);
    error = error ? error : spng_set_chunk_limits(reader->png, reader->cache, reader->cache);
    mt_status status = check(reader, error);
    if (status == MT_OK) {
        status = read_header(reader);
    }
    if (status == MT_OK) {
        status = read_colors(reader);
    }
    if (status == MT_OK) {
        status = mt_image_create_unfilled(reader->context, reader->header.width, reader->header.height,
                                          reader->channel_count, out);
    }
    return status == MT_OK ? read_rows(reader, *out) : status;
}

#define CHUNK_RECORD 1088 /* bytes that libspng keeps of a chunk beside what stands in it; a palette takes most */

/* What the side chunks may become: most are kept as they are with a record each, profiles and texts may be deflated,
 * and the room for those doubles as it grows. */
static uint64_t bound_side_chunks(const mt_input *input)
{
    static const char *const deflated[] = {"iCCP", "zTXt", "iTXt"};
    uint64_t size = mt_input_size(input), bound = 0;
    uint8_t head[8];
    for (uint64_t at = 8; at < size && mt_input_read_at(input, at, head, sizeof head) == sizeof head;) {
        uint64_t length = (uint64_t)head[0] << 24 | (uint64_t)head[1] << 16 | (uint64_t)head[2] << 8 | head[3];
        bound += memcmp(head + 4, "IDAT", 4) == 0 ? 0 : length + CHUNK_RECORD;
        for (size_t i = 0; i < sizeof deflated / sizeof deflated[0]; i++) {
            bound += memcmp(head + 4, deflated[i], 4) == 0 ? 2 * length * DEFLATE_RATIO : 0;
        }
        at += length + sizeof head + 4;
    }
    return bound < CHUNK_CACHE ? bound : CHUNK_CACHE;
}

mt_status mt_png_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits)
{
    png_reader reader = {.context = context, .input = input};
    mt_status status = mt_input_collect(context, input);
    if (status != MT_OK) {
        return status;
    }
    /* Two rows, and the side chunks. */
    reader.cache = bound_side_chunks(input);
    uint64_t held = DECODER_BYTES + 2 * mt_input_size(input) + reader.cache;
    status = mt_hold_bytes(context, held);
    if (status != MT_OK) {
        return status;
    }
    errno = 0;
    reader.png = spng_ctx_new(0);
    if (reader.png) {
        status = read_picture(&reader, out);
        *bits = reader.header.bit_depth;
        spng_ctx_free(reader.png);
    } else {
        status = mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory for the PNG decoder");
    }
    mt_release_bytes(context, held);
    return status;
}

int mt_png_sniff(const uint8_t *bytes, size_t size)
{
    return size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0 ? 100 : 0;
}
#endif
