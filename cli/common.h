/* The options that commands share, in groups: a command names the groups that mean something to it. */
#ifndef MESHTOOL_CLI_COMMON_H
#define MESHTOOL_CLI_COMMON_H

#include "options.h"

#include <stdint.h>

typedef enum cli_progress_mode { CLI_PROGRESS_AUTO, CLI_PROGRESS_ALWAYS, CLI_PROGRESS_NEVER } cli_progress_mode;

/* The first member of every command's settings. Enumerations are stored as unsigned (cli_parse_choice). */
typedef struct cli_common {
    bool help, json, quiet, verbose, explain;
    bool measure; /* --explain=measure */
    bool strict_loss, no_clobber, force;
    unsigned threads;
    unsigned precision; /* mt_precision */
    unsigned profile;   /* cli_profile_name */
    unsigned progress;  /* cli_progress_mode */
    unsigned encoding;  /* mt_encoding */
    uint64_t max_memory;
    const char *output, *from, *to;
} cli_common;

typedef enum cli_group {
    CLI_GROUP_OUTPUT = 1u << 0, /* -o */
    CLI_GROUP_WRITE = 1u << 1,  /* --to, --no-clobber */
    CLI_GROUP_MESH = 1u << 2,   /* how a mesh is written: --encoding, --strict-loss */
    CLI_GROUP_READ = 1u << 3,   /* --from */
    CLI_GROUP_PRECISION = 1u << 4,
    CLI_GROUP_WORK = 1u << 5, /* --threads, --max-memory, --progress, --explain */
    CLI_GROUP_EVERY = 1u << 6 /* --json, -q, -v, --help */
} cli_group;

#define CLI_GROUP_COUNT 7
/* Room for a command's own table, those of all groups, and the NULL at the end. */
#define CLI_TABLE_ROOM (CLI_GROUP_COUNT + 2)

/* Fills `tables` with the command's own table (may be NULL) and those of its groups, a NULL at the end. */
void cli_option_tables(const cli_option *own, unsigned groups, const cli_option *tables[CLI_TABLE_ROOM]);

#endif
