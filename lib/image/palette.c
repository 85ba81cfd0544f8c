#include <meshtool/palette.h>

#include <math.h>

/* The fraction of a turn between one hue and the next: the golden section's multiples fill a circle evenly, however
 * many there are. */
#define GOLDEN_TURN 0.61803398874989485

static double hue_channel(double hue, double shift)
{
    double h = hue + shift;
    h -= floor(h);
    double rise = fabs(6.0 * h - 3.0) - 1.0;
    return rise < 0 ? 0.0 : rise > 1 ? 1.0 : rise;
}

void mt_palette_color(mt_index number, double saturation, double value, unsigned char color[3])
{
    static const double shifts[3] = {0.0, 2.0 / 3.0, 1.0 / 3.0};
    double turns = 0.58 + GOLDEN_TURN * number;
    double hue = turns - floor(turns);
    for (int i = 0; i < 3; i++) {
        double c = value * (1.0 - saturation + saturation * hue_channel(hue, shifts[i]));
        color[i] = (unsigned char)(255.0 * c + 0.5);
    }
}

void mt_palette_distinct_color(mt_index number, unsigned char color[3])
{
    static const double values[3] = {0.92, 0.80, 0.68};
    mt_palette_color(number, 0.52, values[number % 3], color);
}
