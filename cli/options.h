/* Options declared as data: one table makes the parser, the help, and later the completion. */
#ifndef MESHTOOL_CLI_OPTIONS_H
#define MESHTOOL_CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct cli_option cli_option;

/* Turns the text of an option's value (NULL: a flag) into what is stored at `value`; false: not what the option
 * expects. Called in the order of the command line. */
typedef bool (*cli_value_parser)(const cli_option *option, const char *text, void *value);

/* One option. Tables of these end with a record whose letter and name are both zero. */
struct cli_option {
    const char *name;       /* without the dashes; NULL: has a letter alone */
    char letter;            /* 0: none */
    size_t offset;          /* of the value in the command's settings */
    cli_value_parser parse; /* NULL: a flag, a bool set to true */
    const char *argument;   /* the value's name in the help; NULL for flags, which take none */
    const char *expects;    /* "a whole number from 0 to 31": for the message about a wrong value */
    const char *help;
    double minimum, maximum;    /* for numbers */
    const char *const *choices; /* for cli_parse_choice, NULL-terminated */
};

bool cli_parse_text(const cli_option *option, const char *text, void *value);   /* const char *, not empty */
bool cli_parse_count(const cli_option *option, const char *text, void *value);  /* unsigned, minimum to maximum */
bool cli_parse_number(const cli_option *option, const char *text, void *value); /* double, minimum to maximum */
bool cli_parse_size(const cli_option *option, const char *text, void *value);   /* uint64_t bytes: 512M, 2GiB */
bool cli_parse_choice(const cli_option *option, const char *text, void *value); /* unsigned, place in choices */

/* One finite number at the start of *text, which moves past it. */
bool cli_scan_number(const char **text, double *number);
/* `count` finite numbers with commas between them, and nothing more. */
bool cli_scan_numbers(const char *text, size_t count, double *numbers);

/* What parsing leaves: the operands, and the memory behind them and the values. */
typedef struct cli_arguments {
    const char *const *operands;
    size_t operand_count;
    void *parser;
    char **values;
    size_t value_count;
} cli_arguments;

/* Parses the arguments (the first is the command's name) by the tables (a NULL ends them) into settings, which are all
 * zeros to begin with. False: one sentence, without a line end, was put into `problem`. Release *out in both cases. */
bool cli_options_parse(int argument_count, const char **arguments, const cli_option *const *tables, void *settings,
                       cli_arguments *out, char *problem, size_t problem_size);
void cli_arguments_release(cli_arguments *arguments);

#endif
