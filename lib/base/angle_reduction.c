/* Below 2^20: after Cody and Waite, x - k pi/2 with pi/2 in four parts, of which the first three have 33
 * bits, so that their products with k < 2^20 are exact. Beyond: after Payne and Hanek, "Radian Reduction
 * for Trigonometric Functions", SIGNUM Newsletter 18 (1983): x times 2/pi in integers, where those bits
 * of 2/pi that only add multiples of 4 are left out and 256 bits kept, from which an error below
 * 2^-169 follows. No double is nearer to a multiple of pi/2 than 2^-61, which leaves 106 bits. */
#include "lib/base/angle_reduction.h"

#include "lib/base/elementary_tables.h"

#include <math.h>
#include <stdint.h>

#define PI_4 0x1.921fb54442d18p-1
#define PI_2_FIRST 0x1.921fb544p+0
#define PI_2_SECOND 0x1.0b4611a6p-34
#define PI_2_THIRD 0x1.3198a2ep-69
#define PI_2_FOURTH 0x1.b839a252049c1p-104
#define TWO_OVER_PI 0x1.45f306dc9c883p-1

#define WINDOW_WORDS 8
#define PRODUCT_WORDS (WINDOW_WORDS + 3)

static reduced_angle reduce_moderate_angle(double x)
{
    int multiple = (int)(x * TWO_OVER_PI + (x < 0 ? -0.5 : 0.5));
    double k = multiple;
    double_double first = dd_sum(x, -k * PI_2_FIRST);
    double_double second = dd_sum(first.high, -k * PI_2_SECOND);
    double_double third = dd_sum(second.high, -k * PI_2_THIRD);
    double low = ((first.low + second.low) + third.low) - k * PI_2_FOURTH;
    reduced_angle result = {dd_quick_sum(third.high, low), multiple & 3};
    return result;
}

/* product = factor * (the window of 2/pi that begins at word), least significant word first. */
static void multiply_window(const uint32_t factor[3], const uint32_t *word, uint32_t product[PRODUCT_WORDS])
{
    for (int i = 0; i < PRODUCT_WORDS; i++) {
        product[i] = 0;
    }
    for (int i = 0; i < WINDOW_WORDS; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < 3; j++) {
            carry += (uint64_t)word[WINDOW_WORDS - 1 - i] * factor[j] + product[i + j];
            product[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        product[i + 3] = (uint32_t)carry;
    }
}

/* fraction = 1 - fraction. */
static void complement(uint32_t fraction[WINDOW_WORDS])
{
    uint64_t carry = 1;
    for (int i = 0; i < WINDOW_WORDS; i++) {
        carry += (uint32_t)~fraction[i];
        fraction[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

static double_double fraction_value(const uint32_t fraction[WINDOW_WORDS])
{
    double_double value = {0, 0};
    double unit = 1;
    for (int i = WINDOW_WORDS - 1; i >= 0; i--) {
        unit *= 0x1p-32;
        double_double sum = dd_sum(value.high, fraction[i] * unit);
        value = dd_quick_sum(sum.high, sum.low + value.low);
    }
    return value;
}

/* For x >= 2^20. */
static reduced_angle reduce_huge_angle(double x)
{
    int exponent = 0;
    uint64_t integer = (uint64_t)(frexp(x, &exponent) * 0x1p53);
    exponent -= 53;
    /* Word i weighs 2^(-32 i); those before `first` times x are multiples of 4. */
    int first = exponent < 2 ? 0 : (exponent - 2) / 32 + 1;
    int shift = exponent + 32 - 32 * first;
    uint64_t low = integer << (shift & 31);
    uint32_t factor[3] = {(uint32_t)low, (uint32_t)(low >> 32), 0};
    /* 53 bits and a shift below 32 may need three words. */
    factor[2] = (shift & 31) == 0 ? 0 : (uint32_t)(integer >> (64 - (shift & 31)));
    if (shift >= 32) {
        factor[2] = factor[1];
        factor[1] = factor[0];
        factor[0] = 0;
    }
    uint32_t product[PRODUCT_WORDS];
    multiply_window(factor, mt_table_two_over_pi + first, product);
    int quadrant = (int)(product[WINDOW_WORDS] & 3);
    int is_negative = product[WINDOW_WORDS - 1] >> 31 != 0;
    if (is_negative) {
        complement(product);
        quadrant = (quadrant + 1) & 3;
    }
    static const double_double half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
    double_double remainder = dd_multiply(fraction_value(product), half_pi);
    reduced_angle result = {is_negative ? dd_negate(remainder) : remainder, quadrant};
    return result;
}

reduced_angle mt_reduce_angle(double x)
{
    if (fabs(x) <= PI_4) {
        reduced_angle result = {{x, 0}, 0};
        return result;
    }
    if (fabs(x) < 0x1p20) {
        return reduce_moderate_angle(x);
    }
    reduced_angle result = reduce_huge_angle(fabs(x));
    if (x < 0) {
        result.remainder = dd_negate(result.remainder);
        result.quadrant = -result.quadrant & 3;
    }
    return result;
}
