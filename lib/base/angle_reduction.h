/* Angles brought near zero. */
#ifndef LIB_BASE_ANGLE_REDUCTION_H
#define LIB_BASE_ANGLE_REDUCTION_H

#include "lib/base/double_double.h"

/* x = remainder + (quadrant + 4 n) pi/2, |remainder| <= pi/4 (and a step more), quadrant 0 to 3. The
 * remainder is good to about 100 bits relative, however near x is to a multiple of pi/2. */
typedef struct reduced_angle {
    double_double remainder;
    int quadrant;
} reduced_angle;

/* For any finite x. */
reduced_angle mt_reduce_angle(double x);

#endif
