#include "tradeoff/integer.h"

#include <limits.h>
#include <math.h>

/* |x| = mantissa * 2^*exponent, the mantissa odd; x is not 0. */
static uint64_t split(double x, int *exponent)
{
    uint64_t mantissa = (uint64_t)ldexp(frexp(fabs(x), exponent), 53);
    *exponent -= 53;
    while (mantissa % 2 == 0) {
        mantissa /= 2;
        ++*exponent;
    }
    return mantissa;
}

int integer_exponent(double x)
{
    int exponent = INT_MAX;
    if (x != 0) {
        split(x, &exponent);
    }
    return exponent;
}

static void trim(integer *a)
{
    while (a->count > 0 && a->limbs[a->count - 1] == 0) {
        a->count--;
    }
    a->sign = a->count > 0 ? a->sign : 0;
}

void integer_from(double x, int exponent, integer *out)
{
    out->sign = x < 0 ? -1 : 1;
    out->count = 0;
    if (x == 0) {
        out->sign = 0;
        return;
    }
    int own;
    uint64_t mantissa = split(x, &own);
    unsigned shift = (unsigned)(own - exponent), bits = shift % 32;
    while (out->count < shift / 32) {
        out->limbs[out->count++] = 0;
    }
    out->limbs[out->count++] = (uint32_t)(mantissa << bits);
    out->limbs[out->count++] = (uint32_t)(mantissa >> (32 - bits));
    out->limbs[out->count++] = (uint32_t)(mantissa >> 32 >> (32 - bits));
    trim(out);
}

static int compare_magnitudes(const integer *a, const integer *b)
{
    if (a->count != b->count) {
        return a->count < b->count ? -1 : 1;
    }
    for (uint32_t i = a->count; i-- > 0;) {
        if (a->limbs[i] != b->limbs[i]) {
            return a->limbs[i] < b->limbs[i] ? -1 : 1;
        }
    }
    return 0;
}

/* |a| + |b|, a being the longer one. */
static void add_magnitudes(const integer *a, const integer *b, integer *out)
{
    uint64_t carry = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        carry += (uint64_t)a->limbs[i] + (i < b->count ? b->limbs[i] : 0);
        out->limbs[i] = (uint32_t)carry;
        carry >>= 32;
    }
    out->count = a->count;
    if (carry) {
        out->limbs[out->count++] = (uint32_t)carry;
    }
}

/* |a| - |b|, a being the larger one. */
static void subtract_magnitudes(const integer *a, const integer *b, integer *out)
{
    uint64_t borrow = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        uint64_t less = (i < b->count ? b->limbs[i] : 0) + borrow;
        borrow = a->limbs[i] < less;
        out->limbs[i] = (uint32_t)(a->limbs[i] - less);
    }
    out->count = a->count;
}

/* a + b, b with another sign. */
static void combine(const integer *a, const integer *b, int sign, integer *out)
{
    int order = compare_magnitudes(a, b);
    const integer *larger = order < 0 ? b : a, *smaller = order < 0 ? a : b;
    out->sign = order < 0 ? sign : a->sign;
    if (a->sign * sign >= 0) {
        out->sign = a->sign ? a->sign : sign;
        add_magnitudes(larger, smaller, out);
    } else {
        subtract_magnitudes(larger, smaller, out);
    }
    trim(out);
}

void integer_add(const integer *a, const integer *b, integer *out)
{
    combine(a, b, b->sign, out);
}

void integer_subtract(const integer *a, const integer *b, integer *out)
{
    combine(a, b, -b->sign, out);
}

void integer_multiply(const integer *a, const integer *b, integer *out)
{
    out->sign = a->sign * b->sign;
    out->count = out->sign ? a->count + b->count : 0;
    for (uint32_t i = 0; i < out->count; i++) {
        out->limbs[i] = 0;
    }
    for (uint32_t i = 0; out->sign && i < a->count; i++) {
        uint64_t carry = 0;
        for (uint32_t j = 0; j < b->count; j++) {
            carry += (uint64_t)a->limbs[i] * b->limbs[j] + out->limbs[i + j];
            out->limbs[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        out->limbs[i + b->count] = (uint32_t)carry;
    }
    trim(out);
}
