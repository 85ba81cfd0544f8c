/* What walks through the tree share: eight answers as bits, and children pushed in order. */
#ifndef MT_SPATIAL_SURFACE_WALK_H
#define MT_SPATIAL_SURFACE_WALK_H

#include <meshtool/clones.h>

#include "lib/spatial/surface_tree.h"

/* A child to be visited, and where it begins (along the ray, or squared distance). */
typedef struct mt_pending {
    float near;
    uint32_t child;
} mt_pending;

/* Loops over lanes with a scalar body, which compilers turn into vectors, are the portable form of testing eight boxes
 * or triangles at once; each leaves its answer as a bit of its own. */
MT_INLINE uint32_t mt_bits_of(const int32_t passes[MT_WIDTH])
{
    uint64_t pairs[MT_WIDTH / 2];
    __builtin_memcpy(pairs, passes, sizeof pairs);
    uint64_t bits = (pairs[0] | pairs[1]) | (pairs[2] | pairs[3]);
    return (uint32_t)(bits | bits >> 32);
}

/* Pushes the children of which a bit is set, the nearest on top; returns the new depth. */
MT_INLINE size_t mt_push_children(const mt_surface_node *node, const float near[MT_WIDTH], uint32_t bits,
                                  mt_pending *stack, size_t depth)
{
    size_t bottom = depth;
    for (; bits; bits &= bits - 1) {
        int slot = __builtin_ctz(bits);
        mt_pending item = {near[slot], node->children[slot]};
        size_t at = depth++;
        for (; at > bottom && stack[at - 1].near < item.near; at--) {
            stack[at] = stack[at - 1];
        }
        stack[at] = item;
    }
    return depth;
}

/* Nine rows of coordinates and one of numbers, `count` each. */
MT_INLINE const float *mt_leaf_rows(const mt_surface_tree *tree, uint32_t child)
{
    const void *words = tree->words + (size_t)mt_surface_leaf_first(child) * MT_SURFACE_WORDS;
    return words;
}

MT_INLINE mt_index mt_leaf_number(const float *rows, mt_index count, mt_index lane)
{
    mt_index number;
    __builtin_memcpy(&number, rows + 9 * (size_t)count + lane, sizeof number);
    return number;
}

#endif
