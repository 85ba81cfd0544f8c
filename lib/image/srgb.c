/* The sRGB transfer curve, IEC 61966-2-1. */
#include <meshtool/elementary.h>
#include <meshtool/image.h>

static double clamp_unit(double x)
{
    return x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0;
}

double mt_srgb_encode(double linear)
{
    double x = clamp_unit(linear);
    if (x <= 0.0031308) {
        return 12.92 * x;
    }
    return x < 1.0 ? clamp_unit(1.055 * mt_pow(x, 1.0 / 2.4) - 0.055) : 1.0; /* 1.055 - 0.055 is not 1 in doubles */
}

double mt_srgb_decode(double encoded)
{
    double x = clamp_unit(encoded);
    return x <= 0.04045 ? x / 12.92 : clamp_unit(mt_pow((x + 0.055) / 1.055, 2.4));
}
