/* meshtool: check, mend, refine, measure and see meshes. */
#include "help.h"
#include "message.h"
#include "progress.h"

#include <string.h>

static cli_exit dispatch(int argument_count, const char **arguments)
{
    if (argument_count < 2) {
        cli_help_text(stderr);
        return CLI_EXIT_USAGE;
    }
    const char *name = arguments[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        cli_help_text(stdout);
        return CLI_EXIT_DONE;
    }
    if (strcmp(name, "--version") == 0) {
        puts("meshtool " MESHTOOL_VERSION);
        return CLI_EXIT_DONE;
    }
    if (*name == '-') {
        fprintf(stderr, "meshtool: \"%s\" stands where the command should; options come after it\n", name);
        fputs("Try: meshtool --help\n", stderr);
        return CLI_EXIT_USAGE;
    }
    const cli_command *command = cli_find_command(name);
    return command ? cli_run(command, argument_count - 1, arguments + 1) : cli_unknown_command(name);
}

int main(int argument_count, char **arguments)
{
    cli_signals_init();
    cli_exit code = cli_finish_output(dispatch(argument_count, (const char **)arguments));
    if (code == CLI_EXIT_INTERRUPT && cli_signal_received()) {
        return 128 + cli_signal_received();
    }
    return (int)code;
}
