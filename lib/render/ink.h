/* Lines and letters drawn onto a finished picture. */
#ifndef MESHTOOL_RENDER_INK_H
#define MESHTOOL_RENDER_INK_H

#include <meshtool/image.h>
#include <meshtool/vector.h>

/* A line with round ends, in pixels from the top left corner; the colour is linear. */
typedef struct mt_ink {
    mt_image *image;
    mt_vec3 color;
    double radius; /* half the width of lines, in pixels */
} mt_ink;

void mt_ink_line(const mt_ink *ink, double x0, double y0, double x1, double y1);

/* Letters, digits, and . - + of thin strokes; (x, y) is the middle of the line of text, `height` that of a capital. */
void mt_ink_text(const mt_ink *ink, double x, double y, double height, const char *text);

/* The width of a line of text, in pixels. */
double mt_ink_text_width(double height, const char *text);

#endif
