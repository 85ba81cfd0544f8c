/* Commands that take several FILEs: each is done, whatever became of the others. */
#include "message.h"

cli_exit cli_for_each_file(const cli_job *job, cli_exit (*work)(const cli_job *job, const char *file))
{
    size_t failed = 0;
    cli_exit code = CLI_EXIT_DONE;
    bool says_no = false;
    for (size_t i = 0; i < job->operand_count; i++) {
        mt_context_clear_error(job->context);
        code = work(job, job->operands[i]);
        if (code == CLI_EXIT_INTERRUPT) {
            return code;
        }
        says_no |= code == CLI_EXIT_NO;
        failed += code > CLI_EXIT_NO;
    }
    if (job->operand_count == 1) {
        return code;
    }
    return failed ? CLI_EXIT_SOME : says_no ? CLI_EXIT_NO : CLI_EXIT_DONE;
}
