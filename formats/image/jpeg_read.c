/* Reading JPEG by libjpeg-turbo: grey and colour of 8 bits. Pixels that it would make up where data is missing or
 * damaged are an error. Its memory is its own, so what it may take is held against the limit beforehand. */
#include "formats/image/image_format.h"

#ifdef MESHTOOL_JPEG
#include "formats/image/jpeg_errors.h"
#include "formats/image/jpeg_orientation.h"
#include "formats/image/samples.h"

#include <string.h>

#define SOURCE_SIZE ((size_t)32 << 10)
#define DECODER_BYTES ((uint64_t)1 << 20)
#define SCAN_LIMIT 500 /* progressive files have about ten; thousands cost hours */
/* A block of 64 pixels takes a bit or more of Huffman codes; arithmetic coding may go some way below. */
#define PIXELS_PER_BYTE 8192

typedef struct jpeg_reader {
    struct jpeg_decompress_struct decoder;
    struct jpeg_source_mgr source;
    struct jpeg_progress_mgr progress;
    mt_jpeg_errors errors;
    mt_context *context;
    mt_input *input;
    mt_image *image;
    uint8_t *row;
    uint64_t held;
    JOCTET buffer[SOURCE_SIZE];
} jpeg_reader;

static jpeg_reader *reader_of(j_decompress_ptr decoder)
{
    return (jpeg_reader *)decoder->client_data;
}

static void nothing(j_decompress_ptr decoder)
{
    (void)decoder;
}

static void fail_in_file(jpeg_reader *reader, mt_status status, const char *sentence)
{
    uint64_t at = mt_input_offset(reader->input) - reader->source.bytes_in_buffer;
    mt_status failure = mt_fail_at(reader->context, status, mt_input_place_offset(reader->input, at), "%s", sentence);
    mt_jpeg_leave(&reader->errors, failure);
}

static boolean fill_buffer(j_decompress_ptr decoder)
{
    jpeg_reader *reader = reader_of(decoder);
    size_t got = 0;
    mt_status status = mt_input_read(reader->context, reader->input, reader->buffer, SOURCE_SIZE, &got);
    if (status != MT_OK) {
        mt_jpeg_leave(&reader->errors, status);
    }
    reader->source.next_input_byte = reader->buffer;
    reader->source.bytes_in_buffer = got;
    if (got == 0) {
        fail_in_file(reader, MT_ERROR_SYNTAX, "the file ends here, expected more of the picture");
    }
    return TRUE;
}

static void skip_bytes(j_decompress_ptr decoder, long count)
{
    struct jpeg_source_mgr *source = decoder->src;
    while (count > 0 && (size_t)count > source->bytes_in_buffer) {
        count -= (long)source->bytes_in_buffer;
        fill_buffer(decoder);
    }
    if (count > 0) {
        source->next_input_byte += count;
        source->bytes_in_buffer -= (size_t)count;
    }
}

static void watch_scans(j_common_ptr common)
{
    jpeg_reader *reader = (jpeg_reader *)common->client_data;
    if (reader->decoder.input_scan_number > SCAN_LIMIT) {
        fail_in_file(reader, MT_ERROR_TOO_LARGE, "the picture has more than 500 scans");
    }
}

static void prepare(jpeg_reader *reader)
{
    reader->decoder.err = mt_jpeg_errors_init(&reader->errors);
    reader->decoder.client_data = reader;
    jpeg_create_decompress(&reader->decoder);
    reader->decoder.client_data = reader;
    reader->source.init_source = nothing;
    reader->source.fill_input_buffer = fill_buffer;
    reader->source.skip_input_data = skip_bytes;
    reader->source.resync_to_restart = jpeg_resync_to_restart;
    reader->source.term_source = nothing;
    reader->decoder.src = &reader->source;
    reader->progress.progress_monitor = watch_scans;
    reader->decoder.progress = &reader->progress;
}

/* What the decoder allocates: strips of rows, and for several scans all coefficients. */
static uint64_t decoder_bytes(const struct jpeg_decompress_struct *decoder)
{
    uint64_t width = decoder->image_width + 64u, height = decoder->image_height + 64u;
    uint64_t channels = (uint64_t)decoder->num_components;
    uint64_t rows = jpeg_has_multiple_scans((j_decompress_ptr)decoder) ? height : 0;
    return DECODER_BYTES + width * channels * (64 + 2 * rows);
}

