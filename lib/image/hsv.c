#include <meshtool/color.h>

#include <math.h>

static double above_zero(double x)
{
    return x > 0.0 ? x : 0.0;
}

/* The hue of a colour whose largest and smallest parts differ. */
static double hue_of(double r, double g, double b, double largest, double range)
{
    double hue;
    if (largest == r) {
        hue = 60.0 * ((g - b) / range);
    } else if (largest == g) {
        hue = 60.0 * ((b - r) / range) + 120.0;
    } else {
        hue = 60.0 * ((r - g) / range) + 240.0;
    }
    return hue < 0.0 ? hue + 360.0 : hue;
}

void mt_rgb_to_hsv(const double rgb[3], double hsv[3])
{
    double r = above_zero(rgb[0]), g = above_zero(rgb[1]), b = above_zero(rgb[2]);
    double largest = r > g ? r : g, smallest = r < g ? r : g;
    largest = largest > b ? largest : b;
    smallest = smallest < b ? smallest : b;
    double range = largest - smallest;
    double hue = range > 0.0 ? hue_of(r, g, b, largest, range) : 0.0;
    hsv[0] = hue < 360.0 ? hue : 0.0; /* a tiny negative hue and 360 make 360 */
    hsv[1] = largest > 0.0 ? range / largest : 0.0;
    hsv[2] = largest;
}

static double wrap_degrees(double degrees)
{
    double rest = fmod(degrees, 360.0);
    rest = rest < 0.0 ? rest + 360.0 : rest;
    return rest < 360.0 ? rest : 0.0;
}

void mt_hsv_to_rgb(const double hsv[3], double rgb[3])
{
    /* Which of v, q, t and p red, green and blue are in each sixth of the circle. */
    static const uint8_t parts[6][3] = {{0, 2, 3}, {1, 0, 3}, {3, 0, 2}, {3, 1, 0}, {2, 3, 0}, {0, 3, 1}};
    double turn = wrap_degrees(hsv[0]) / 60.0;
    int sixth = (int)turn < 5 ? (int)turn : 5;
    double rest = turn - sixth, s = hsv[1], v = hsv[2];
    const double levels[4] = {v, v * (1.0 - s * rest), v * (1.0 - s * (1.0 - rest)), v * (1.0 - s)};
    for (int k = 0; k < 3; k++) {
        rgb[k] = levels[parts[sixth][k]];
    }
}
