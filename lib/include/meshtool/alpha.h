/* Alpha, how opaque each pixel is (T. Porter, T. Duff, Compositing digital images, SIGGRAPH 1984): the fourth channel.
 * A picture of fewer channels is opaque. */
#ifndef MESHTOOL_ALPHA_H
#define MESHTOOL_ALPHA_H

#include <meshtool/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Multiplies colours by alpha, in place, and marks the picture so; one that is marked so, or has no alpha, stays. */
mt_status mt_image_premultiply(mt_context *context, mt_image *image);
/* Divides colours by alpha, in place; where alpha is 0 they become 0. A picture that is not marked as premultiplied is
 * divided too, as files do not say; one without alpha stays. */
mt_status mt_image_unpremultiply(mt_context *context, mt_image *image);

/* The picture over one colour: a new picture without alpha, grey when the picture has one channel. */
mt_status mt_image_over_color(mt_context *context, const mt_image *image, const double color[3], mt_image **out);

/* The picture over another of the same size: a new one, with alpha when the background has it, colour when either has.
 * MT_ERROR_UNSUPPORTED when the sizes or the kinds of numbers (stored, linear) differ. */
mt_status mt_image_over(mt_context *context, const mt_image *image, const mt_image *background, mt_image **out);

/* A new picture of the first three channels as they are; a copy of one without alpha. */
mt_status mt_image_drop_alpha(mt_context *context, const mt_image *image, mt_image **out);
/* A new picture of four channels, opaque; grey becomes colour. A copy of one with alpha. */
mt_status mt_image_add_alpha(mt_context *context, const mt_image *image, mt_image **out);

#ifdef __cplusplus
}
#endif
#endif
