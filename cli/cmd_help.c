/* meshtool help: all commands, or one. With --json the tables themselves. */
#include "help.h"
#include "json.h"
#include "message.h"
#include "profile.h"

#include <string.h>

typedef struct help_settings {
    cli_common common;
} help_settings;

static json_t *option_json(const cli_option *option)
{
    char letter[2] = {option->letter, '\0'};
    json_t *object = cli_json_object();
    cli_json_set(object, "name", option->name ? cli_json_text(option->name) : json_null());
    cli_json_set(object, "letter", option->letter ? cli_json_text(letter) : json_null());
    cli_json_set(object, "argument", option->argument ? cli_json_text(option->argument) : json_null());
    cli_json_set(object, "help", cli_json_text(option->help));
    return object;
}

static json_t *command_json(const cli_command *command)
{
    json_t *object = cli_json_object(), *options = cli_json_array();
    const cli_option *tables[CLI_TABLE_ROOM];
    cli_option_tables(command->options, command->groups, tables);
    for (size_t i = 0; tables[i]; i++) {
        for (const cli_option *option = tables[i]; option->name || option->letter; option++) {
            cli_json_append(options, option_json(option));
        }
    }
    cli_json_set(object, "name", cli_json_text(command->name));
    cli_json_set(object, "usage", cli_json_text(command->usage));
    cli_json_set(object, "summary", cli_json_text(command->summary));
    cli_json_set(object, "options", options);
    return object;
}

static cli_exit print_json(const cli_command *one)
{
    json_t *commands = cli_json_array(), *object = cli_json_object();
    for (size_t i = 0; cli_commands[i]; i++) {
        if (!one || one == cli_commands[i]) {
            cli_json_append(commands, command_json(cli_commands[i]));
        }
    }
    cli_json_set(object, "commands", commands);
    cli_json_print_line(object);
    json_decref(object);
    return CLI_EXIT_DONE;
}

static cli_exit run(const cli_job *job)
{
    const cli_command *command = NULL;
    if (job->operand_count == 1 && strcmp(job->operands[0], "profiles") == 0 && !job->common->json) {
        cli_profiles_print(stdout);
        return CLI_EXIT_DONE;
    }
    if (job->operand_count == 1) {
        command = cli_find_command(job->operands[0]);
        if (!command) {
            return cli_unknown_command(job->operands[0]);
        }
    }
    if (job->common->json) {
        return print_json(command);
    }
    if (command) {
        cli_help_command_text(command, stdout);
    } else {
        cli_help_text(stdout);
    }
    return CLI_EXIT_DONE;
}

const cli_command cli_help_command = {
    .name = "help",
    .usage = "[COMMAND | profiles]",
    .summary = "Explain meshtool, one command, or the profiles",
    .examples = "  meshtool help check-manifold\n"
                "  meshtool help profiles\n",
    .groups = CLI_GROUP_EVERY,
    .settings_size = sizeof(help_settings),
    .operand_maximum = 1,
    .run = run,
};
