/* One run of a command: options into settings, a context, the command, and its exit code. */
#include "help.h"
#include "memory.h"
#include "message.h"
#include "progress.h"

#include <stdlib.h>
#include <string.h>

static cli_exit check_operands(const cli_command *command, const cli_arguments *arguments)
{
    if (arguments->operand_count < command->operand_minimum) {
        return cli_wrong_usage(command, "too few arguments; expected: meshtool %s %s", command->name, command->usage);
    }
    if (arguments->operand_count > command->operand_maximum) {
        const char *extra = arguments->operands[command->operand_maximum];
        return cli_wrong_usage(command, "\"%s\" is one argument too many; expected: meshtool %s %s", extra,
                               command->name, command->usage);
    }
    return CLI_EXIT_DONE;
}

static cli_exit run_in_context(cli_job *job)
{
    const cli_common *common = job->common;
    cli_progress progress;
    cli_progress_init(&progress, common);
    mt_context_options options = {
        .thread_count = common->threads,
        .memory_limit = common->max_memory,
        .explain = common->explain || common->measure,
        .progress = cli_progress_step,
        .progress_user = &progress,
        .warning = cli_print_warning,
        .warning_user = (void *)common,
    };
    job->context = mt_context_create(&options);
    if (!job->context) {
        cli_out_of_memory();
    }
    cli_exit code = job->command->run(job);
    if (common->explain || common->measure) {
        cli_print_parts(job->context, common->json);
    }
    cli_progress_clear();
    mt_context_destroy(job->context);
    return code;
}

cli_exit cli_run(const cli_command *command, int argument_count, const char **arguments)
{
    const cli_option *tables[CLI_TABLE_ROOM];
    cli_option_tables(command->options, command->groups, tables);
    char problem[512];
    cli_arguments parsed;
    cli_common *settings = cli_allocate(1, command->settings_size);
    if (command->defaults) {
        memcpy(settings, command->defaults, command->settings_size);
    }
    cli_exit code = CLI_EXIT_DONE;
    if (!cli_options_parse(argument_count, arguments, tables, settings, &parsed, problem, sizeof problem)) {
        code = cli_wrong_usage(command, "%s", problem);
    } else if (settings->help) {
        cli_help_command_text(command, stdout);
    } else {
        code = check_operands(command, &parsed);
        if (code == CLI_EXIT_DONE) {
            cli_job job = {
                .command = command,
                .settings = settings,
                .common = settings,
                .operands = parsed.operands,
                .operand_count = parsed.operand_count,
            };
            code = run_in_context(&job);
        }
    }
    cli_arguments_release(&parsed);
    free(settings);
    return code;
}
