/* Whole numbers as long as doubles need them, for oracles: nothing of the library is computed in them. */
#ifndef MESHTOOL_CLI_TRADEOFF_INTEGER_H
#define MESHTOOL_CLI_TRADEOFF_INTEGER_H

#include <stdint.h>

/* Finite doubles are whole multiples of 2^-1074 below 2^1024: of 2098 bits. A sum of six products of three of their
 * differences has at most 6300 bits. */
#define INTEGER_LIMBS 200

typedef struct integer {
    int sign;       /* -1, 0 or 1 */
    uint32_t count; /* of limbs; the last is not 0; 0 for 0 */
    uint32_t limbs[INTEGER_LIMBS];
} integer;

/* The largest exponent e such that x is a whole multiple of 2^e; INT_MAX for 0. x is finite. */
int integer_exponent(double x);

/* x / 2^exponent, exponent being at most integer_exponent(x). */
void integer_from(double x, int exponent, integer *out);

/* `out` is neither a nor b. */
void integer_add(const integer *a, const integer *b, integer *out);
void integer_subtract(const integer *a, const integer *b, integer *out);
void integer_multiply(const integer *a, const integer *b, integer *out);

#endif
