/* The bar on standard error, and what interrupts a run. */
#ifndef MESHTOOL_CLI_PROGRESS_H
#define MESHTOOL_CLI_PROGRESS_H

#include "common.h"

#include <time.h>

struct cli_progress {
    cli_progress_mode mode;
    struct timespec begin, shown;
};
typedef struct cli_progress cli_progress;

/* Begins the clock. */
void cli_progress_init(cli_progress *progress, const cli_common *common);

/* For mt_context_options.progress: shows the bar when it is due; false once a signal asked to stop. */
bool cli_progress_step(void *progress, const char *task, double fraction);

/* Wipes the bar, if one is shown, before something else is printed. */
void cli_progress_clear(void);

/* Ctrl-C and its kin ask the work to stop, so that outputs are cleaned up; a second one ends the program. A pipe
 * without a reader becomes a write that fails. */
void cli_signals_init(void);

/* The signal that asked to stop, 0: none. */
int cli_signal_received(void);

#endif
