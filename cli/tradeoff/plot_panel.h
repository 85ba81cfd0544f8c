/* One knob's panel of a plot: time to the right and error upwards, both in decades. Levels that no other beats in both
 * are filled and joined; the knee is ringed. A level without error stands on the floor of its panel. */
#ifndef MESHTOOL_CLI_TRADEOFF_PLOT_PANEL_H
#define MESHTOOL_CLI_TRADEOFF_PLOT_PANEL_H

#include "tradeoff/canvas.h"
#include "tradeoff/tradeoff.h"

#define PLOT_PANEL_WIDTH 560.0
#define PLOT_PANEL_HEIGHT 340.0
#define PLOT_LETTER 8.0 /* height of a capital */

/* Rows begin up to end of the table, of one knob, with the panel's corner at (x, y). */
void plot_panel_draw(const canvas *on, const tradeoff_table *table, size_t begin, size_t end, double x, double y);

#endif
