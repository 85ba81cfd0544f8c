#include "exit.h"

cli_exit cli_exit_of(mt_status status)
{
    static const cli_exit codes[] = {
        [MT_OK] = CLI_EXIT_DONE,
        [MT_ERROR_ARGUMENT] = CLI_EXIT_USAGE,
        [MT_ERROR_SYNTAX] = CLI_EXIT_INPUT,
        [MT_ERROR_UNSUPPORTED] = CLI_EXIT_INPUT,
        [MT_ERROR_INVALID_MESH] = CLI_EXIT_INPUT,
        [MT_ERROR_NOT_MANIFOLD] = CLI_EXIT_INPUT,
        [MT_ERROR_NOT_ORIENTED] = CLI_EXIT_INPUT,
        [MT_ERROR_LOSS] = CLI_EXIT_INPUT,
        [MT_ERROR_IO] = CLI_EXIT_IO,
        [MT_ERROR_OUT_OF_MEMORY] = CLI_EXIT_LIMIT,
        [MT_ERROR_TOO_LARGE] = CLI_EXIT_LIMIT,
        [MT_ERROR_CANCELLED] = CLI_EXIT_INTERRUPT,
        [MT_ERROR_INTERNAL] = CLI_EXIT_DEFECT,
    };
    size_t known = sizeof codes / sizeof codes[0];
    return (size_t)status < known ? codes[status] : CLI_EXIT_DEFECT;
}

const cli_exit_meaning *cli_exit_meanings(size_t *count)
{
    static const cli_exit_meaning meanings[] = {
        {CLI_EXIT_DONE, "done, or the property holds"},
        {CLI_EXIT_NO, "the check says no"},
        {CLI_EXIT_USAGE, "wrong usage"},
        {CLI_EXIT_INPUT, "the input is bad, or not what the operation can take"},
        {CLI_EXIT_IO, "reading or writing failed"},
        {CLI_EXIT_LIMIT, "a limit was hit (memory, count)"},
        {CLI_EXIT_DEFECT, "a defect in meshtool"},
        {CLI_EXIT_SOME, "some files of several failed"},
    };
    *count = sizeof meanings / sizeof meanings[0];
    return meanings;
}
