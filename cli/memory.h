/* Memory of the command itself (tables, JSON): small, so that its lack ends the program with exit code 5. */
#ifndef MESHTOOL_CLI_MEMORY_H
#define MESHTOOL_CLI_MEMORY_H

#include <stddef.h>

/* A zeroed array, never NULL; freed with free. */
void *cli_allocate(size_t count, size_t size);

/* Says that memory is missing and ends the program. No output file is open when this is called. */
_Noreturn void cli_out_of_memory(void);

#endif
