/* Pictures behind a Bayer filter (B. E. Bayer, US patent 3971065, 1976): one sample a pixel, red, green or blue by the
 * pixel's place in a pattern of two by two. */
#ifndef MESHTOOL_BAYER_H
#define MESHTOOL_BAYER_H

#include <meshtool/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The four pixels at the top left, row by row. */
typedef enum mt_bayer { MT_BAYER_RGGB, MT_BAYER_BGGR, MT_BAYER_GRBG, MT_BAYER_GBRG } mt_bayer;

/* Which colour the pixel has a sample of: 0 red, 1 green, 2 blue. */
static inline uint32_t mt_bayer_channel(mt_bayer pattern, uint32_t x, uint32_t y)
{
    static const uint8_t channels[4][4] = {{0, 1, 1, 2}, {2, 1, 1, 0}, {1, 0, 2, 1}, {1, 2, 0, 1}};
    return channels[pattern][2 * (y % 2) + x % 2];
}

/* The samples that such a filter lets through, as a new picture of one channel. Grey is taken as three equal colours.
 * MT_ERROR_UNSUPPORTED for a picture with alpha. */
mt_status mt_bayer_mosaic(mt_context *context, const mt_image *image, mt_bayer pattern, mt_image **out);

/* A colour picture of the same size from one channel of samples: each colour is the sample where the pixel has it, else
 * the mean of those among its eight neighbours that do and lie in the picture, else (at most two pixels wide or high)
 * 0. MT_ERROR_UNSUPPORTED for a picture of more than one channel. */
mt_status mt_bayer_demosaic(mt_context *context, const mt_image *mosaic, mt_bayer pattern, mt_image **out);

#ifdef __cplusplus
}
#endif
#endif
