/* Values that the elementary functions start from. */
#ifndef LIB_BASE_ELEMENTARY_TABLES_H
#define LIB_BASE_ELEMENTARY_TABLES_H

#include "lib/base/double_double.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 2^(i / 64). */
#define MT_TABLE_POWER_COUNT 64
extern const double_double mt_table_power_of_two[MT_TABLE_POWER_COUNT];

/* -log(j / 256) for j = MT_TABLE_LOGARITHM_FIRST + i: 256 sqrt(1/2) <= j <= 256 sqrt(2), rounded. */
#define MT_TABLE_LOGARITHM_FIRST 181
#define MT_TABLE_LOGARITHM_COUNT 182
extern const double_double mt_table_logarithm[MT_TABLE_LOGARITHM_COUNT];

/* atan(i / 64). */
#define MT_TABLE_ARCTANGENT_COUNT 65
extern const double_double mt_table_arctangent[MT_TABLE_ARCTANGENT_COUNT];

/* 2/pi = sum of word[i] * 2^(-32 i), as far as the largest double needs. */
#define MT_TABLE_TWO_OVER_PI_COUNT 39
extern const uint32_t mt_table_two_over_pi[MT_TABLE_TWO_OVER_PI_COUNT];

#ifdef __cplusplus
}
#endif
#endif
