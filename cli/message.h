/* What goes to standard error. */
#ifndef MESHTOOL_CLI_MESSAGE_H
#define MESHTOOL_CLI_MESSAGE_H

#include "command.h"

/* "meshtool: COMMAND: sentence", with where its help is; returns CLI_EXIT_USAGE. */
cli_exit cli_wrong_usage(const cli_command *command, const char *format, ...) MT_PRINTF(2, 3);

/* Prints the context's failure and returns its exit code. `file` (may be NULL) names the file at work where the
 * failure itself names none. A reader of our output that went away is no news: nothing is printed. */
cli_exit cli_report_failure(const cli_job *job, const char *file);

/* "meshtool: sentence" when -v is given. */
void cli_say(const cli_job *job, const char *format, ...) MT_PRINTF(2, 3);

/* For mt_context_options.warning; user is the cli_common. */
void cli_print_warning(void *user, const char *sentence);

/* What --explain says, on standard error: a table, or one line of JSON. */
void cli_print_parts(const mt_context *context, bool json);

/* Flushes standard output; a failure is said and returned as CLI_EXIT_IO, otherwise `code` is. */
cli_exit cli_finish_output(cli_exit code);

#endif
