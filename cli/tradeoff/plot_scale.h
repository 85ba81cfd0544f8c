/* Where values stand on an axis of decades, and which of them are named. */
#ifndef MESHTOOL_CLI_TRADEOFF_PLOT_SCALE_H
#define MESHTOOL_CLI_TRADEOFF_PLOT_SCALE_H

#include <stdbool.h>
#include <stddef.h>

#define PLOT_TICK_MAXIMUM 12

/* Decimal logarithms of the least and the largest that is shown. */
typedef struct plot_scale {
    double low, high;
} plot_scale;

/* Holds nothing yet. */
plot_scale plot_scale_empty(void);
bool plot_scale_is_empty(const plot_scale *scale);
/* Only what is above zero and finite has a place. */
void plot_scale_widen(plot_scale *scale, double value);
/* Leaves room around what it holds; no less than `least` decades to each side of the middle. */
void plot_scale_close(plot_scale *scale, double least);
/* 0 at the low end, 1 at the high one. */
double plot_scale_share(const plot_scale *scale, double value);
/* Round values within the scale, ascending: three at least where there are as many, not more than there is room for. */
size_t plot_scale_ticks(const plot_scale *scale, double ticks[PLOT_TICK_MAXIMUM]);

#endif
