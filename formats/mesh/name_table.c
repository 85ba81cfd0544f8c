#include "formats/mesh/name_table.h"

#include <string.h>

/* FNV-1a. */
static uint64_t hash_name(const char *name)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *name; name++) {
        hash = (hash ^ (uint8_t)*name) * 0x100000001b3u;
    }
    return hash ^ (hash >> 32);
}

static mt_index *find_slot(const mt_name_table *table, const mt_labels *labels, const char *name)
{
    uint64_t at = hash_name(name) & (table->capacity - 1);
    while (table->slots[at] != MT_NONE && strcmp(labels->names[table->slots[at]], name) != 0) {
        at = (at + 1) & (table->capacity - 1);
    }
    return &table->slots[at];
}

/* Half of the slots stay free. */
static mt_status make_room(mt_context *context, mt_name_table *table, const mt_labels *labels)
{
    if (2 * ((uint64_t)labels->name_count + 1) <= table->capacity) {
        return MT_OK;
    }
    mt_name_table grown = {.capacity = table->capacity ? 2 * table->capacity : 16};
    grown.slots = mt_allocate_array(context, grown.capacity, sizeof *grown.slots);
    if (!grown.slots) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(grown.slots, 0xFF, grown.capacity * sizeof *grown.slots);
    for (mt_index number = 0; number < labels->name_count; number++) {
        *find_slot(&grown, labels, labels->names[number]) = number;
    }
    mt_name_table_release(context, table);
    *table = grown;
    return MT_OK;
}

mt_status mt_name_table_find_or_add(mt_context *context, mt_name_table *table, mt_labels *labels, const char *name,
                                    mt_index *out)
{
    mt_status status = make_room(context, table, labels);
    if (status != MT_OK) {
        return status;
    }
    mt_index *slot = find_slot(table, labels, name);
    if (*slot == MT_NONE) {
        status = mt_labels_add_name(context, labels, name, out);
        *slot = status == MT_OK ? *out : MT_NONE;
        return status;
    }
    *out = *slot;
    return MT_OK;
}

void mt_name_table_release(mt_context *context, mt_name_table *table)
{
    mt_free(context, table->slots);
    *table = (mt_name_table){0};
}
