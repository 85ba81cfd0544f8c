/* cbrt: |x| = 2^(3k) m with 1 <= m < 8. A parabola gives the root within 3%, two
 * steps of Halley, each of which cubes the error, within 2^-50; the remainder m - t^3, computed in
 * two doubles, then corrects t, and only that last sum is rounded: 0.501 ulp. */
#include <meshtool/elementary.h>

#include "lib/base/double_double.h"

#include <math.h>

/* The root of 1 <= m < 8. */
static double root_of_mantissa(double m)
{
    /* The parabola through (1, 1), (3.375, 1.5) and (8, 2) is within 3% of the root. */
    double t = 1 + (m - 1) * (0x1.af286bca1af28p-3 + (m - 3.375) * -0x1.df6f2bc01df6fp-7);
    for (int i = 0; i < 2; i++) {
        double cube = t * t * t;
        t = t * (cube + 2 * m) / (2 * cube + m);
    }
    double_double cube = dd_multiply_double(dd_product(t, t), t);
    double remainder = (m - cube.high) - cube.low;
    return t + remainder / (3 * t * t);
}

double mt_cbrt(double x)
{
    if (x == 0 || !isfinite(x)) {
        return x;
    }
    int exponent = 0;
    double mantissa = frexp(fabs(x), &exponent);
    /* frexp's mantissa is at least 1/2: 2^exponent m = 2^(exponent - shift) (2^shift m), shift 1, 2 or 3. */
    int shift = 1 + ((exponent - 1) % 3 + 3) % 3;
    double root = ldexp(root_of_mantissa(ldexp(mantissa, shift)), (exponent - shift) / 3);
    return copysign(root, x);
}
