/* Vectors of samples, as gcc and clang have them in C; loops over them are compiled as meshtool/clones.h says. */
#ifndef MESHTOOL_RENDER_VECTORS_H
#define MESHTOOL_RENDER_VECTORS_H

#include <meshtool/clones.h>

#include <stdbool.h>
#include <stdint.h>

/* Samples of a pixel come in groups of 8. */
#define MT_GROUP_SIZE 8

typedef double vector8d __attribute__((vector_size(64), may_alias));
typedef float vector8f __attribute__((vector_size(32), may_alias));
typedef float vector4f __attribute__((vector_size(16), may_alias));
typedef int32_t vector4i __attribute__((vector_size(16), may_alias));
typedef int32_t vector8i __attribute__((vector_size(32), may_alias));
typedef int64_t vector2l __attribute__((vector_size(16), may_alias));
typedef int64_t vector4l __attribute__((vector_size(32), may_alias));
typedef int64_t vector8l __attribute__((vector_size(64), may_alias));

/* Whether a mask has a lane that is set. */
MT_INLINE bool mt_any_lane(const vector8i *mask)
{
    const vector4l wide = (vector4l)*mask;
    return ((wide[0] | wide[1]) | (wide[2] | wide[3])) != 0;
}

/* A bit for each lane of a mask that is set. */
MT_INLINE unsigned mt_lane_bits(const vector8i *mask)
{
    const vector8i bits = {1, 2, 4, 8, 16, 32, 64, 128};
    vector8i here = *mask & bits;
    vector4i half = __builtin_shufflevector(here, here, 0, 1, 2, 3) | __builtin_shufflevector(here, here, 4, 5, 6, 7);
    return (unsigned)((half[0] | half[1]) | (half[2] | half[3]));
}

#endif
