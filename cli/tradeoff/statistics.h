/* What a list of errors is summed up to. */
#ifndef MESHTOOL_CLI_TRADEOFF_STATISTICS_H
#define MESHTOOL_CLI_TRADEOFF_STATISTICS_H

#include "tradeoff/tradeoff.h"

typedef struct tradeoff_statistics {
    double median, p99, maximum, root_mean_square; /* NAN when there are no values */
} tradeoff_statistics;

/* Sorts the values. */
tradeoff_statistics tradeoff_statistics_of(double *values, size_t count);

/* Adds the median, the 99th percentile and the maximum as NAME_p50, NAME_p99 and NAME_max; the three names are string
 * literals, in this order. */
void tradeoff_add_statistics(tradeoff_row *row, const char *const names[3], const tradeoff_statistics *statistics);

/* The angle between two vectors in degrees, accurate for small ones; NAN when one is zero. */
double tradeoff_degrees_between(mt_vec3 a, mt_vec3 b);

#endif
