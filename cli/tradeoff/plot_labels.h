/* Names beside points, where they hide neither a point nor each other. */
#ifndef MESHTOOL_CLI_TRADEOFF_PLOT_LABELS_H
#define MESHTOOL_CLI_TRADEOFF_PLOT_LABELS_H

#include "tradeoff/canvas.h"

typedef struct plot_label {
    char text[64];
    double x, y, radius; /* of the point */
    plot_shade shade;
} plot_label;

/* Draws each in turn at the best of the places around its point; all stay between left and right, below top. */
void plot_labels_draw(const canvas *on, const plot_label *labels, size_t count, double height, double left,
                      double right, double top);

#endif
