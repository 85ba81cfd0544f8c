/* Operations on a picture in the order in which the command line names them. */
#ifndef MESHTOOL_CLI_IMAGE_CHAIN_H
#define MESHTOOL_CLI_IMAGE_CHAIN_H

#include "command.h"
#include "json.h"

#include <meshtool/image.h>

#define CLI_CHAIN_ROOM 64

typedef struct cli_image_operation cli_image_operation;

/* One operation with its argument. */
typedef struct cli_image_step {
    const cli_image_operation *operation;
    const char *text; /* as given; NULL for operations without one */
    double number;    /* or the place of a Bayer pattern */
    double color[3];  /* 0 to 1 */
    bool has_color;
} cli_image_step;

typedef struct cli_image_chain {
    cli_image_step steps[CLI_CHAIN_ROOM];
    size_t count;
} cli_image_chain;

/* The parsers of the options: each appends the operation that has the option's name. */
bool cli_chain_parse_flag(const cli_option *option, const char *text, void *value);
bool cli_chain_parse_number(const cli_option *option, const char *text, void *value);
bool cli_chain_parse_pattern(const cli_option *option, const char *text, void *value);
bool cli_chain_parse_background(const cli_option *option, const char *text, void *value);

/* Does all in turn; *image is replaced. A failure is said and returned. */
cli_exit cli_chain_apply(const cli_job *job, const cli_image_chain *chain, mt_image **image);

/* ["hue-shift 30", "gray"] */
json_t *cli_chain_json(const cli_image_chain *chain);

#endif
