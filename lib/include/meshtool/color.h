/* Operations on colours. They act on the numbers as the picture holds them, encoded or linear; alpha stays as it is.
 * Each pixel is computed in double precision and rounded to a float once. */
#ifndef MESHTOOL_COLOR_H
#define MESHTOOL_COLOR_H

#include <meshtool/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Hue in degrees, [0, 360), saturation and value in [0, 1] for colours in [0, 1] (A. R. Smith, Color gamut transform
 * pairs, SIGGRAPH 1978). Grey has hue 0. Numbers below 0 and NaN are taken as 0; value may pass 1 as colours may. */
void mt_rgb_to_hsv(const double rgb[3], double hsv[3]);
/* The inverse; any finite hue is taken modulo 360. */
void mt_hsv_to_rgb(const double hsv[3], double rgb[3]);

/* The first three channels from colour to hue, saturation, value, and back, in place. MT_ERROR_UNSUPPORTED for a
 * picture of one channel. */
mt_status mt_image_rgb_to_hsv(mt_context *context, mt_image *image);
mt_status mt_image_hsv_to_rgb(mt_context *context, mt_image *image);

/* Multiplies saturations by 1 - factor, in place: 0 changes nothing, 1 leaves grey of the same value. Grey pictures
 * stay as they are. MT_ERROR_ARGUMENT for a factor outside [0, 1]. */
mt_status mt_image_desaturate(mt_context *context, mt_image *image, double factor);

/* Adds degrees to hues, modulo 360, in place. Grey stays grey. MT_ERROR_ARGUMENT for a number that is not finite. */
mt_status mt_image_shift_hue(mt_context *context, mt_image *image, double degrees);

/* Luminance, 0.2126 r + 0.7152 g + 0.0722 b (ITU-R BT.709), as a new picture of one channel; with alpha of four, whose
 * colours are all that. Grey is copied. */
mt_status mt_image_luminance(mt_context *context, const mt_image *image, mt_image **out);

/* Decodes colours by the sRGB curve, in place, and marks the picture linear; one that is so already stays as it is.
 * Numbers outside [0, 1] are clamped. */
mt_status mt_image_to_linear(mt_context *context, mt_image *image);
/* Encodes colours by the sRGB curve, in place, and marks the picture stored. A picture that is marked stored is encoded
 * too: a file of floats may hold light. Numbers outside [0, 1] are clamped. */
mt_status mt_image_to_srgb(mt_context *context, mt_image *image);

#ifdef __cplusplus
}
#endif
#endif
