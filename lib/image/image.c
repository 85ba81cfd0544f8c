#include <meshtool/checked.h>
#include <meshtool/image.h>

#include <string.h>

mt_status mt_image_create_unfilled(mt_context *context, uint32_t width, uint32_t height, uint32_t channel_count,
                                   mt_image **out)
{
    *out = NULL;
    if (width == 0 || height == 0) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture of %u x %u pixels has no pixel", width, height);
    }
    if (channel_count != 1 && channel_count != 3 && channel_count != 4) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture has 1, 3 or 4 channels, not %u", channel_count);
    }
    uint64_t value_count = 0;
    if (!mt_checked_multiply((uint64_t)width * height, channel_count, &value_count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "a picture of %u x %u pixels is too large", width, height);
    }
    mt_image *image = (mt_image *)mt_allocate_zeroed(context, sizeof *image);
    float *pixels = image ? (float *)mt_allocate_array(context, value_count, sizeof *pixels) : NULL;
    if (!pixels) {
        mt_free(context, image);
        return mt_context_error(context)->status;
    }
    image->width = width;
    image->height = height;
    image->channel_count = channel_count;
    image->pixels = pixels;
    *out = image;
    return MT_OK;
}

mt_status mt_image_create(mt_context *context, uint32_t width, uint32_t height, uint32_t channel_count, mt_image **out)
{
    mt_status status = mt_image_create_unfilled(context, width, height, channel_count, out);
    if (status == MT_OK) {
        memset((*out)->pixels, 0, (size_t)width * height * channel_count * sizeof(float));
    }
    return status;
}

void mt_image_destroy(mt_context *context, mt_image *image)
{
    if (image) {
        mt_free(context, image->pixels);
        mt_free(context, image);
    }
}

uint64_t mt_image_count_outside(const mt_image *image, unsigned bits)
{
    double half = 0.5 / (double)((1ull << bits) - 1);
    uint64_t count = 0, end = (uint64_t)image->width * image->height * image->channel_count;
    for (uint64_t i = 0; i < end; i++) {
        count += !(image->pixels[i] >= -half && image->pixels[i] <= 1 + half);
    }
    return count;
}
