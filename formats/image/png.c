/* PNG (W3C, "Portable Network Graphics Specification", third edition), deflated by zlib in bands of rows, many at a
 * time: each band is a run of whole deflate blocks in a chunk of its own, so that together they are one stream, and the
 * same one whoever makes which. Every row is filtered as the difference to its left neighbour, and deflate looks for
 * runs alone: a drawn picture is smooth or flat, so that takes half the time of deflate's level 1 and gives smaller
 * files. Trying all five filters would cost more than deflate itself. */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#ifdef MESHTOOL_PNG
#include <string.h>
#include <zlib.h>

#define COMPRESSION_LEVEL 1
#define MEMORY_LEVEL 8
#define RAW_WINDOW (-15) /* no header and no trailer: the first chunk and the last hold those of the whole */

#define FILTER_SUB 1

/* Bytes of a band: more would leave threads idle, less would end too many blocks. */
#define BAND_SIZE (1u << 17)

/* Bands that are held before they are written. */
#define BANDS_PER_TURN 32

/* What a thread makes bands with. */
typedef struct png_press {
    z_stream stream;
    bool has_stream;
    unsigned char *row; /* encoded, not yet filtered */
    unsigned char *filtered, *deflated;
    bool taken; /* atomic */
} png_press;

/* A chunk, from its length to its checksum; NULL: memory was missing. */
typedef struct png_band {
    unsigned char *chunk;
    size_t size;
    uLong sum; /* Adler's, of the filtered rows */
    size_t filtered_size;
} png_band;

typedef struct png_writer {
    mt_context *context;
    const mt_image *image;
    const mt_image_encoder *encoder;
    mt_output *output;
    size_t row_size, pixel_size, bound;
    uint32_t band_height, band_count, first; /* first: of the turn */
    png_press *presses;                      /* one for each thread */
    unsigned press_count;
    png_band bands[BANDS_PER_TURN];
    uLong sum; /* of the whole so far */
} png_writer;

static void store_number(unsigned char *bytes, uint64_t number)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)(number >> (24 - 8 * i) & 255u);
    }
}

/* Puts the length, the name and the checksum around `size` bytes of data at chunk + 8; returns the size of all. */
static size_t close_chunk(unsigned char *chunk, const char *name, size_t size)
{
    store_number(chunk, size);
    memcpy(chunk + 4, name, 4);
    store_number(chunk + 8 + size, crc32(0, chunk + 4, (uInt)size + 4));
    return size + 12;
}

static voidpf take_memory(voidpf context, uInt count, uInt size)
{
    return mt_try_allocate((mt_context *)context, (uint64_t)count * size);
}

static void give_memory(voidpf context, voidpf block)
{
    mt_free((mt_context *)context, block);
}

static bool press_init(const png_writer *writer, png_press *press)
{
    size_t size = (writer->row_size + 1) * writer->band_height;
    press->stream.zalloc = take_memory;
    press->stream.zfree = give_memory;
    press->stream.opaque = writer->context;
    press->has_stream =
        deflateInit2(&press->stream, COMPRESSION_LEVEL, Z_DEFLATED, RAW_WINDOW, MEMORY_LEVEL, Z_RLE) == Z_OK;
    press->row = (unsigned char *)mt_try_allocate(writer->context, writer->row_size);
    press->filtered = (unsigned char *)mt_try_allocate(writer->context, size);
    press->deflated = (unsigned char *)mt_try_allocate(writer->context, writer->bound);
    return press->has_stream && press->row && press->filtered && press->deflated;
}

static void press_release(const png_writer *writer, png_press *press)
{
    if (press->has_stream) {
        deflateEnd(&press->stream);
    }
    mt_free(writer->context, press->row);
    mt_free(writer->context, press->filtered);
    mt_free(writer->context, press->deflated);
}

