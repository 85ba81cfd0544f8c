/* Lines and letters drawn onto a finished picture. */
#ifndef MESHTOOL_INK_H
#define MESHTOOL_INK_H

#include <meshtool/image.h>
#include <meshtool/vector.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_ink {
    mt_image *image; /* of 3 or 4 channels */
    mt_vec3 color;   /* in the numbers of the picture: linear where that is */
    double radius;   /* half the width of lines, in pixels */
} mt_ink;

/* A line with round ends from (x0, y0) to (x1, y1), in pixels from the top left corner; what falls outside is left out.
 */
void mt_ink_line(const mt_ink *ink, double x0, double y0, double x1, double y1);

/* Thin strokes for letters (capitals for all), digits and some signs; others leave a space. (x, y) is the middle of the
 * line of text, `height` that of a capital. */
void mt_ink_text(const mt_ink *ink, double x, double y, double height, const char *text);

/* The width of a line of text, in pixels. */
double mt_ink_text_width(double height, const char *text);

#ifdef __cplusplus
}
#endif
#endif
