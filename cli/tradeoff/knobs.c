/* The table of knobs: the command, its help and its plot loop over it. */
#include "tradeoff/knobs.h"

const tradeoff_knob *const tradeoff_knobs[] = {
    &tradeoff_triangle_test, &tradeoff_visibility, &tradeoff_samples, &tradeoff_levels, &tradeoff_digits, NULL,
};
