#include "help.h"

#include <string.h>

#define LINE_WIDTH 100
#define OPTION_COLUMN 28 /* where the words about an option begin */

void cli_print_wrapped(FILE *out, const char *text, int column, int indent)
{
    while (*text) {
        int length = (int)strcspn(text, " \n");
        if (column > indent && column + 1 + length > LINE_WIDTH) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            fputc(' ', out);
            column++;
        }
        fprintf(out, "%.*s", length, text);
        column += length;
        text += length;
        if (*text == '\n') {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        }
        text += *text ? 1 : 0;
    }
    fputc('\n', out);
}

static void print_option(FILE *out, const cli_option *option)
{
    char left[80];
    char letter[8] = "";
    if (option->letter) {
        snprintf(letter, sizeof letter, "-%c%s", option->letter, option->name ? "," : "");
    }
    snprintf(left, sizeof left, "  %3s %s%s%s%s", letter, option->name ? "--" : "", option->name ? option->name : "",
             option->argument ? " " : "", option->argument ? option->argument : "");
    int column = fprintf(out, "%s", left);
    if (column >= OPTION_COLUMN) {
        fputc('\n', out);
        column = 0;
    }
    fprintf(out, "%*s", OPTION_COLUMN - column, "");
    cli_print_wrapped(out, option->help, OPTION_COLUMN, OPTION_COLUMN);
}

static void print_table(FILE *out, const cli_option *table)
{
    for (; table->name || table->letter; table++) {
        print_option(out, table);
    }
}

void cli_help_command_text(const cli_command *command, FILE *out)
{
    fprintf(out, "usage: meshtool %s %s\n\n", command->name, command->usage);
    cli_print_wrapped(out, command->summary, 0, 0);
    if (command->description) {
        fputc('\n', out);
        cli_print_wrapped(out, command->description, 0, 0);
    }
    if (command->options) {
        fputs("\nOptions:\n", out);
        print_table(out, command->options);
    }
    fputs("\nCommon options:\n", out);
    const cli_option *tables[CLI_TABLE_ROOM];
    cli_option_tables(NULL, command->groups, tables);
    for (size_t i = 0; tables[i]; i++) {
        print_table(out, tables[i]);
    }
    if (command->print_help) {
        fputc('\n', out);
        command->print_help(out);
    }
    if (command->examples) {
        fprintf(out, "\nExamples:\n%s", command->examples);
    }
}

void cli_help_text(FILE *out)
{
    fputs("usage: meshtool COMMAND [OPTIONS] FILE...\n\n"
          "Check, mend, refine, measure and see meshes.\n\nCommands:\n",
          out);
    for (size_t i = 0; cli_commands[i]; i++) {
        fprintf(out, "  %-16s %s\n", cli_commands[i]->name, cli_commands[i]->summary);
    }
    fputs("\nFor one of them: meshtool COMMAND --help\n"
          "For the version: meshtool --version\n"
          "A FILE named - is standard input or output.\n\nExit codes:\n",
          out);
    size_t count = 0;
    const cli_exit_meaning *meanings = cli_exit_meanings(&count);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "  %d  %s\n", meanings[i].code, meanings[i].meaning);
    }
}
