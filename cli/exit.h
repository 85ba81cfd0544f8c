/* Exit codes, as scripts rely on them. */
#ifndef MESHTOOL_CLI_EXIT_H
#define MESHTOOL_CLI_EXIT_H

#include <meshtool/types.h>

typedef enum cli_exit {
    CLI_EXIT_DONE = 0,
    CLI_EXIT_NO = 1, /* the check says no */
    CLI_EXIT_USAGE = 2,
    CLI_EXIT_INPUT = 3, /* the input is bad, or not what the operation can take */
    CLI_EXIT_IO = 4,
    CLI_EXIT_LIMIT = 5,  /* memory or a count */
    CLI_EXIT_DEFECT = 6, /* in meshtool */
    CLI_EXIT_SOME = 7,   /* some files of several failed */
    CLI_EXIT_INTERRUPT = 130
} cli_exit;

/* The exit code that goes with a failure of the library. */
cli_exit cli_exit_of(mt_status status);

/* One line for each code, for the help. *count receives their number. */
typedef struct cli_exit_meaning {
    cli_exit code;
    const char *meaning;
} cli_exit_meaning;
const cli_exit_meaning *cli_exit_meanings(size_t *count);

#endif
