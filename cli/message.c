#include "message.h"

#include "progress.h"
#include "quantity.h"

#include <errno.h>
#include <poll.h>
#include <stdarg.h>
#include <string.h>
#include <unistd.h>

cli_exit cli_wrong_usage(const cli_command *command, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "meshtool: %s: ", command->name);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, "\nTry: meshtool %s --help\n", command->name);
    return CLI_EXIT_USAGE;
}

/* Whether standard output is a pipe whose reader has gone. */
static bool output_has_no_reader(void)
{
    struct pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR);
}

cli_exit cli_report_failure(const cli_job *job, const char *file)
{
    const mt_error *error = mt_context_error(job->context);
    cli_progress_clear();
    if (error->status == MT_ERROR_IO && output_has_no_reader()) {
        return CLI_EXIT_IO;
    }
    if (error->status == MT_ERROR_CANCELLED) {
        fputs("meshtool: interrupted; nothing was written\n", stderr);
        return CLI_EXIT_INTERRUPT;
    }
    bool names_file = !file || error->place.file || strstr(error->message, file);
    fprintf(stderr, "meshtool: %s%s%s", names_file ? "" : file, names_file ? "" : ": ", error->message);
    if (error->status == MT_ERROR_OUT_OF_MEMORY && job->common->max_memory && !strstr(error->message, "limit")) {
        fprintf(stderr, " (--max-memory is %s)", cli_bytes(job->common->max_memory).text);
    }
    fputc('\n', stderr);
    return cli_exit_of(error->status);
}

void cli_say(const cli_job *job, const char *format, ...)
{
    if (!job->common->verbose) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    cli_progress_clear();
    fputs("meshtool: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

void cli_print_warning(void *user, const char *sentence)
{
    const cli_common *common = user;
    if (!common->quiet) {
        cli_progress_clear();
        fprintf(stderr, "meshtool: warning: %s\n", sentence);
    }
}

cli_exit cli_finish_output(cli_exit code)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return code;
    }
    if (errno != EPIPE) {
        fprintf(stderr, "meshtool: standard output: %s\n", errno ? strerror(errno) : "writing failed");
    }
    return CLI_EXIT_IO;
}
