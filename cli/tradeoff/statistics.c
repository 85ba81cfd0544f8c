#include "tradeoff/statistics.h"

#include <meshtool/elementary.h>

#include <math.h>
#include <stdlib.h>

static int compare_doubles(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

tradeoff_statistics tradeoff_statistics_of(double *values, size_t count)
{
    tradeoff_statistics s = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    if (count == 0) {
        return s;
    }
    qsort(values, count, sizeof *values, compare_doubles);
    double squares = 0;
    for (size_t i = 0; i < count; i++) {
        squares += values[i] * values[i];
    }
    s.median = values[count / 2];
    s.p99 = values[count - 1 - count / 100];
    s.maximum = values[count - 1];
    s.root_mean_square = sqrt(squares / (double)count);
    return s;
}

void tradeoff_add_statistics(tradeoff_row *row, const char *const names[3], const tradeoff_statistics *statistics)
{
    tradeoff_add_error(row, names[0], statistics->median);
    tradeoff_add_error(row, names[1], statistics->p99);
    tradeoff_add_error(row, names[2], statistics->maximum);
}

double tradeoff_degrees_between(mt_vec3 a, mt_vec3 b)
{
    a = mt_vec3_normalize(a);
    b = mt_vec3_normalize(b);
    mt_vec3 difference = mt_vec3_subtract(a, b), sum = mt_vec3_add(a, b);
    if (mt_vec3_dot(a, a) == 0 || mt_vec3_dot(b, b) == 0) {
        return (double)NAN;
    }
    return 2 * mt_atan2(mt_vec3_length(difference), mt_vec3_length(sum)) * (180 / MT_PI);
}
