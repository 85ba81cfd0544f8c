// std::from_chars and std::to_chars behind a C interface: exactly rounded, shortest, deaf to the locale.
#include "formats/stream/number.h"

#include <charconv>
#include <cmath>

namespace
{

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

// A result out of range is past the largest double or below the smallest; the decimal exponent of the first digit
// that is not zero tells which.
bool is_too_large(const char *begin, const char *end)
{
    const char *at = begin;
    long magnitude = 0;
    bool point = false, significant = false;
    for (; at != end && (is_digit(*at) || *at == '.'); ++at) {
        if (*at == '.') {
            point = true;
        } else {
            significant = significant || *at != '0';
            if (!point && significant) {
                ++magnitude;
            } else if (point && !significant) {
                --magnitude;
            }
        }
    }
    if (at != end && (*at == 'e' || *at == 'E')) {
        ++at;
        bool negative = at != end && *at == '-';
        at += at != end && (*at == '-' || *at == '+');
        long exponent = 0;
        for (; at != end && is_digit(*at) && exponent < 100000000000L; ++at) {
            exponent = 10 * exponent + (*at - '0');
        }
        magnitude += negative ? -exponent : exponent;
    }
    return magnitude > 0;
}

} // namespace

extern "C" mt_number_result mt_number_parse(const char *begin, const char *end, double *number, const char **stop)
{
    const char *at = begin;
    if (at != end && *at == '+') {
        ++at;
        if (at != end && *at == '-') {
            *stop = begin;
            return MT_NUMBER_MISSING;
        }
    }
    double value = 0.0;
    std::from_chars_result result = std::from_chars(at, end, value);
    *stop = result.ptr;
    if (result.ec == std::errc::invalid_argument) {
        *stop = begin;
        return MT_NUMBER_MISSING;
    }
    if (result.ec == std::errc::result_out_of_range) {
        bool negative = *at == '-';
        bool large = is_too_large(at + negative, result.ptr);
        double magnitude = large ? HUGE_VAL : 0.0;
        *number = negative ? -magnitude : magnitude;
        return large ? MT_NUMBER_TOO_LARGE : MT_NUMBER_OK;
    }
    *number = value;
    return MT_NUMBER_OK;
}

extern "C" bool mt_number_parse_float(const char *begin, const char *end, float *number)
{
    begin += begin != end && *begin == '+';
    return std::from_chars(begin, end, *number).ec == std::errc();
}

extern "C" size_t mt_number_print(double number, char *text)
{
    return static_cast<size_t>(std::to_chars(text, text + MT_NUMBER_ROOM, number).ptr - text);
}

extern "C" size_t mt_number_print_float(float number, char *text)
{
    return static_cast<size_t>(std::to_chars(text, text + MT_NUMBER_ROOM, number).ptr - text);
}

extern "C" size_t mt_number_print_digits(double number, unsigned digits, char *text)
{
    return static_cast<size_t>(
        std::to_chars(text, text + MT_NUMBER_ROOM, number, std::chars_format::general, static_cast<int>(digits)).ptr -
        text);
}
