/* What walks through the tree share: eight answers as bits, and children pushed in order. */
#ifndef MT_SPATIAL_SURFACE_WALK_H
#define MT_SPATIAL_SURFACE_WALK_H

#include <meshtool/clones.h>

#include "lib/spatial/box.h"
#include "lib/spatial/surface_tree.h"

/* A child to be visited below the bits of where it begins (along the ray, or squared distance): a number that is
 * ordered as that place is. Places below 0 come before all others, but stand among themselves in reverse, which costs
 * time and nothing else. */
typedef int64_t mt_pending;

MT_INLINE mt_pending mt_pending_make(float near, uint32_t child)
{
    int32_t bits;
    __builtin_memcpy(&bits, &near, sizeof bits);
    return (mt_pending)((uint64_t)(uint32_t)bits << 32 | child);
}

MT_INLINE float mt_pending_near(mt_pending item)
{
    uint32_t bits = (uint32_t)((uint64_t)item >> 32);
    float near;
    __builtin_memcpy(&near, &bits, sizeof near);
    return near;
}

MT_INLINE uint32_t mt_pending_child(mt_pending item)
{
    return (uint32_t)item;
}

/* Loops over lanes with a scalar body, which compilers turn into vectors, are the portable form of testing eight boxes
 * or triangles at once; each leaves its answer as -1 or 0. */
MT_INLINE uint32_t mt_bits_of(const int32_t passes[MT_WIDTH])
{
    int4 low, high;
    __builtin_memcpy(&low, passes, sizeof low);
    __builtin_memcpy(&high, passes + 4, sizeof high);
    return int4_lanes(low) | int4_lanes(high) << 4;
}

/* The child of the lowest bit. */
MT_INLINE mt_pending mt_pending_first(const mt_surface_node *node, const float near[MT_WIDTH], uint32_t bits)
{
    int slot = __builtin_ctz(bits);
    return mt_pending_make(near[slot], node->children[slot]);
}

/* Pushes the children of which a bit is set, the nearest on top; returns the new depth. */
MT_INLINE size_t mt_push_children(const mt_surface_node *node, const float near[MT_WIDTH], uint32_t bits,
                                  mt_pending *stack, size_t depth)
{
    size_t bottom = depth;
    for (; bits; bits &= bits - 1) {
        mt_pending item = mt_pending_first(node, near, bits);
        size_t at = depth++;
        for (; at > bottom && stack[at - 1] < item; at--) {
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
