/* Numbers for pairs of indices: which corner a face has at a vertex, which value lies on an edge. Open addressing. */
#ifndef MT_TOPOLOGY_PAIR_TABLE_H
#define MT_TOPOLOGY_PAIR_TABLE_H

#include <meshtool/context.h>

typedef struct mt_pair_table {
    uint64_t mask; /* room - 1, a power of two */
    uint64_t *keys;
    mt_index *numbers;
} mt_pair_table;

/* Room for `count` pairs. */
mt_status mt_pair_table_init(mt_context *context, mt_pair_table *table, uint64_t count);
void mt_pair_table_release(mt_context *context, mt_pair_table *table);

/* The number of a pair, NULL when the table does not have it. */
mt_index *mt_pair_table_find(const mt_pair_table *table, mt_index first, mt_index second);
/* The same, but a pair that is not there is put in with `number`. Not more than there is room for. */
mt_index *mt_pair_table_add(mt_pair_table *table, mt_index first, mt_index second, mt_index number);

#endif
