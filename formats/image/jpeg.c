/* JPEG by libjpeg-turbo: 8 bits, grey or colour, full colour resolution from quality 90 on and half below it. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#ifdef MESHTOOL_JPEG
#include "formats/image/jpeg_errors.h"

#define DEFAULT_QUALITY 90
#define FULL_COLOR_QUALITY 90
#define ENCODER_BYTES ((uint64_t)1 << 20)
#define PIECE_SIZE ((size_t)32 << 10)

typedef struct jpeg_writer {
    struct jpeg_compress_struct encoder;
    struct jpeg_destination_mgr destination;
    mt_jpeg_errors errors;
    mt_context *context;
    mt_output *output;
    size_t row_size;
    JOCTET piece[PIECE_SIZE];
} jpeg_writer;

static void begin_piece(j_compress_ptr encoder)
{
    jpeg_writer *writer = (jpeg_writer *)encoder->client_data;
    writer->destination.next_output_byte = writer->piece;
    writer->destination.free_in_buffer = PIECE_SIZE;
}

static void send(jpeg_writer *writer, size_t size)
{
    mt_status status = mt_output_write(writer->context, writer->output, writer->piece, size);
    if (status != MT_OK) {
        mt_jpeg_leave(&writer->errors, status);
    }
}

static boolean send_piece(j_compress_ptr encoder)
{
    send((jpeg_writer *)encoder->client_data, PIECE_SIZE);
    begin_piece(encoder);
    return TRUE;
}

static void send_last(j_compress_ptr encoder)
{
    jpeg_writer *writer = (jpeg_writer *)encoder->client_data;
    send(writer, PIECE_SIZE - writer->destination.free_in_buffer);
}

static void begin(jpeg_writer *writer, const mt_image *image, int quality)
{
    struct jpeg_compress_struct *encoder = &writer->encoder;
    encoder->err = mt_jpeg_errors_init(&writer->errors);
    jpeg_create_compress(encoder);
    encoder->client_data = writer;
    writer->destination.init_destination = begin_piece;
    writer->destination.empty_output_buffer = send_piece;
    writer->destination.term_destination = send_last;
    encoder->dest = &writer->destination;
    encoder->image_width = image->width;
    encoder->image_height = image->height;
    encoder->input_components = (int)image->channel_count;
    encoder->in_color_space = image->channel_count == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(encoder);
    encoder->dct_method = JDCT_ISLOW; /* whole numbers: the same on every machine */
    jpeg_set_quality(encoder, quality, TRUE);
    if (quality >= FULL_COLOR_QUALITY) {
        encoder->comp_info[0].h_samp_factor = 1;
        encoder->comp_info[0].v_samp_factor = 1;
    }
    jpeg_start_compress(encoder, TRUE);
}

static mt_status check(const jpeg_writer *writer)
{
    if (writer->errors.status != MT_OK && writer->errors.status != MT_ERROR_OUT_OF_MEMORY) {
        return writer->errors.status;
    }
    mt_status status = writer->errors.status == MT_OK ? MT_ERROR_UNSUPPORTED : MT_ERROR_OUT_OF_MEMORY;
    return mt_fail(writer->context, status, "the picture cannot be written as JPEG: %s", writer->errors.message);
}

static mt_status start(jpeg_writer *writer, const mt_image *image, int quality)
{
    if (setjmp(writer->errors.place) != 0) {
        return check(writer);
    }
    begin(writer, image, quality);
    return MT_OK;
}

static mt_status write_rows(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count)
{
    (void)context;
    jpeg_writer *writer = (jpeg_writer *)user;
    if (setjmp(writer->errors.place) != 0) {
        return check(writer);
    }
    for (uint32_t row = 0; row < row_count; row++) {
        JSAMPROW rows[1] = {(JSAMPROW)(bytes + row * writer->row_size)};
        jpeg_write_scanlines(&writer->encoder, rows, 1);
    }
    return MT_OK;
}

static mt_status finish(jpeg_writer *writer)
{
    if (setjmp(writer->errors.place) != 0) {
        return check(writer);
    }
    jpeg_finish_compress(&writer->encoder);
    return MT_OK;
}

static mt_status write_with(jpeg_writer *writer, const mt_image *image, int quality)
{
    mt_status status = start(writer, image, quality);
    if (status == MT_OK) {
        status = mt_image_write_bands(writer->context, image, 8, write_rows, writer);
    }
    if (status == MT_OK) {
        status = finish(writer);
    }
    jpeg_destroy_compress(&writer->encoder);
    return status;
}

static mt_status check_request(mt_context *context, const mt_image *image)
{
    if (image->channel_count == 4) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "JPEG holds no transparency: write .png or .tiff, or give a background");
    }
    return MT_OK;
}

static mt_status write_jpeg(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                            mt_output *output)
{
    uint64_t held = ENCODER_BYTES + (uint64_t)image->width * image->channel_count * 64;
    mt_status status = check_request(context, image);
    if (status == MT_OK) {
        status = mt_hold_bytes(context, held);
    }
    if (status != MT_OK) {
        return status;
    }
    jpeg_writer *writer = mt_allocate_zeroed(context, sizeof *writer);
    status = writer ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        writer->context = context;
        writer->output = output;
        writer->row_size = (size_t)image->width * image->channel_count;
        status = write_with(writer, image, options && options->quality ? (int)options->quality : DEFAULT_QUALITY);
    }
    mt_free(context, writer);
    mt_release_bytes(context, held);
    return status;
}

static const char *const extensions[] = {"jpg", "jpeg", NULL};

const mt_image_format mt_jpeg_format = {.name = "jpeg",
                                        .title = "JPEG",
                                        .extensions = extensions,
                                        .bits = {8},
                                        .has_quality = true,
                                        .sniff = mt_jpeg_sniff,
                                        .read = mt_jpeg_read,
                                        .write = write_jpeg};
#endif
