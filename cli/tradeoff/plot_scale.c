#include "tradeoff/plot_scale.h"

#include <meshtool/elementary.h>

#include <math.h>

static double decade(double x)
{
    return mt_log(x) / 2.30258509299404568402;
}

plot_scale plot_scale_empty(void)
{
    return (plot_scale){INFINITY, -INFINITY};
}

bool plot_scale_is_empty(const plot_scale *scale)
{
    return scale->low > scale->high;
}

void plot_scale_widen(plot_scale *scale, double value)
{
    if (value > 0 && isfinite(value)) {
        scale->low = fmin(scale->low, decade(value));
        scale->high = fmax(scale->high, decade(value));
    }
}

void plot_scale_close(plot_scale *scale, double least)
{
    double middle = 0.5 * (scale->low + scale->high), half = fmax(0.5 * (scale->high - scale->low), least) * 1.2;
    *scale = (plot_scale){middle - half, middle + half};
}

double plot_scale_share(const plot_scale *scale, double value)
{
    return (decade(value) - scale->low) / (scale->high - scale->low);
}

/* How a decade is parted, or how many decades lie between two ticks. */
typedef struct parting {
    int decades;
    size_t count;
    double steps[20];
} parting;

static size_t list_ticks(const plot_scale *scale, const parting *by, double ticks[PLOT_TICK_MAXIMUM])
{
    size_t count = 0;
    int first = (int)floor(scale->low) - 1, last = (int)ceil(scale->high);
    for (int exponent = first; exponent <= last; exponent++) {
        for (size_t i = 0; i < by->count && exponent % by->decades == 0; i++) {
            double value = by->steps[i] * mt_pow(10, exponent), share = plot_scale_share(scale, value);
            if (share >= 0 && share <= 1 && count < PLOT_TICK_MAXIMUM) {
                ticks[count++] = value;
            }
        }
    }
    return count;
}

size_t plot_scale_ticks(const plot_scale *scale, double ticks[PLOT_TICK_MAXIMUM])
{
    static const parting partings[] = {
        {100, 1, {1}},
        {50, 1, {1}},
        {20, 1, {1}},
        {10, 1, {1}},
        {5, 1, {1}},
        {3, 1, {1}},
        {2, 1, {1}},
        {1, 1, {1}},
        {1, 2, {1, 3}},
        {1, 3, {1, 2, 5}},
        {1, 6, {1, 1.5, 2, 3, 5, 7}},
        {1, 13, {1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 4, 5, 6, 7, 8}},
        {1, 18, {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2, 2.2, 2.4, 2.6, 2.8, 3, 3.5, 4}},
        {1, 14, {2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 6.5, 7, 7.5, 8, 8.5, 9}},
    };
    /* Three at least; where no parting has as many, the one that has most. */
    size_t best = 0, most = 0;
    for (size_t i = 0; most < 3 && i < sizeof partings / sizeof *partings; i++) {
        size_t count = list_ticks(scale, &partings[i], ticks);
        best = count > most ? i : best;
        most = count > most ? count : most;
    }
    return list_ticks(scale, &partings[best], ticks);
}
