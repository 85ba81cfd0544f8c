#include "lib/algorithms/edge_set.h"

#include <string.h>

static uint64_t key_of(mt_index a, mt_index b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* Where the key is or would go. */
static uint64_t slot_of(const edge_set *set, uint64_t key)
{
    uint64_t hash = key * 0x9e3779b97f4a7c15u;
    uint64_t slot = (hash ^ hash >> 32) & (set->capacity - 1);
    while (set->keys[slot] != key && set->keys[slot] != UINT64_MAX) {
        slot = (slot + 1) & (set->capacity - 1);
    }
    return slot;
}

static mt_status grow(mt_context *context, edge_set *set)
{
    edge_set larger = {.count = set->count, .capacity = set->capacity ? 2 * set->capacity : 64};
    larger.keys = mt_allocate_array(context, larger.capacity, sizeof *larger.keys);
    if (!larger.keys) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(larger.keys, 0xff, larger.capacity * sizeof *larger.keys);
    for (uint64_t i = 0; i < set->capacity; i++) {
        if (set->keys[i] != UINT64_MAX) {
            larger.keys[slot_of(&larger, set->keys[i])] = set->keys[i];
        }
    }
    mt_free(context, set->keys);
    *set = larger;
    return MT_OK;
}

mt_status mt_edge_set_add(mt_context *context, edge_set *set, mt_index a, mt_index b)
{
    if (2 * set->count >= set->capacity) {
        mt_status status = grow(context, set);
        if (status != MT_OK) {
            return status;
        }
    }
    uint64_t key = key_of(a, b), slot = slot_of(set, key);
    set->count += set->keys[slot] == UINT64_MAX;
    set->keys[slot] = key;
    return MT_OK;
}

bool mt_edge_set_has(const edge_set *set, mt_index a, mt_index b)
{
    uint64_t key = key_of(a, b);
    return set->capacity && set->keys[slot_of(set, key)] == key;
}

void mt_edge_set_release(mt_context *context, edge_set *set)
{
    mt_free(context, set->keys);
    *set = (edge_set){0};
}
