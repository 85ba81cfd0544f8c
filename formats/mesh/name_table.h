/* Names of a label set found again in constant time, by open addressing. */
#ifndef MESHTOOL_MESH_NAME_TABLE_H
#define MESHTOOL_MESH_NAME_TABLE_H

#include <meshtool/mesh.h>

typedef struct mt_name_table {
    uint64_t capacity; /* a power of two; 0 to begin with */
    mt_index *slots;   /* numbers of names, MT_NONE: free */
} mt_name_table;

/* The number of the name in the label set, which it is added to if it is not there. The table must have seen every
 * name of the set. All zeros is an empty table. */
mt_status mt_name_table_find_or_add(mt_context *context, mt_name_table *table, mt_labels *labels, const char *name,
                                    mt_index *out);
void mt_name_table_release(mt_context *context, mt_name_table *table);

#endif
