/* Signed integers wide enough for the exact value of any 3x3 determinant of differences of doubles:
 * all finite doubles are multiples of 2^-1074 below 2^1024 (2098 bits), a difference needs one bit
 * more, a product of three 6297, and a sum of six of them three more. No allocation. */
#ifndef LIB_BASE_WIDE_INTEGER_H
#define LIB_BASE_WIDE_INTEGER_H

#include <stdint.h>

/* 32-bit limbs, so that a limb product and two carries fit the 64 bits of standard C. 6300 bits are
 * 197; every operation may leave one zero limb more for its carry. */
#define WIDE_LIMB_COUNT 204

/* sign * sum of limb[i] * 2^(32 i). Limbs from count on are not initialised; limb[count - 1] is not
 * zero; zero has sign 0 and count 0. */
typedef struct wide_integer {
    int sign;
    int count;
    uint32_t limb[WIDE_LIMB_COUNT];
} wide_integer;

/* The exponent of the lowest set bit of a finite double, INT_MAX for zero. */
int wide_lowest_exponent(double x);

/* *result = x * 2^-exponent, for a finite x with exponent <= wide_lowest_exponent(x). */
void wide_from_double(double x, int exponent, wide_integer *result);

/* *result = a + sign * b, sign 1 or -1; result may be a or b. */
void wide_add(const wide_integer *a, const wide_integer *b, int sign, wide_integer *result);

/* *result = a * b; result is neither a nor b. */
void wide_multiply(const wide_integer *a, const wide_integer *b, wide_integer *result);

#endif
