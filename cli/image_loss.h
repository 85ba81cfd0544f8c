/* What a written picture does not hold of the one that it was made from. */
#ifndef MESHTOOL_CLI_IMAGE_LOSS_H
#define MESHTOOL_CLI_IMAGE_LOSS_H

#include "command.h"
#include "json.h"

#include <meshtool/image_format.h>

typedef struct cli_image_loss {
    const mt_image_format *format;
    unsigned bits, bits_before; /* written, and in the file that was read */
    uint64_t outside;           /* samples that integers cannot come near */
} cli_image_loss;

/* Finds it before anything is written; --strict-loss makes it a failure, which is said. */
cli_exit cli_image_loss_find(const cli_job *job, const mt_image *image, const char *path,
                             const mt_image_write_options *how, cli_image_loss *loss);

/* Warns of it. */
void cli_image_loss_warn(const cli_job *job, const char *path, const cli_image_loss *loss);

/* The list of it: an array of texts, the caller's. */
json_t *cli_image_loss_json(const cli_image_loss *loss);

#endif
