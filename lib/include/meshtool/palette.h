/* Colours for things that have numbers and no order. */
#ifndef MESHTOOL_PALETTE_H
#define MESHTOOL_PALETTE_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The colour of that number, sRGB; however many numbers there are, their hues are spread evenly, and those of near
 * numbers are far apart. saturation and value from 0 to 1. */
void mt_palette_color(mt_index number, double saturation, double value, unsigned char color[3]);

/* The same, lighter and darker in turn, so that the few neighbours with like hues differ too. */
void mt_palette_distinct_color(mt_index number, unsigned char color[3]);

#ifdef __cplusplus
}
#endif
#endif
