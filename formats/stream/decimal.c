/* Decimals of up to 19 digits by integers: the quotient of the digits and the power of ten, to 63 bits and one that
 * says whether a remainder was left, is rounded once to a double. Nothing here can overflow or become subnormal. */
#include "formats/stream/cursor.h"

__extension__ typedef unsigned __int128 wide;

double mt_decimal_quotient(uint64_t mantissa, unsigned places)
{
    static const uint64_t powers[] = {1u,
                                      10u,
                                      100u,
                                      1000u,
                                      10000u,
                                      100000u,
                                      1000000u,
                                      10000000u,
                                      100000000u,
                                      1000000000u,
                                      10000000000u,
                                      100000000000u,
                                      1000000000000u,
                                      10000000000000u,
                                      100000000000000u,
                                      1000000000000000u,
                                      10000000000000000u,
                                      100000000000000000u,
                                      1000000000000000000u,
                                      10000000000000000000u};
    if (places == 0 || mantissa == 0) {
        return (double)mantissa;
    }
    int mantissa_shift = __builtin_clzll(mantissa);
    int power_shift = __builtin_clzll(powers[places]);
    wide numerator = (wide)(mantissa << mantissa_shift) << 63;
    uint64_t denominator = powers[places] << power_shift;
    uint64_t quotient = (uint64_t)(numerator / denominator);
    quotient |= (uint64_t)((wide)quotient * denominator != numerator);
    /* The scale is a power of two, written as the bits of a double. */
    uint64_t scale_bits = (uint64_t)(1023 + power_shift - mantissa_shift - 63) << 52;
    double scale;
    memcpy(&scale, &scale_bits, sizeof scale);
    return (double)quotient * scale;
}
