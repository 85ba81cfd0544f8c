/* Numbers of about 106 bits as the unevaluated sum of two doubles, high being the sum rounded.
 * After Dekker, "A Floating-Point Technique for Extending the Available Precision", Numerische
 * Mathematik 18 (1971), and Knuth's two-sum. Exact only in round-to-nearest, without contraction
 * or excess precision, and where nothing over- or underflows: callers keep magnitudes between
 * 2^-400 and 2^400. */
#ifndef LIB_BASE_DOUBLE_DOUBLE_H
#define LIB_BASE_DOUBLE_DOUBLE_H

typedef struct double_double {
    double high, low;
} double_double;

/* a + b exactly, for |a| >= |b| or a = 0. */
static inline double_double dd_quick_sum(double a, double b)
{
    double sum = a + b;
    double_double result = {sum, b - (sum - a)};
    return result;
}

/* a + b exactly. */
static inline double_double dd_sum(double a, double b)
{
    double sum = a + b;
    double b_part = sum - a;
    double_double result = {sum, (a - (sum - b_part)) + (b - b_part)};
    return result;
}

/* a * b exactly: each factor is cut into halves of 26 bits, whose products are exact. */
static inline double_double dd_product(double a, double b)
{
    const double splitter = 0x1p27 + 1;
    double a_cut = splitter * a, b_cut = splitter * b;
    double a_high = a_cut - (a_cut - a), b_high = b_cut - (b_cut - b);
    double a_low = a - a_high, b_low = b - b_high;
    double product = a * b;
    double error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    double_double result = {product, error};
    return result;
}

static inline double_double dd_add(double_double a, double_double b)
{
    double_double high = dd_sum(a.high, b.high);
    double_double low = dd_sum(a.low, b.low);
    high = dd_quick_sum(high.high, high.low + low.high);
    return dd_quick_sum(high.high, high.low + low.low);
}

static inline double_double dd_negate(double_double a)
{
    double_double result = {-a.high, -a.low};
    return result;
}

static inline double_double dd_subtract(double_double a, double_double b)
{
    return dd_add(a, dd_negate(b));
}

static inline double_double dd_multiply(double_double a, double_double b)
{
    double_double product = dd_product(a.high, b.high);
    return dd_quick_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

static inline double_double dd_multiply_double(double_double a, double b)
{
    double_double product = dd_product(a.high, b);
    return dd_quick_sum(product.high, product.low + a.low * b);
}

/* a / b: the quotient of the high parts, then that of the remainder. */
static inline double_double dd_divide(double_double a, double_double b)
{
    double quotient = a.high / b.high;
    double_double product = dd_product(quotient, b.high);
    double remainder = ((a.high - product.high) - product.low) + a.low - quotient * b.low;
    return dd_quick_sum(quotient, remainder / b.high);
}

#endif
