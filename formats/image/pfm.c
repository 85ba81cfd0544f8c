/* Portable float map: the floats as they are, from the bottom row up, low byte first (a negative scale says so). */
#include "formats/image/image_format.h"
#include "formats/stream/output.h"

#include <string.h>

static void store_floats(const float *values, size_t count, unsigned char *bytes)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, values + i, sizeof word);
        for (unsigned k = 0; k < 4; k++) {
            bytes[4 * i + k] = (unsigned char)(word >> (8 * k));
        }
    }
}

static mt_status write_pfm(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                           mt_output *output)
{
    (void)options;
    if (image->channel_count == 4) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "PFM holds no transparency: write .png or .pam, or give a background");
    }
    size_t count = (size_t)image->width * image->channel_count;
    unsigned char *row = (unsigned char *)mt_allocate_array(context, count, 4);
    if (!row) {
        return mt_context_error(context)->status;
    }
    mt_status status = mt_output_format(context, output, "P%c\n%u %u\n-1.0\n", image->channel_count == 1 ? 'f' : 'F',
                                        image->width, image->height);
    for (uint32_t y = image->height; y > 0 && status == MT_OK; y--) {
        store_floats(mt_image_pixel(image, 0, y - 1), count, row);
        status = mt_output_write(context, output, row, count * 4);
    }
    mt_free(context, row);
    return status;
}

static const char *const extensions[] = {"pfm", NULL};

const mt_image_format mt_pfm_format = {.name = "pfm",
                                       .title = "Portable float map",
                                       .extensions = extensions,
                                       .bits = {32},
                                       .sniff = mt_pfm_sniff,
                                       .read = mt_pfm_read,
                                       .write = write_pfm};
