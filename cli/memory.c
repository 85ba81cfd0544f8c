#include "memory.h"

#include "exit.h"

#include <stdio.h>
#include <stdlib.h>

void *cli_allocate(size_t count, size_t size)
{
    void *block = calloc(count, size);
    if (!block) {
        cli_out_of_memory();
    }
    return block;
}

_Noreturn void cli_out_of_memory(void)
{
    fputs("meshtool: out of memory\n", stderr);
    exit(CLI_EXIT_LIMIT);
}
