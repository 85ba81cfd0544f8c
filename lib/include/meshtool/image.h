/* A raster of 32-bit floats, row-major from the top left, the channels of a pixel side by side. */
#ifndef MESHTOOL_IMAGE_H
#define MESHTOOL_IMAGE_H

#include <meshtool/context.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the numbers stand for. */
typedef enum mt_color_space {
    MT_COLOR_STORED, /* as files hold them: sRGB-encoded for 8- and 16-bit images */
    MT_COLOR_LINEAR  /* proportional to light */
} mt_color_space;

typedef struct mt_image {
    uint32_t width, height;
    uint32_t channel_count; /* 1 grey, 3 RGB, 4 RGB and alpha */
    mt_color_space space;
    float *pixels;         /* width * height * channel_count */
    bool is_premultiplied; /* colours of 4 channels were multiplied by alpha; files are read so that they are not */
} mt_image;

/* A picture of zeros, MT_COLOR_STORED. MT_ERROR_ARGUMENT for a size of 0 or channels other than 1, 3, 4;
 * MT_ERROR_TOO_LARGE when the bytes overflow, MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_image_create(mt_context *context, uint32_t width, uint32_t height, uint32_t channel_count, mt_image **out);
/* The same with pixels that the caller fills, all of them. */
mt_status mt_image_create_unfilled(mt_context *context, uint32_t width, uint32_t height, uint32_t channel_count,
                                   mt_image **out);
void mt_image_destroy(mt_context *context, mt_image *image); /* NULL is allowed */

static inline float *mt_image_pixel(const mt_image *image, uint32_t x, uint32_t y)
{
    return image->pixels + ((size_t)y * image->width + x) * image->channel_count;
}

/* The sRGB transfer curve (IEC 61966-2-1) and its inverse, on [0, 1]; values outside are clamped, NaN is 0. */
double mt_srgb_encode(double linear);
double mt_srgb_decode(double encoded);

/* Turns rows into the integers that files hold, row after row or in bands. Colour of a linear image is
 * sRGB-encoded; alpha and stored values are scaled. Numbers are rounded to nearest and clamped; NaN becomes 0. */
typedef struct mt_image_encoder mt_image_encoder;

/* bits: 8, or 16 (high byte first). The image is borrowed. */
mt_status mt_image_encoder_create(mt_context *context, const mt_image *image, unsigned bits, mt_image_encoder **out);
void mt_image_encoder_destroy(mt_context *context, mt_image_encoder *encoder); /* NULL is allowed */

/* Bytes of one encoded row. */
size_t mt_image_encoder_row_size(const mt_image_encoder *encoder);

/* Encodes one row; may be called inside a parallel body. */
void mt_image_encode_row(const mt_image_encoder *encoder, uint32_t row, unsigned char *bytes);

/* Encodes rows [first, first + count) into `bytes`, tightly packed. In parallel. */
void mt_image_encode_rows(mt_context *context, const mt_image_encoder *encoder, uint32_t first, uint32_t count,
                          unsigned char *bytes);

/* Samples that integers of so many bits cannot come near: farther than half a step outside [0, 1], or NaN. */
uint64_t mt_image_count_outside(const mt_image *image, unsigned bits);

#ifdef __cplusplus
}
#endif
#endif
