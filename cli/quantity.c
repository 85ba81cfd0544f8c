#include "quantity.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

cli_quantity cli_count(int64_t number)
{
    char digits[32];
    uint64_t magnitude = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
    int length = snprintf(digits, sizeof digits, "%" PRIu64, magnitude);
    cli_quantity quantity = {{0}};
    char *end = quantity.text;
    if (number < 0) {
        *end++ = '-';
    }
    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0) {
            *end++ = ',';
        }
        *end++ = digits[i];
    }
    return quantity;
}

static bool ends_with(const char *text, const char *ending)
{
    size_t length = strlen(text), ending_length = strlen(ending);
    return length >= ending_length && strcmp(text + length - ending_length, ending) == 0;
}

cli_quantity cli_plural(uint64_t number, const char *noun)
{
    cli_quantity quantity;
    int length = (int)strlen(noun);
    if (number == 1) {
        snprintf(quantity.text, sizeof quantity.text, "%s", noun);
    } else if (ends_with(noun, "ex")) {
        snprintf(quantity.text, sizeof quantity.text, "%.*sices", length - 2, noun);
    } else if (ends_with(noun, "dy") || ends_with(noun, "ry")) {
        snprintf(quantity.text, sizeof quantity.text, "%.*sies", length - 1, noun);
    } else if (ends_with(noun, "ch")) {
        snprintf(quantity.text, sizeof quantity.text, "%ses", noun);
    } else {
        snprintf(quantity.text, sizeof quantity.text, "%ss", noun);
    }
    return quantity;
}

cli_quantity cli_counted(uint64_t number, const char *noun)
{
    cli_quantity quantity;
    snprintf(quantity.text, sizeof quantity.text, "%.30s %.80s", cli_count((int64_t)number).text,
             cli_plural(number, noun).text);
    return quantity;
}

cli_quantity cli_bytes(uint64_t bytes)
{
    static const char *const units[] = {"kB", "MB", "GB", "TB", "PB", "EB"};
    if (bytes < 1000) {
        return cli_counted(bytes, "byte");
    }
    double value = (double)bytes / 1000;
    size_t unit = 0;
    while (value >= 999.95 && unit + 1 < sizeof units / sizeof units[0]) {
        value /= 1000;
        unit++;
    }
    cli_quantity quantity;
    snprintf(quantity.text, sizeof quantity.text, "%.1f %s", value, units[unit]);
    return quantity;
}

cli_quantity cli_real(double number)
{
    cli_quantity quantity;
    snprintf(quantity.text, sizeof quantity.text, "%.6g", number);
    return quantity;
}

cli_quantity cli_point(mt_vec3 point)
{
    cli_quantity quantity;
    snprintf(quantity.text, sizeof quantity.text, "(%.6g, %.6g, %.6g)", point.x, point.y, point.z);
    return quantity;
}
