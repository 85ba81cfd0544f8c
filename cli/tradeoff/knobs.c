/* The table of knobs: the command, its help and its plot loop over it. */
#include "tradeoff/knobs.h"

const tradeoff_knob *const tradeoff_knobs[] = {
    &tradeoff_storage,
    &tradeoff_arithmetic,
    &tradeoff_triangle_test,
    &tradeoff_structure,
    &tradeoff_visibility,
    &tradeoff_samples,
    &tradeoff_levels,
    &tradeoff_weights,
    &tradeoff_distance,
    &tradeoff_digits,
    &tradeoff_quantization,
    &tradeoff_strips,
    NULL,
};
