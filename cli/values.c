/* The values of options: text to numbers, sizes and choices. The C locale stands, as nothing sets another. */
#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool cli_parse_text(const cli_option *option, const char *text, void *value)
{
    (void)option;
    *(const char **)value = text;
    return *text != '\0';
}

bool cli_parse_count(const cli_option *option, const char *text, void *value)
{
    if (*text < '0' || *text > '9') {
        return false;
    }
    char *end = NULL;
    errno = 0;
    unsigned long long number = strtoull(text, &end, 10);
    if (errno || *end || (double)number < option->minimum || (double)number > option->maximum) {
        return false;
    }
    *(unsigned *)value = (unsigned)number;
    return true;
}

bool cli_scan_number(const char **text, double *number)
{
    if (!strchr("+-.0123456789", **text) || !**text) {
        return false; /* strtod would skip spaces and take "nan" */
    }
    char *end = NULL;
    *number = strtod(*text, &end);
    bool found = end != *text && isfinite(*number);
    *text = end;
    return found;
}

bool cli_scan_numbers(const char *text, size_t count, double *numbers)
{
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && *text++ != ',') {
            return false;
        }
        if (!cli_scan_number(&text, &numbers[i])) {
            return false;
        }
    }
    return *text == '\0';
}

bool cli_parse_number(const cli_option *option, const char *text, void *value)
{
    double number = 0;
    if (!cli_scan_numbers(text, 1, &number) || number < option->minimum || number > option->maximum) {
        return false;
    }
    *(double *)value = number;
    return true;
}

/* K and KiB are 1024, KB is 1000, as the core utilities have it. 0 when it is no suffix. */
static double suffix_factor(const char *suffix)
{
    static const char letters[] = "KMGT";
    if (*suffix == '\0' || strcasecmp(suffix, "B") == 0) {
        return 1;
    }
    const char *letter = strchr(letters, *suffix & ~0x20);
    if (!letter || !*letter) {
        return 0;
    }
    const char *rest = suffix + 1;
    bool is_decimal = strcasecmp(rest, "B") == 0;
    if (*rest && !is_decimal && strcasecmp(rest, "iB") != 0) {
        return 0;
    }
    double factor = 1;
    for (long i = 0; i <= letter - letters; i++) {
        factor *= is_decimal ? 1000 : 1024;
    }
    return factor;
}

bool cli_parse_size(const cli_option *option, const char *text, void *value)
{
    (void)option;
    double number = 0;
    if (*text == '-' || !cli_scan_number(&text, &number)) {
        return false;
    }
    double bytes = number * suffix_factor(text);
    if (!(bytes >= 1) || bytes >= 0x1p63) {
        return false;
    }
    *(uint64_t *)value = (uint64_t)bytes;
    return true;
}

bool cli_parse_choice(const cli_option *option, const char *text, void *value)
{
    for (unsigned i = 0; option->choices[i]; i++) {
        if (strcmp(text, option->choices[i]) == 0) {
            *(unsigned *)value = i;
            return true;
        }
    }
    return false;
}
