#include "lib/base/wide_integer.h"

#include <limits.h>
#include <string.h>

/* |x| = integer * 2^*exponent with an integer below 2^53. */
static uint64_t integer_part(double x, int *exponent)
{
    uint64_t bits = 0;
    memcpy(&bits, &x, sizeof bits);
    int biased = (int)(bits >> 52 & 0x7ff);
    uint64_t fraction = bits & 0x000fffffffffffff;
    *exponent = biased == 0 ? -1074 : biased - 1075;
    return biased == 0 ? fraction : fraction | 0x0010000000000000;
}

int wide_lowest_exponent(double x)
{
    int exponent = 0;
    uint64_t integer = integer_part(x, &exponent);
    return integer == 0 ? INT_MAX : exponent + __builtin_ctzll(integer);
}

static void trim(wide_integer *a, int count)
{
    while (count > 0 && a->limb[count - 1] == 0) {
        count--;
    }
    a->count = count;
    if (count == 0) {
        a->sign = 0;
    }
}

void wide_from_double(double x, int exponent, wide_integer *result)
{
    result->sign = (x > 0) - (x < 0);
    result->count = 0;
    if (x == 0) {
        return;
    }
    int own_exponent = 0;
    uint64_t integer = integer_part(x, &own_exponent);
    int zeros = __builtin_ctzll(integer);
    integer >>= zeros;
    int shift = own_exponent + zeros - exponent;
    int first = shift / 32;
    shift %= 32;
    memset(result->limb, 0, (size_t)first * sizeof result->limb[0]);
    result->limb[first] = (uint32_t)(integer << shift);
    integer >>= 32 - shift;
    result->limb[first + 1] = (uint32_t)integer;
    result->limb[first + 2] = (uint32_t)(integer >> 32);
    trim(result, first + 3);
}

static int compare_magnitudes(const wide_integer *a, const wide_integer *b)
{
    if (a->count != b->count) {
        return a->count < b->count ? -1 : 1;
    }
    for (int i = a->count - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i]) {
            return a->limb[i] < b->limb[i] ? -1 : 1;
        }
    }
    return 0;
}

/* |result| = |a| + |b| for a with at least as many limbs as b. */
static void add_magnitudes(const wide_integer *a, const wide_integer *b, wide_integer *result)
{
    uint64_t carry = 0;
    int count = a->count;
    for (int i = 0; i < count; i++) {
        carry += (uint64_t)a->limb[i] + (i < b->count ? b->limb[i] : 0);
        result->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    result->limb[count] = (uint32_t)carry;
    trim(result, count + 1);
}

/* |result| = |a| - |b| for |a| > |b|. */
static void subtract_magnitudes(const wide_integer *a, const wide_integer *b, wide_integer *result)
{
    uint64_t borrow = 0;
    int count = a->count;
    for (int i = 0; i < count; i++) {
        uint64_t difference = (uint64_t)a->limb[i] - (i < b->count ? b->limb[i] : 0) - borrow;
        result->limb[i] = (uint32_t)difference;
        borrow = difference >> 63;
    }
    trim(result, count);
}

void wide_add(const wide_integer *a, const wide_integer *b, int sign, wide_integer *result)
{
    int b_sign = sign * b->sign;
    int order = compare_magnitudes(a, b);
    const wide_integer *large = order >= 0 ? a : b;
    const wide_integer *small = order >= 0 ? b : a;
    int large_sign = order >= 0 ? a->sign : b_sign;
    int small_sign = order >= 0 ? b_sign : a->sign;
    if (small_sign == 0 || large_sign == small_sign) {
        add_magnitudes(large, small, result);
        result->sign = large_sign;
    } else if (order == 0) {
        result->sign = 0;
        result->count = 0;
    } else {
        subtract_magnitudes(large, small, result);
        result->sign = large_sign;
    }
}

void wide_multiply(const wide_integer *a, const wide_integer *b, wide_integer *result)
{
    result->sign = a->sign * b->sign;
    if (result->sign == 0) {
        result->count = 0;
        return;
    }
    memset(result->limb, 0, (size_t)b->count * sizeof result->limb[0]);
    for (int i = 0; i < a->count; i++) {
        uint64_t factor = a->limb[i];
        uint64_t carry = 0;
        for (int j = 0; j < b->count; j++) {
            carry += factor * b->limb[j] + result->limb[i + j];
            result->limb[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        result->limb[i + b->count] = (uint32_t)carry;
    }
    trim(result, a->count + b->count);
}
