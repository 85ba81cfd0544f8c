/* Numbers in text, whatever the locale: read correctly rounded, written shortest round-trip. A C++ shim over
 * std::from_chars and std::to_chars; no exception leaves it, nothing is allocated. */
#ifndef MESHTOOL_STREAM_NUMBER_H
#define MESHTOOL_STREAM_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_number_result {
    MT_NUMBER_OK,
    MT_NUMBER_MISSING,  /* no number starts here */
    MT_NUMBER_TOO_LARGE /* past the largest double; too small is a zero or a subnormal and OK */
} mt_number_result;

/* Parses a decimal number ("+1", "-.5", "1e-3", "nan", "inf") at the start of [begin, end); *stop receives
 * the first byte after it. No leading space is skipped. */
mt_number_result mt_number_parse(const char *begin, const char *end, double *number, const char **stop);

/* The same as a float, correctly rounded where rounding the double again would not be; false when it is no number or
 * out of a float's range. */
bool mt_number_parse_float(const char *begin, const char *end, float *number);

/* The shortest text that reads back as the same number; returns its length, without a final zero byte.
 * `text` has room for MT_NUMBER_ROOM bytes. The float form is shortest for a float. */
#define MT_NUMBER_ROOM 32
size_t mt_number_print(double number, char *text);
size_t mt_number_print_float(float number, char *text);
/* The same with at most `digits` significant digits (1 to 17), correctly rounded. */
size_t mt_number_print_digits(double number, unsigned digits, char *text);

#ifdef __cplusplus
}
#endif
#endif
