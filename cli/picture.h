/* Options that pictures share. */
#ifndef MESHTOOL_CLI_PICTURE_H
#define MESHTOOL_CLI_PICTURE_H

#include "options.h"

#include <stdint.h>

typedef struct cli_picture_size {
    uint32_t width, height;
} cli_picture_size;

bool cli_parse_picture_size(const cli_option *option, const char *text, void *value); /* cli_picture_size */
bool cli_parse_samples(const cli_option *option, const char *text, void *value);      /* unsigned */

#endif
