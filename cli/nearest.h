/* "Did you mean": the known name nearest to a mistyped one. */
#ifndef MESHTOOL_CLI_NEAREST_H
#define MESHTOOL_CLI_NEAREST_H

#include <stddef.h>

/* The name with the fewest insertions, deletions, replacements and swaps to the word, or one that begins with it;
 * NULL when none is near enough to be meant. */
const char *cli_nearest(const char *word, const char *const *names, size_t count);

#endif
