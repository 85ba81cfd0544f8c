/* Copying elements by a list of their sources, in parallel. */
#ifndef MT_MESH_GATHER_H
#define MT_MESH_GATHER_H

#include <meshtool/context.h>

/* target[i] = source[map[i]] for `count` elements of `size` bytes; all bits of the element are `missing` where the map
 * says MT_NONE (0, or 0xff for MT_NONE itself). map NULL: copies. */
void mt_gather(mt_context *context, const void *source, void *target, const mt_index *map, uint64_t count, size_t size,
               int missing);

#endif
