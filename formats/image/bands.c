#include "formats/image/image_format.h"

#include <meshtool/checked.h>

/* Bytes of a band: enough that its rows keep every thread busy, little beside the picture. */
#define BAND_SIZE (1u << 20)

static uint32_t band_height(const mt_image *image, size_t row_size)
{
    size_t rows = BAND_SIZE / row_size;
    rows = rows > 0 ? rows : 1;
    return rows < image->height ? (uint32_t)rows : image->height;
}

mt_status mt_image_write_bands(mt_context *context, const mt_image *image, unsigned bits, mt_rows_function write,
                               void *user)
{
    mt_image_encoder *encoder = NULL;
    mt_status status = mt_image_encoder_create(context, image, bits, &encoder);
    if (status != MT_OK) {
        return status;
    }
    uint32_t height = band_height(image, mt_image_encoder_row_size(encoder));
    unsigned char *band = (unsigned char *)mt_allocate_array(context, height, mt_image_encoder_row_size(encoder));
    status = band ? MT_OK : mt_context_error(context)->status;
    for (uint32_t row = 0; row < image->height && status == MT_OK; row += height) {
        uint32_t count = image->height - row < height ? image->height - row : height;
        mt_image_encode_rows(context, encoder, row, count, band);
        status = write(context, user, band, count);
        if (status == MT_OK) {
            status = mt_progress(context, "writing the picture", (double)(row + count) / image->height);
        }
        if (image->height - row <= height) {
            break;
        }
    }
    mt_free(context, band);
    mt_image_encoder_destroy(context, encoder);
    return status;
}
