/* Help, made from the tables of commands and options. */
#ifndef MESHTOOL_CLI_HELP_H
#define MESHTOOL_CLI_HELP_H

#include "command.h"

/* All commands, a line each. */
void cli_help_text(FILE *out);

/* One command: usage, what it does, its options, the common ones, examples. */
void cli_help_command_text(const cli_command *command, FILE *out);

/* Prints text with lines of at most 100 columns, the second and later ones indented, a line end at the end. The
 * first line begins at column `column`. */
void cli_print_wrapped(FILE *out, const char *text, int column, int indent);

#endif