/* There are as many as threads, so one is free. */
static png_press *take_press(const png_writer *writer)
{
    for (unsigned i = 0;; i = i + 1 < writer->press_count ? i + 1 : 0) {
        if (!__atomic_exchange_n(&writer->presses[i].taken, true, __ATOMIC_ACQUIRE)) {
            return &writer->presses[i];
        }
    }
}

static void filter_row(const unsigned char *row, size_t row_size, size_t pixel_size, unsigned char *out)
{
    out[0] = FILTER_SUB;
    memcpy(out + 1, row, pixel_size);
    for (size_t i = pixel_size; i < row_size; i++) {
        out[1 + i] = (unsigned char)(row[i] - row[i - pixel_size]);
    }
}

static size_t filter_band(const png_writer *writer, png_press *press, uint32_t number)
{
    uint32_t first = number * writer->band_height, left = writer->image->height - first;
    uint32_t count = left < writer->band_height ? left : writer->band_height;
    size_t size = writer->row_size + 1;
    for (uint32_t row = 0; row < count; row++) {
        mt_image_encode_row(writer->encoder, first + row, press->row);
        filter_row(press->row, writer->row_size, writer->pixel_size, press->filtered + row * size);
    }
    return count * size;
}

static void make_band(const png_writer *writer, png_press *press, uint32_t number, png_band *band)
{
    static const unsigned char stream_header[] = {0x78, 0x01}; /* window of 32 kB, fastest */
    z_stream *stream = &press->stream;
    size_t head = number == 0 ? sizeof stream_header : 0;
    bool last = number + 1 == writer->band_count;
    band->filtered_size = filter_band(writer, press, number);
    band->sum = adler32(1, press->filtered, (uInt)band->filtered_size);
    deflateReset(stream);
    stream->next_in = press->filtered;
    stream->avail_in = (uInt)band->filtered_size;
    stream->next_out = press->deflated;
    stream->avail_out = (uInt)writer->bound;
    deflate(stream, last ? Z_FINISH : Z_SYNC_FLUSH);
    size_t size = writer->bound - stream->avail_out;
    band->chunk = (unsigned char *)mt_try_allocate(writer->context, head + size + 12);
    if (band->chunk) {
        memcpy(band->chunk + 8, stream_header, head);
        memcpy(band->chunk + 8 + head, press->deflated, size);
        band->size = close_chunk(band->chunk, "IDAT", head + size);
    }
}

static void make_bands(void *user, uint64_t begin, uint64_t end)
{
    png_writer *writer = (png_writer *)user;
    png_press *press = take_press(writer);
    for (uint64_t i = begin; i < end; i++) {
        make_band(writer, press, writer->first + (uint32_t)i, &writer->bands[i]);
    }
    __atomic_store_n(&press->taken, false, __ATOMIC_RELEASE);
}

static mt_status write_bands(png_writer *writer, uint32_t count)
{
    mt_status status = MT_OK;
    for (uint32_t i = 0; i < count; i++) {
        png_band *band = &writer->bands[i];
        if (status == MT_OK && !band->chunk) {
            status = mt_fail(writer->context, MT_ERROR_OUT_OF_MEMORY, "no memory left for a band of the PNG file");
        }
        if (status == MT_OK) {
            status = mt_output_write(writer->context, writer->output, band->chunk, band->size);
        }
        writer->sum = adler32_combine(writer->sum, band->sum, (z_off_t)band->filtered_size);
        mt_free(writer->context, band->chunk);
        band->chunk = NULL;
    }
    return status;
}

static mt_status write_all_bands(png_writer *writer)
{
    mt_status status = MT_OK;
    for (uint32_t first = 0; first < writer->band_count && status == MT_OK; first += BANDS_PER_TURN) {
        uint32_t left = writer->band_count - first, count = left < BANDS_PER_TURN ? left : BANDS_PER_TURN;
        writer->first = first;
        mt_parallel_for(writer->context, count, 1, make_bands, writer);
        status = write_bands(writer, count);
        if (status == MT_OK) {
            double done = (double)(first + count) / writer->band_count;
            status = mt_progress(writer->context, "writing the picture", done);
        }
    }
    return status;
}

