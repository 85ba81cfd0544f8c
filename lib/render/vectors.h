/* Vectors of samples, as gcc and clang have them in C; loops over them are compiled as meshtool/clones.h says. */
#ifndef MESHTOOL_RENDER_VECTORS_H
#define MESHTOOL_RENDER_VECTORS_H

#include <meshtool/clones.h>

#include <stdint.h>

/* Samples of a pixel come in groups of 8. */
#define MT_GROUP_SIZE 8

typedef double vector8d __attribute__((vector_size(64), may_alias));
typedef float vector8f __attribute__((vector_size(32), may_alias));
typedef float vector4f __attribute__((vector_size(16), may_alias));
typedef int32_t vector4i __attribute__((vector_size(16), may_alias));
typedef int32_t vector8i __attribute__((vector_size(32), may_alias));

#endif
