/* What a plot is drawn on: SVG, or a picture. */
#ifndef MESHTOOL_CLI_TRADEOFF_CANVAS_H
#define MESHTOOL_CLI_TRADEOFF_CANVAS_H

#include <meshtool/image.h>

#include <stdio.h>

/* Shades that also tell apart in grey. */
typedef enum plot_shade { PLOT_INK, PLOT_MUTED, PLOT_FAINT, PLOT_ACCENT, PLOT_PAPER, PLOT_SHADE_COUNT } plot_shade;

typedef enum plot_anchor { PLOT_BEGIN, PLOT_MIDDLE, PLOT_END } plot_anchor;

/* One of the two is set. Lengths are in pixels from the top left corner. */
typedef struct canvas {
    FILE *svg;
    mt_image *image;
} canvas;

void canvas_begin(const canvas *on, double width, double height);
void canvas_end(const canvas *on);
void canvas_line(const canvas *on, double x0, double y0, double x1, double y1, double width, plot_shade shade);
void canvas_disc(const canvas *on, double x, double y, double radius, plot_shade shade);
/* (x, y) is where the anchor stands, at half the height of a capital. */
void canvas_text(const canvas *on, double x, double y, double height, plot_anchor anchor, plot_shade shade,
                 const char *text);
/* What a text takes, about. */
double canvas_text_width(const canvas *on, double height, const char *text);

#endif
