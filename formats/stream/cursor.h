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

/* Whether all eight bytes are digits: '0' to '9' are 0x30 to 0x39, and adding 6 must leave the upper half 3. */
static inline bool mt_are_eight_digits(uint64_t bytes)
{
    return ((bytes & 0xF0F0F0F0F0F0F0F0u) | (((bytes + 0x0606060606060606u) & 0xF0F0F0F0F0F0F0F0u) >> 4)) ==
           0x3333333333333333u;
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
        const char *point = ++at;
        uint64_t bytes = mt_load_eight(at);
        if (mt_are_eight_digits(bytes)) {
            mantissa = 100000000 * mantissa + mt_eight_digits(bytes);
            at += 8;
        }
        while (mt_is_digit(*at)) {
            mantissa = 10 * mantissa + (uint64_t)(*at++ - '0');
        }
        places = (size_t)(at - point);
    }
    /* 19 digits fit 64 bits. A word that goes on (an exponent, a mistake) and one without digits are for the other. */
    if (whole + places - 1 >= 19 || !mt_is_space(*at)) {
        return mt_number_parse(begin, end, number, stop);
    }
    double value = mt_decimal_value(mantissa, (unsigned)places);
    *number = negative ? -value : value;
    *stop = at;
    return MT_NUMBER_OK;
}

/* An unsigned decimal number that does not pass 2^63; past it the result is 2^63 whatever follows. *stop is begin
 * when there is no digit. */
static inline uint64_t mt_scan_unsigned(const char *begin, const char **stop)
{
    const char *at = begin;
    uint64_t value = 0;
    while (mt_is_digit(*at)) {
        value = 10 * value + (uint64_t)(*at++ - '0');
        if (value >= (uint64_t)1 << 59) {
            while (mt_is_digit(*at)) {
                at++;
            }
            value = (uint64_t)1 << 63;
        }
    }
    *stop = at;
    return value;
}

#endif
