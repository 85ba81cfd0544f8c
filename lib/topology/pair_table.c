#include "lib/topology/pair_table.h"

#include <string.h>

#define EMPTY UINT64_MAX /* no pair: MT_NONE twice */

mt_status mt_pair_table_init(mt_context *context, mt_pair_table *table, uint64_t count)
{
    uint64_t room = 16;
    while (room < 2 * count) {
        room *= 2;
    }
    *table = (mt_pair_table){.mask = room - 1};
    table->keys = mt_allocate_array(context, room, sizeof *table->keys);
    table->numbers = mt_allocate_array(context, room, sizeof *table->numbers);
    if (!table->keys || !table->numbers) {
        mt_pair_table_release(context, table);
        return mt_context_error(context)->status;
    }
    memset(table->keys, 0xff, room * sizeof *table->keys);
    return MT_OK;
}

void mt_pair_table_release(mt_context *context, mt_pair_table *table)
{
    mt_free(context, table->keys);
    mt_free(context, table->numbers);
    *table = (mt_pair_table){0};
}

static uint64_t place_of(const mt_pair_table *table, uint64_t key)
{
    uint64_t mixed = key * 0x9e3779b97f4a7c15u;
    uint64_t place = (mixed ^ mixed >> 29) & table->mask;
    while (table->keys[place] != key && table->keys[place] != EMPTY) {
        place = (place + 1) & table->mask;
    }
    return place;
}

mt_index *mt_pair_table_find(const mt_pair_table *table, mt_index first, mt_index second)
{
    uint64_t place = place_of(table, (uint64_t)first << 32 | second);
    return table->keys[place] == EMPTY ? NULL : &table->numbers[place];
}

mt_index *mt_pair_table_add(mt_pair_table *table, mt_index first, mt_index second, mt_index number)
{
    uint64_t key = (uint64_t)first << 32 | second, place = place_of(table, key);
    if (table->keys[place] == EMPTY) {
        table->keys[place] = key;
        table->numbers[place] = number;
    }
    return &table->numbers[place];
}
