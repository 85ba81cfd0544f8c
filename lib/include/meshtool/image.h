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
    uint32_t channel_count; /* 1 grey, 3 RGB, 4 RGB and alpha (not premultiplied) */
    mt_color_space space;
    float *pixels; /* width * height * channel_count */
} mt_image;

/* A picture of zeros. MT_ERROR_ARGUMENT for a size of 0 or channels other than 1, 3, 4. */
mt_status mt_image_create(mt_context *context, uint32_t width, uint32_t height, uint32_t channel_count, mt_image **out);
void mt_image_destroy(mt_context *context, mt_image *image);

static inline float *mt_image_pixel(const mt_image *image, uint32_t x, uint32_t y)
{
    return image->pixels + ((size_t)y * image->width + x) * image->channel_count;
}

/* The sRGB transfer curve (IEC 61966-2-1) and its inverse, on [0, 1]. */
double mt_srgb_encode(double linear);
double mt_srgb_decode(double encoded);

#ifdef __cplusplus
}
#endif
#endif
