/* Scanning inside a block of text: blanks, words, numbers. Everything relies on the block's final line end and its
 * padding (text.h): no scan needs a bound. A blank is a space, tab, vertical tab or form feed. */
#ifndef MESHTOOL_STREAM_CURSOR_H
#define MESHTOOL_STREAM_CURSOR_H

#include "formats/stream/number.h"

#include <stdint.h>
#include <string.h>

static inline bool mt_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static inline bool mt_is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static inline bool mt_is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* Whether a word ends before this byte. */
static inline bool mt_is_space(char c)
{
    return mt_is_blank(c) || mt_is_line_end(c);
}

static inline const char *mt_skip_blanks(const char *at)
{
    while (mt_is_blank(*at)) {
        at++;
    }
    return at;
}

/* The first byte after the word that begins at `at`. */
static inline const char *mt_skip_word(const char *at)
{
    while (!mt_is_space(*at)) {
        at++;
    }
    return at;
}

/* The line end of the line that `at` lies in. */
static inline const char *mt_find_line_end(const char *at)
{
    while (!mt_is_line_end(*at)) {
        at++;
    }
    return at;
}

/* The beginning of the next line, or `end`. `at` is a line end. */
static inline const char *mt_skip_line_end(const char *at, const char *end)
{
    at += at[0] == '\r' && at[1] == '\n' ? 2 : 1;
    return at < end ? at : end;
}

/* Eight bytes, the first in the lowest place. */
static inline uint64_t mt_load_eight(const char *at)
{
    uint64_t bytes;
    memcpy(&bytes, at, sizeof bytes);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bytes = __builtin_bswap64(bytes);
#endif
    return bytes;
}

/* How many of the eight bytes, from the first on, are digits. A byte is none when, less '0', it is 10 or more: adding
 * 0x76 then reaches the top bit. */
static inline unsigned mt_count_digits(uint64_t bytes)
{
    uint64_t value = bytes ^ 0x3030303030303030u;
    uint64_t others = (((value & 0x7F7F7F7F7F7F7F7Fu) + 0x7676767676767676u) | value) & 0x8080808080808080u;
    return others ? (unsigned)__builtin_ctzll(others) / 8 : 8;
}

/* The number that eight digits spell: pairs, then fours, then all eight. */
static inline uint32_t mt_eight_digits(uint64_t bytes)
{
    bytes -= 0x3030303030303030u;
    bytes = bytes * 10 + (bytes >> 8);
    bytes = ((bytes & 0x000000FF000000FFu) * (100 + ((uint64_t)1000000 << 32)) +
             ((bytes >> 16) & 0x000000FF000000FFu) * (1 + ((uint64_t)10000 << 32))) >>
            32;
    return (uint32_t)bytes;
}

/* The number that the first `count` of eight bytes spell; count is at least 1. */
static inline uint32_t mt_digits_value(uint64_t bytes, unsigned count)
{
    unsigned shift = 64 - 8 * count;
    uint64_t zeros = shift ? 0x3030303030303030u >> (64 - shift) : 0;
    return mt_eight_digits((bytes << shift) | zeros);
}

/* mantissa / 10^places, correctly rounded; places at most 19. */
double mt_decimal_quotient(uint64_t mantissa, unsigned places);

/* The same, for small numbers at once: one division of two exact doubles rounds once. */
static inline double mt_decimal_value(uint64_t mantissa, unsigned places)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                    1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};
    if (mantissa <= (uint64_t)1 << 53) {
        return (double)(int64_t)mantissa / powers[places];
    }
    return mt_decimal_quotient(mantissa, places);
}

/* Signs come in no order that a branch could foresee. */
static inline double mt_with_sign(double magnitude, bool negative)
{
    uint64_t bits;
    memcpy(&bits, &magnitude, sizeof bits);
    bits |= (uint64_t)negative << 63;
    memcpy(&magnitude, &bits, sizeof bits);
    return magnitude;
}

/* As mt_number_parse, quicker for plain decimals of up to 19 digits. */
static inline mt_number_result mt_scan_number(const char *begin, const char *end, double *number, const char **stop)
{
    const char *at = begin;
    bool negative = *at == '-';
    at += negative;
    const char *digits = at;
    uint64_t mantissa = 0;
    while (mt_is_digit(*at)) {
        mantissa = 10 * mantissa + (uint64_t)(*at++ - '0');
    }
    size_t whole = (size_t)(at - digits), places = 0;
    if (*at == '.') {
        static const uint32_t powers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
        const char *point = ++at;
        unsigned count;
        do {
            uint64_t bytes = mt_load_eight(at);
            count = mt_count_digits(bytes);
            if (count > 0) {
                mantissa = powers[count] * mantissa + mt_digits_value(bytes, count);
            }
            at += count;
        } while (count == 8);
        places = (size_t)(at - point);
    }
    /* 19 digits fit 64 bits. A word that goes on (an exponent, a mistake) and one without digits are for the other. */
    if (whole + places - 1 >= 19 || !mt_is_space(*at)) {
        return mt_number_parse(begin, end, number, stop);
    }
    *number = mt_with_sign(mt_decimal_value(mantissa, (unsigned)places), negative);
    *stop = at;
    return MT_NUMBER_OK;
}

/* begin + count by a branch: numbers that follow one another have as many digits, and what follows the number need then
 * not wait until they are counted. */
static inline const char *mt_foresee_end(const char *begin, unsigned count)
{
    switch (count) {
    case 1:
        return begin + 1;
    case 2:
        return begin + 2;
    case 3:
        return begin + 3;
    case 4:
        return begin + 4;
    case 5:
        return begin + 5;
    case 6:
        return begin + 6;
    case 7:
        return begin + 7;
    default:
        return begin + 8;
    }
}

/* An unsigned decimal number; one of 19 digits and more gives UINT64_MAX. *stop is begin when there is no digit. */
static inline uint64_t mt_scan_unsigned(const char *begin, const char **stop)
{
    uint64_t bytes = mt_load_eight(begin);
    unsigned count = mt_count_digits(bytes);
    if (count == 0) {
        *stop = begin;
        return 0;
    }
    uint64_t value = mt_digits_value(bytes, count);
    const char *at = mt_foresee_end(begin, count);
    if (count == 8) {
        while (mt_is_digit(*at)) {
            value = at - begin < 18 ? 10 * value + (uint64_t)(*at - '0') : UINT64_MAX;
            at++;
        }
    }
    *stop = at;
    return value;
}

#endif
