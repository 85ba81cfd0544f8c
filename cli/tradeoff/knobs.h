/* The knobs' records. */
#ifndef MESHTOOL_CLI_TRADEOFF_KNOBS_H
#define MESHTOOL_CLI_TRADEOFF_KNOBS_H

#include "tradeoff/tradeoff.h"

extern const tradeoff_knob tradeoff_arithmetic;
extern const tradeoff_knob tradeoff_digits;
extern const tradeoff_knob tradeoff_distance;
extern const tradeoff_knob tradeoff_levels;
extern const tradeoff_knob tradeoff_quantization;
extern const tradeoff_knob tradeoff_samples;
extern const tradeoff_knob tradeoff_storage;
extern const tradeoff_knob tradeoff_strips;
extern const tradeoff_knob tradeoff_structure;
extern const tradeoff_knob tradeoff_triangle_test;
extern const tradeoff_knob tradeoff_visibility;
extern const tradeoff_knob tradeoff_weights;

#endif
