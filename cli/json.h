/* JSON for scripts: trees by jansson, printed on one line with numbers that read back as the same double. */
#ifndef MESHTOOL_CLI_JSON_H
#define MESHTOOL_CLI_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* New values; never NULL. */
json_t *cli_json_object(void);
json_t *cli_json_array(void);
json_t *cli_json_integer(int64_t number);
json_t *cli_json_real(double number);    /* null when not finite */
json_t *cli_json_text(const char *text); /* bytes that are no UTF-8 become U+FFFD */

/* Add a value, which then belongs to the object or array. */
void cli_json_set(json_t *object, const char *key, json_t *value);
void cli_json_append(json_t *array, json_t *value);

/* Prints a value without a line end. */
void cli_json_print(FILE *out, const json_t *value);
/* Prints a value and a line end on standard output. */
void cli_json_print_line(const json_t *value);
/* Prints an object up to its closing brace, so that long lists can follow piece by piece. */
void cli_json_print_open(FILE *out, const json_t *object);

#endif
