/* A command: one record in the table, one file with what it does. */
#ifndef MESHTOOL_CLI_COMMAND_H
#define MESHTOOL_CLI_COMMAND_H

#include "common.h"
#include "exit.h"

#include <meshtool/context.h>

typedef struct cli_command cli_command;

/* One run of a command. */
typedef struct cli_job {
    const cli_command *command;
    const void *settings;     /* the command's own struct */
    const cli_common *common; /* its first member */
    const char *const *operands;
    size_t operand_count;
    mt_context *context;
} cli_job;

struct cli_command {
    const char *name;
    const char *usage;         /* the operands and what else is needed: "IN -o OUT" */
    const char *summary;       /* one line, for the list of commands */
    const char *description;   /* paragraphs below it in the command's own help; may be NULL */
    const char *examples;      /* lines, each a call */
    const cli_option *options; /* its own; may be NULL */
    unsigned groups;           /* cli_group: the common options that it takes */
    size_t settings_size;      /* of its settings, which begin with a cli_common */
    const void *defaults;      /* settings to begin with; NULL: all zeros */
    size_t operand_minimum, operand_maximum;
    void (*print_help)(FILE *out); /* a last part of the help, made from other tables; may be NULL */
    cli_exit (*run)(const cli_job *job);
};

/* The table, NULL-terminated, in the order of the help. */
extern const cli_command *const cli_commands[];

/* The command of that name, or NULL. */
const cli_command *cli_find_command(const char *name);
/* Says that there is no such command, which one may be meant, and which are known. */
cli_exit cli_unknown_command(const char *name);

/* Runs a command with its arguments, of which the first is its name. */
cli_exit cli_run(const cli_command *command, int argument_count, const char **arguments);

/* Does each operand in turn, whatever became of the others. The exit code of the only one; of several
 * CLI_EXIT_SOME when one failed, else CLI_EXIT_NO when one says no. */
cli_exit cli_for_each_file(const cli_job *job, cli_exit (*work)(const cli_job *job, const char *file));

/* The commands' records. */
extern const cli_command cli_check_manifold_command;
extern const cli_command cli_convert_command;
extern const cli_command cli_distance_command;
extern const cli_command cli_formats_command;
extern const cli_command cli_generate_command;
extern const cli_command cli_help_command;
extern const cli_command cli_image_command;
extern const cli_command cli_info_command;
extern const cli_command cli_normals_command;
extern const cli_command cli_preview_command;
extern const cli_command cli_render_command;
extern const cli_command cli_repair_command;
extern const cli_command cli_strips_command;
extern const cli_command cli_subdivide_command;
extern const cli_command cli_topology_command;
extern const cli_command cli_tradeoff_command;

#endif
