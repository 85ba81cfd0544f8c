/* What the figures of rows mean, and in which units they stand: for the legend and for the plot's axes. */
#ifndef MESHTOOL_CLI_TRADEOFF_UNIT_H
#define MESHTOOL_CLI_TRADEOFF_UNIT_H

#include "tradeoff/tradeoff.h"

typedef struct tradeoff_unit {
    const char *figures; /* names, a comma and a space between two */
    const char *meaning;
    const char *unit;
} tradeoff_unit;

/* NULL when the figure is not in the table. */
const tradeoff_unit *tradeoff_unit_of(const char *figure);

/* A line for every unit that the table's errors have, in their order. */
void tradeoff_print_units(const tradeoff_table *table);

#endif
