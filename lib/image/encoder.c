/* From floats to the integers of files. Eight bits go through a table of the 255 linear values at which the
 * encoded byte steps, so that every byte is the nearest one and no pixel costs a power. */
#include <meshtool/image.h>

#include <math.h>
#include <string.h>

/* Cells of the table that gives a first guess of the byte; the dark end, where the curve is steepest, then needs
 * one step more at most. */
#define GUESS_COUNT 4096

struct mt_image_encoder {
    const mt_image *image;
    unsigned bits;
    float steps[256]; /* the smallest float that encodes to more than k; the last is never reached */
    uint8_t guesses[GUESS_COUNT + 1];
};

static void fill_tables(mt_image_encoder *encoder)
{
    for (int k = 0; k < 255; k++) {
        double at = mt_srgb_decode((k + 0.5) / 255.0);
        float step = (float)at;
        encoder->steps[k] = (double)step < at ? nextafterf(step, 2.0F) : step;
    }
    encoder->steps[255] = 2.0F;
    uint8_t k = 0;
    for (int i = 0; i <= GUESS_COUNT; i++) {
        float value = (float)i / GUESS_COUNT;
        while (value >= encoder->steps[k]) {
            k++;
        }
        encoder->guesses[i] = k;
    }
}

mt_status mt_image_encoder_create(mt_context *context, const mt_image *image, unsigned bits, mt_image_encoder **out)
{
    *out = NULL;
    if (bits != 8 && bits != 16) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture is written with 8 or 16 bits a channel, not %u", bits);
    }
    mt_image_encoder *encoder = (mt_image_encoder *)mt_allocate(context, sizeof *encoder);
    if (!encoder) {
        return mt_context_error(context)->status;
    }
    encoder->image = image;
    encoder->bits = bits;
    fill_tables(encoder);
    *out = encoder;
    return MT_OK;
}

void mt_image_encoder_destroy(mt_context *context, mt_image_encoder *encoder)
{
    mt_free(context, encoder);
}

size_t mt_image_encoder_row_size(const mt_image_encoder *encoder)
{
    return (size_t)encoder->image->width * encoder->image->channel_count * (encoder->bits / 8);
}

static float clamp_unit(float x)
{
    return x > 0.0F ? (x < 1.0F ? x : 1.0F) : 0.0F;
}

static uint8_t curve_byte(const mt_image_encoder *encoder, float value)
{
    float x = clamp_unit(value);
    unsigned k = encoder->guesses[(int)(x * GUESS_COUNT)];
    while (x >= encoder->steps[k]) {
        k++;
    }
    return (uint8_t)k;
}

static uint8_t plain_byte(float value)
{
    return (uint8_t)(clamp_unit(value) * 255.0F + 0.5F);
}

static void store_word(unsigned char *bytes, double value)
{
    unsigned word = (unsigned)(value * 65535.0 + 0.5);
    bytes[0] = (unsigned char)(word >> 8);
    bytes[1] = (unsigned char)(word & 255u);
}

void mt_image_encode_row(const mt_image_encoder *encoder, uint32_t number, unsigned char *bytes)
{
    const mt_image *image = encoder->image;
    const float *row = mt_image_pixel(image, 0, number);
    uint32_t channels = image->channel_count;
    bool curve = image->space == MT_COLOR_LINEAR;
    size_t count = (size_t)image->width * channels;
    for (size_t i = 0, channel = 0; i < count; i++, channel = channel + 1 == channels ? 0 : channel + 1) {
        bool curved = curve && channel != 3;
        if (encoder->bits == 8) {
            bytes[i] = curved ? curve_byte(encoder, row[i]) : plain_byte(row[i]);
        } else {
            store_word(bytes + 2 * i, curved ? mt_srgb_encode((double)row[i]) : (double)clamp_unit(row[i]));
        }
    }
}

typedef struct encode_task {
    const mt_image_encoder *encoder;
    uint32_t first;
    unsigned char *bytes;
} encode_task;

static void encode_block(void *user, uint64_t begin, uint64_t end)
{
    const encode_task *task = (const encode_task *)user;
    size_t row_size = mt_image_encoder_row_size(task->encoder);
    for (uint64_t row = begin; row < end; row++) {
        mt_image_encode_row(task->encoder, task->first + (uint32_t)row, task->bytes + row * row_size);
    }
}

void mt_image_encode_rows(mt_context *context, const mt_image_encoder *encoder, uint32_t first, uint32_t count,
                          unsigned char *bytes)
{
    encode_task task = {encoder, first, bytes};
    mt_parallel_for(context, count, 16, encode_block, &task);
}
