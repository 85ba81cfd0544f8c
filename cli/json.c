/* jansson prints reals with 17 digits at best (0.1 becomes 0.10000000000000001), so printing is done here; what it
 * prints is as deep as our own trees. */
#include "json.h"

#include "memory.h"
#include "progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *checked(json_t *value)
{
    if (!value) {
        cli_out_of_memory();
    }
    return value;
}

json_t *cli_json_object(void)
{
    return checked(json_object());
}

json_t *cli_json_array(void)
{
    return checked(json_array());
}

json_t *cli_json_integer(int64_t number)
{
    return checked(json_integer(number));
}

json_t *cli_json_real(double number)
{
    return isfinite(number) ? checked(json_real(number)) : json_null();
}

json_t *cli_json_text(const char *text)
{
    json_t *value = json_string(text);
    if (value) {
        return value;
    }
    static const char replacement[] = "\xEF\xBF\xBD";
    char *valid = cli_allocate(strlen(text) + 1, 3);
    char *end = valid;
    while (*text) {
        size_t length = 1;
        while (length <= 4 && memchr(text, 0, length) == NULL && !(value = json_stringn(text, length))) {
            length++;
        }
        size_t kept = value ? length : sizeof replacement - 1;
        memcpy(end, value ? text : replacement, kept);
        end += kept;
        text += value ? length : 1;
        json_decref(value);
        value = NULL;
    }
    value = json_string(valid);
    free(valid);
    return checked(value);
}

void cli_json_set(json_t *object, const char *key, json_t *value)
{
    if (json_object_set_new(object, key, value) != 0) {
        cli_out_of_memory();
    }
}

void cli_json_append(json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0) {
        cli_out_of_memory();
    }
}

/* The fewest digits that read back as the same double, and a mark that it is no integer. */
static void print_real(FILE *out, double number)
{
    char text[40];
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number) {
            break;
        }
    }
    fprintf(out, strpbrk(text, ".e") ? "%s" : "%s.0", text);
}

static void print_array(FILE *out, const json_t *array)
{
    fputc('[', out);
    for (size_t i = 0; i < json_array_size(array); i++) {
        fputs(i == 0 ? "" : ", ", out);
        cli_json_print(out, json_array_get(array, i));
    }
    fputc(']', out);
}

void cli_json_print_open(FILE *out, const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    const char *separator = "{";
    json_object_foreach((json_t *)object, key, value)
    {
        fprintf(out, "%s\"%s\": ", separator, key);
        cli_json_print(out, value);
        separator = ", ";
    }
    if (*separator == '{') {
        fputc('{', out);
    }
}

void cli_json_print(FILE *out, const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        cli_json_print_open(out, value);
        fputc('}', out);
        break;
    case JSON_ARRAY:
        print_array(out, value);
        break;
    case JSON_REAL:
        print_real(out, json_real_value(value));
        break;
    default:
        if (json_dumpf(value, out, JSON_ENCODE_ANY) != 0 && !ferror(out)) {
            cli_out_of_memory();
        }
    }
}

void cli_json_print_line(const json_t *value)
{
    cli_progress_clear();
    cli_json_print(stdout, value);
    fputc('\n', stdout);
}
