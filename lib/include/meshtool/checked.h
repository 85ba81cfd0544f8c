/* Arithmetic on sizes and counts that says when it overflows instead of wrapping. */
#ifndef MESHTOOL_CHECKED_H
#define MESHTOOL_CHECKED_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each stores the result and returns true, or returns false and stores nothing of use. */
static inline bool mt_checked_add(uint64_t a, uint64_t b, uint64_t *sum)
{
    return !__builtin_add_overflow(a, b, sum);
}

static inline bool mt_checked_multiply(uint64_t a, uint64_t b, uint64_t *product)
{
    return !__builtin_mul_overflow(a, b, product);
}

/* Whether a count fits the type mt_index with MT_NONE left over. */
static inline bool mt_count_fits(uint64_t count)
{
    return count <= MT_INDEX_MAX;
}

#ifdef __cplusplus
}
#endif
#endif
