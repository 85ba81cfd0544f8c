/* What the power shares with exponential and logarithm. */
#ifndef LIB_BASE_ELEMENTARY_EXPONENTIAL_H
#define LIB_BASE_ELEMENTARY_EXPONENTIAL_H

#include "lib/base/double_double.h"

/* exp(high + low), for |low| <= 2^-53 |high|; 0 or infinity beyond the range of doubles. */
double mt_exponential_of_sum(double high, double low);

/* log(x) within 2^-67 of its value, for a finite positive x. */
double_double mt_logarithm_sum(double x);

#endif
