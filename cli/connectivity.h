/* The connectivity structures behind one table: how each is made, what it holds, and its arrays row by row. */
#ifndef MESHTOOL_CLI_CONNECTIVITY_H
#define MESHTOOL_CLI_CONNECTIVITY_H

#include <meshtool/mesh.h>

#define CLI_TABLE_COLUMNS 9

/* An array of a structure, as a table: each row has the elements' numbers of its columns, MT_NONE where there is none.
 */
typedef struct cli_table {
    const char *key;     /* "edges" */
    const char *element; /* "edge": what a row is about */
    const char *columns[CLI_TABLE_COLUMNS + 1];
    unsigned bytes; /* that the structure keeps for one element */
    mt_index (*count)(const void *structure);
    void (*row)(const void *structure, mt_index element, mt_index values[CLI_TABLE_COLUMNS]);
} cli_table;

#define CLI_CONNECTIVITY_TABLES 3

typedef struct cli_connectivity {
    const char *name; /* as --structure takes it */
    mt_status (*create)(mt_context *context, const mt_mesh *mesh, void **out);
    void (*destroy)(mt_context *context, void *structure);
    uint64_t (*size)(const void *structure);
    mt_index (*edge_count)(const void *structure);
    mt_index (*boundary_count)(const void *structure); /* edges */
    cli_table tables[CLI_CONNECTIVITY_TABLES];         /* fewer: a NULL key follows */
} cli_connectivity;

#define CLI_CONNECTIVITY_COUNT 3
extern const cli_connectivity cli_connectivities[CLI_CONNECTIVITY_COUNT];

#endif