static mt_status begin(jpeg_reader *reader)
{
    struct jpeg_decompress_struct *decoder = &reader->decoder;
    jpeg_read_header(decoder, TRUE);
    mt_status status =
        mt_picture_check_size(reader->context, reader->input, decoder->image_width, decoder->image_height);
    uint64_t pixels = (uint64_t)decoder->image_width * decoder->image_height;
    if (status == MT_OK) {
        status = mt_picture_check_bytes(reader->context, reader->input, mt_input_size(reader->input),
                                        pixels / PIXELS_PER_BYTE);
    }
    if (status != MT_OK) {
        return status;
    }
    bool is_grey = decoder->jpeg_color_space == JCS_GRAYSCALE;
    if (!is_grey && decoder->jpeg_color_space != JCS_YCbCr && decoder->jpeg_color_space != JCS_RGB) {
        fail_in_file(reader, MT_ERROR_UNSUPPORTED, "the picture is neither grey nor RGB (CMYK is not read)");
    }
    decoder->out_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
    uint64_t bytes = decoder_bytes(decoder);
    status = mt_hold_bytes(reader->context, bytes);
    reader->held += status == MT_OK ? bytes : 0;
    return status;
}

static mt_status read_rows(jpeg_reader *reader)
{
    struct jpeg_decompress_struct *decoder = &reader->decoder;
    mt_sample_layout layout = {.bits = 8, .channel_count = decoder->out_color_space == JCS_RGB ? 3 : 1, .maximum = 255};
    mt_status status = mt_image_create_unfilled(reader->context, decoder->image_width, decoder->image_height,
                                                layout.channel_count, &reader->image);
    if (status == MT_OK) {
        reader->row = mt_allocate_array(reader->context, decoder->image_width, layout.channel_count);
        status = reader->row ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status != MT_OK) {
        return status;
    }
    jpeg_start_decompress(decoder);
    while (decoder->output_scanline < decoder->output_height && status == MT_OK) {
        uint32_t y = decoder->output_scanline;
        JSAMPROW rows[1] = {reader->row};
        jpeg_read_scanlines(decoder, rows, 1);
        mt_sample_fill_row(&layout, reader->row, reader->image, y);
        status =
            y % 256 ? MT_OK : mt_progress(reader->context, "reading the picture", (double)y / reader->image->height);
    }
    if (status == MT_OK) {
        jpeg_finish_decompress(decoder);
    }
    return status;
}

/* All calls of libjpeg are below this one, and return here by a jump when they fail. */
static mt_status decode(jpeg_reader *reader)
{
    if (setjmp(reader->errors.place) != 0) {
        if (reader->errors.status == MT_ERROR_OUT_OF_MEMORY) {
            return mt_fail(reader->context, MT_ERROR_OUT_OF_MEMORY, "no memory for the JPEG decoder");
        }
        if (reader->errors.status != MT_OK) {
            return reader->errors.status;
        }
        uint64_t at = mt_input_offset(reader->input) - reader->source.bytes_in_buffer;
        return mt_fail_at(reader->context, MT_ERROR_SYNTAX, mt_input_place_offset(reader->input, at),
                          "the JPEG data is damaged: %s", reader->errors.message);
    }
    prepare(reader);
    mt_status status = begin(reader);
    return status == MT_OK ? read_rows(reader) : status;
}

/* What the file holds and the picture does not. */
static void warn_of_the_rest(const jpeg_reader *reader)
{
    unsigned turn = mt_jpeg_orientation(reader->input);
    uint64_t end = mt_input_offset(reader->input) - reader->source.bytes_in_buffer;
    if (turn != 1) {
        mt_warn(reader->context, "%s: Exif orientation %u is not applied; the picture is read as it is stored",
                mt_input_name(reader->input), turn);
    }
    mt_picture_warn_of_rest(reader->context, reader->input, mt_input_size(reader->input) - end);
}

mt_status mt_jpeg_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits)
{
    mt_status status = mt_input_collect(context, input);
    if (status == MT_OK) {
        status = mt_hold_bytes(context, DECODER_BYTES);
    }
    if (status != MT_OK) {
        return status;
    }
    jpeg_reader *reader = mt_allocate_zeroed(context, sizeof *reader);
    if (!reader) {
        mt_release_bytes(context, DECODER_BYTES);
        return MT_ERROR_OUT_OF_MEMORY;
    }
    reader->context = context;
    reader->input = input;
    reader->held = DECODER_BYTES;
    status = decode(reader);
    if (status == MT_OK) {
        warn_of_the_rest(reader);
    }
    jpeg_destroy_decompress(&reader->decoder);
    mt_release_bytes(context, reader->held);
    *out = reader->image;
    *bits = 8;
    mt_free(context, reader->row);
    mt_free(context, reader);
    return status;
}

int mt_jpeg_sniff(const uint8_t *bytes, size_t size)
{
    return size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0 ? 100 : 0;
}
#endif