static mt_status write_head(const png_writer *writer, unsigned bits)
{
    static const unsigned char signature[] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    static const unsigned char color_types[] = {0, 0, 0, 2, 6}; /* by channels: grey, colour, colour and alpha */
    unsigned char head[12 + 13], intent[12 + 1];
    memset(head, 0, sizeof head);
    store_number(head + 8, writer->image->width);
    store_number(head + 12, writer->image->height);
    head[16] = (unsigned char)bits;
    head[17] = color_types[writer->image->channel_count];
    intent[8] = 0; /* perceptual */
    close_chunk(head, "IHDR", 13);
    close_chunk(intent, "sRGB", 1);
    mt_status status = mt_output_write(writer->context, writer->output, signature, sizeof signature);
    status = status == MT_OK ? mt_output_write(writer->context, writer->output, head, sizeof head) : status;
    return status == MT_OK ? mt_output_write(writer->context, writer->output, intent, sizeof intent) : status;
}

static mt_status write_tail(const png_writer *writer)
{
    unsigned char sum[12 + 4], end[12];
    store_number(sum + 8, writer->sum);
    close_chunk(sum, "IDAT", 4);
    close_chunk(end, "IEND", 0);
    mt_status status = mt_output_write(writer->context, writer->output, sum, sizeof sum);
    return status == MT_OK ? mt_output_write(writer->context, writer->output, end, sizeof end) : status;
}

static mt_status make_presses(png_writer *writer)
{
    unsigned threads = mt_context_thread_count(writer->context);
    writer->press_count = threads < writer->band_count ? threads : writer->band_count;
    writer->presses =
        (png_press *)mt_allocate_array_zeroed(writer->context, writer->press_count, sizeof *writer->presses);
    bool ready = writer->presses != NULL;
    for (unsigned i = 0; ready && i < writer->press_count; i++) {
        ready = press_init(writer, &writer->presses[i]);
    }
    return ready ? MT_OK : mt_fail(writer->context, MT_ERROR_OUT_OF_MEMORY, "no memory for the PNG encoder");
}

static mt_status write_picture(png_writer *writer, unsigned bits)
{
    writer->row_size = mt_image_encoder_row_size(writer->encoder);
    writer->pixel_size = writer->row_size / writer->image->width;
    uint32_t rows = (uint32_t)(BAND_SIZE / (writer->row_size + 1)), height = writer->image->height;
    writer->band_height = rows == 0 ? 1 : rows < height ? rows : height;
    writer->band_count = (height - 1) / writer->band_height + 1;
    writer->bound = compressBound((uLong)((writer->row_size + 1) * writer->band_height)) + 64;
    writer->sum = 1;
    mt_status status = make_presses(writer);
    status = status == MT_OK ? write_head(writer, bits) : status;
    status = status == MT_OK ? write_all_bands(writer) : status;
    status = status == MT_OK ? write_tail(writer) : status;
    for (unsigned i = 0; writer->presses && i < writer->press_count; i++) {
        press_release(writer, &writer->presses[i]);
    }
    mt_free(writer->context, writer->presses);
    return status;
}

static mt_status write_png(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    unsigned bits = options && options->bits ? options->bits : 8;
    mt_image_encoder *encoder = NULL;
    mt_status status = mt_image_encoder_create(context, image, bits, &encoder);
    if (status == MT_OK) {
        png_writer writer = {.context = context, .image = image, .encoder = encoder, .output = output};
        status = write_picture(&writer, bits);
    }
    mt_image_encoder_destroy(context, encoder);
    return status;
}

static const char *const extensions[] = {"png", NULL};

const mt_image_format mt_png_format = {.name = "png",
                                       .title = "Portable Network Graphics",
                                       .extensions = extensions,
                                       .holds_alpha = true,
                                       .bits = {8, 16},
                                       .sniff = mt_png_sniff,
                                       .read = mt_png_read,
                                       .write = write_png};
#endif
