#include "formats/image/samples.h"

#include <inttypes.h>

#define MAXIMUM_PIXELS (((uint64_t)1 << 31) - 1)

mt_status mt_picture_check_size(mt_context *context, const mt_input *input, uint64_t width, uint64_t height)
{
    mt_place place = mt_input_place_offset(input, mt_input_offset(input));
    if (width == 0 || height == 0) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, place,
                          "a picture of %" PRIu64 " x %" PRIu64 " pixels has no pixel, expected sides of 1 and more",
                          width, height);
    }
    if (width > MAXIMUM_PIXELS / height) {
        return mt_fail_at(context, MT_ERROR_TOO_LARGE, place,
                          "a picture of %" PRIu64 " x %" PRIu64 " pixels is too large, expected less than 2^31 pixels",
                          width, height);
    }
    return MT_OK;
}

mt_status mt_picture_check_bytes(mt_context *context, const mt_input *input, uint64_t left, uint64_t needed)
{
    if (left >= needed) {
        return MT_OK;
    }
    return mt_fail_at(context, MT_ERROR_SYNTAX, mt_input_place_offset(input, mt_input_size(input)),
                      "the file ends here, expected %" PRIu64 " bytes more for the pixels that its header declares",
                      needed - left);
}

mt_status mt_picture_take_rest(mt_context *context, mt_input *input, uint8_t **bytes, size_t *size)
{
    *bytes = NULL;
    mt_status status = mt_input_collect(context, input);
    if (status != MT_OK) {
        return status;
    }
    *size = (size_t)(mt_input_size(input) - mt_input_offset(input));
    *bytes = mt_allocate(context, *size);
    if (!*bytes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    status = mt_input_read_exactly(context, input, *bytes, *size, "the rest of the picture");
    if (status != MT_OK) {
        mt_free(context, *bytes);
        *bytes = NULL;
    }
    return status;
}

void mt_picture_warn_of_rest(mt_context *context, const mt_input *input, uint64_t rest)
{
    if (rest > 0) {
        mt_warn(context, "%s: %" PRIu64 " bytes after the picture are ignored", mt_input_name(input), rest);
    }
}

uint32_t mt_sample_channels(const mt_sample_layout *layout)
{
    return layout->channel_count == 2 ? 4 : layout->channel_count;
}

uint64_t mt_sample_row_size(const mt_sample_layout *layout, uint32_t width)
{
    return ((uint64_t)width * layout->channel_count * layout->bits + 7) / 8;
}

/* Grey and alpha become colour and alpha. */
static void spread_grey(float *pixel, size_t width)
{
    for (size_t x = width; x-- > 0;) {
        float grey = pixel[2 * x], alpha = pixel[2 * x + 1];
        pixel[4 * x] = pixel[4 * x + 1] = pixel[4 * x + 2] = grey;
        pixel[4 * x + 3] = alpha;
    }
}

size_t mt_sample_fill_row(const mt_sample_layout *layout, const uint8_t *bytes, mt_image *image, uint32_t y)
{
    size_t count = (size_t)image->width * layout->channel_count, wrong = SIZE_MAX;
    float *values = mt_image_pixel(image, 0, y);
    double maximum = layout->maximum;
    for (size_t i = count; i-- > 0;) {
        uint32_t sample = mt_sample_at(bytes, layout->bits, i);
        wrong = sample > layout->maximum ? i : wrong;
        values[i] = (float)((layout->is_inverted ? maximum - sample : (double)sample) / maximum);
    }
    if (layout->channel_count == 2) {
        spread_grey(values, image->width);
    }
    return wrong;
}
