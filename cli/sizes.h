/* What each structure and each file format takes for the positions and faces of a mesh: by formula, and measured. */
#ifndef MESHTOOL_CLI_SIZES_H
#define MESHTOOL_CLI_SIZES_H

#include "command.h"
#include "json.h"

#include <meshtool/storage.h>

#define CLI_SIZES_ROOM 64

/* Whether a size was measured, and why not. */
typedef enum cli_size_state { CLI_SIZE_NOT_ASKED, CLI_SIZE_MEASURED, CLI_SIZE_IMPOSSIBLE } cli_size_state;

typedef struct cli_size {
    const char *key, *words, *formula;
    bool of_format, has_bytes; /* has_bytes: there is a formula for them */
    uint64_t units, bytes, measured;
    cli_size_state state;
} cli_size;

typedef struct cli_sizes {
    cli_size rows[CLI_SIZES_ROOM];
    size_t count;
    bool measured;
} cli_sizes;

/* Fills all rows. measure: builds and writes each in memory; one that cannot hold the mesh is marked, any other failure
 * said and returned. */
cli_exit cli_sizes_find(const cli_job *job, const char *file, const mt_mesh *mesh, bool measure, cli_sizes *sizes);

/* {key: {units, bytes, measured}}, formats under "formats"; measured null where it cannot be, absent where not asked.
 */
json_t *cli_sizes_json(const cli_sizes *sizes);
void cli_sizes_print(const cli_sizes *sizes);

/* {units, bytes} */
json_t *cli_size_json(uint64_t units, uint64_t bytes);

#endif
