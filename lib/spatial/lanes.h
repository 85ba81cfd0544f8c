/* Eight numbers side by side, as gcc and clang have them in C. Passed by address (meshtool/clones.h). */
#ifndef MT_SPATIAL_LANES_H
#define MT_SPATIAL_LANES_H

#include <meshtool/clones.h>

#include <stdint.h>
#include <string.h>

#define LANE_COUNT 8

typedef float lanes __attribute__((vector_size(32)));
typedef int32_t lane_mask __attribute__((vector_size(32))); /* all ones or all zeros in each */

MT_INLINE void lanes_load(const float *from, lanes *out)
{
    memcpy(out, from, sizeof *out);
}

/* Lane by lane the larger and the smaller; where `a` is NaN, b: compilers know this form of an instruction. */
MT_INLINE void lanes_maximum(const lanes *a, const lanes *b, lanes *out)
{
    lanes larger;
    for (int i = 0; i < LANE_COUNT; i++) {
        larger[i] = (*a)[i] > (*b)[i] ? (*a)[i] : (*b)[i];
    }
    *out = larger;
}

MT_INLINE void lanes_minimum(const lanes *a, const lanes *b, lanes *out)
{
    lanes smaller;
    for (int i = 0; i < LANE_COUNT; i++) {
        smaller[i] = (*a)[i] < (*b)[i] ? (*a)[i] : (*b)[i];
    }
    *out = smaller;
}

/* Bit i is set where lane i is. */
MT_INLINE uint32_t lanes_bits(const lane_mask *mask)
{
    lane_mask bits = *mask & (lane_mask){1, 2, 4, 8, 16, 32, 64, 128};
    int32_t all = 0;
    for (int i = 0; i < LANE_COUNT; i++) {
        all |= bits[i];
    }
    return (uint32_t)all;
}

#endif
