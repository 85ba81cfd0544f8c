/* What picture readers share: checks of what a header declares, and whole numbers made floats. */
#ifndef MESHTOOL_FORMATS_IMAGE_SAMPLES_H
#define MESHTOOL_FORMATS_IMAGE_SAMPLES_H

#include "formats/stream/input.h"

#include <meshtool/image.h>

/* Sides that make a picture: MT_ERROR_SYNTAX for a side of 0, MT_ERROR_TOO_LARGE from 2^31 pixels on. */
mt_status mt_picture_check_size(mt_context *context, const mt_input *input, uint64_t width, uint64_t height);

/* Whether the rest of the input, `left` bytes, can hold what the header declares: `needed` bytes at least. If not,
 * MT_ERROR_SYNTAX at the input's end. */
mt_status mt_picture_check_bytes(mt_context *context, const mt_input *input, uint64_t left, uint64_t needed);

/* Takes the input's rest into one block, the caller's. */
mt_status mt_picture_take_rest(mt_context *context, mt_input *input, uint8_t **bytes, size_t *size);

/* Warns of bytes behind the picture, if there are any. */
void mt_picture_warn_of_rest(mt_context *context, const mt_input *input, uint64_t rest);

/* How the samples of a row lie in its bytes. */
typedef struct mt_sample_layout {
    uint32_t bits;          /* 1, 2, 4, 8 or 16 (high byte first); packed from the high bit on */
    uint32_t channel_count; /* 1 to 4; 2: grey and alpha, 4: colour and alpha */
    uint32_t maximum;       /* the value that becomes 1 */
    bool is_inverted;       /* 0 is white */
} mt_sample_layout;

/* Channels of the picture that such samples become: 2 becomes 4. */
uint32_t mt_sample_channels(const mt_sample_layout *layout);

/* Bytes of a row of `width` pixels. */
uint64_t mt_sample_row_size(const mt_sample_layout *layout, uint32_t width);

/* The i-th sample of a row. */
static inline uint32_t mt_sample_at(const uint8_t *row, uint32_t bits, size_t i)
{
    if (bits == 8) {
        return row[i];
    }
    if (bits == 16) {
        return (uint32_t)row[2 * i] << 8 | row[2 * i + 1];
    }
    size_t bit = i * bits;
    return (uint32_t)row[bit / 8] >> (8 - bits - bit % 8) & ((1u << bits) - 1u);
}

/* Makes a row of the picture. Returns the index of the first sample past the maximum, SIZE_MAX when there is none. */
size_t mt_sample_fill_row(const mt_sample_layout *layout, const uint8_t *bytes, mt_image *image, uint32_t y);

#endif
