/* A list that grows while a tree is built, inside parallel loops too. */
#ifndef MT_SPATIAL_GROWING_H
#define MT_SPATIAL_GROWING_H

#include <meshtool/context.h>

#include <string.h>

/* All zeros: empty. Freed with mt_free(context, items). */
typedef struct mt_growing {
    void *items;
    uint64_t count, room;
} mt_growing;

/* Makes room for `more` items of `size` bytes; false, and nothing changed, when there is no memory. */
static inline bool mt_growing_reserve(mt_context *context, mt_growing *list, uint64_t more, size_t size)
{
    if (list->items && list->count + more <= list->room) {
        return true;
    }
    uint64_t room = 2 * list->room > list->count + more ? 2 * list->room : list->count + more;
    void *items = mt_try_allocate(context, room * size);
    if (!items) {
        return false;
    }
    if (list->count) {
        memcpy(items, list->items, list->count * size);
    }
    mt_free(context, list->items);
    list->items = items;
    list->room = room;
    return true;
}

#endif
