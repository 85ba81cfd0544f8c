/* Sums whose bits do not depend on the order of their terms.
 *
 * Four terms a, b, c, d around a face or a vertex are added as (a + c) + (b + d): the same for every start and both
 * directions. Any other number is added with the rounding errors kept beside (Knuth's two-sum); as long as the terms
 * span fewer than 2^50 in magnitude the pair is the exact sum, whatever the order, and its digits do not wear off
 * with the count (a vertex of valence 10^6). Source: Ogita, Rump and Oishi, "Accurate Sum and Dot Product", SIAM
 * Journal on Scientific Computing 26 (2005).
 * Known failure: intermediate sums past the largest double give NaN. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_SUM_H
#define LIB_ALGORITHMS_SUBDIVIDE_SUM_H

typedef struct mt_subdivide_sum {
    double high, low;
} mt_subdivide_sum;

static inline void mt_subdivide_sum_add(mt_subdivide_sum *sum, double term)
{
    double high = sum->high + term;
    double part = high - sum->high;
    sum->low += (sum->high - (high - part)) + (term - part);
    sum->high = high;
}

/* The sum over a whole number below 2^26, rounded once: the mean of equal terms is their value. */
static inline double mt_subdivide_sum_over(const mt_subdivide_sum *sum, double count)
{
    double quotient = sum->high / count;
    double shifted = quotient * 134217729.0; /* 2^27 + 1: splits off the upper 26 bits (Veltkamp) */
    double upper = shifted - (shifted - quotient);
    double rest = (sum->high - upper * count) - (quotient - upper) * count;
    return quotient + (rest + sum->low) / count;
}

#endif
