#include <meshtool/vector.h>

double mt_power_of_two_scale(double largest)
{
    if (largest == 0 || !isfinite(largest)) {
        return 1;
    }
    int exponent = 0;
    frexp(largest, &exponent);
    return ldexp(1, exponent < -1023 ? 1023 : -exponent);
}

mt_vec3 mt_vec3_normalize(mt_vec3 a)
{
    double largest = mt_vec3_max_abs(a);
    if (!(largest > 0 && largest <= 0x1.fffffffffffffp1023)) {
        return mt_vec3_make(0, 0, 0);
    }
    a = mt_vec3_scale(a, mt_power_of_two_scale(largest));
    if (largest < 0x1p-1023) {
        /* No double is large enough to bring these into [0.5, 1) in one step. */
        a = mt_vec3_scale(a, mt_power_of_two_scale(mt_vec3_max_abs(a)));
    }
    double length = mt_vec3_length(a);
    return mt_vec3_make(a.x / length, a.y / length, a.z / length);
}
