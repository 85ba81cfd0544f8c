/* Building a tree from boxes, apart from where the boxes come from. */
#ifndef MT_SPATIAL_AABB_BUILD_H
#define MT_SPATIAL_AABB_BUILD_H

#include <meshtool/aabb_tree.h>

/* A primitive while the tree is built. */
typedef struct boxed_primitive {
    mt_box box;
    mt_index number;
} boxed_primitive;

#define MT_AABB_LEAF_SIZE 4

/* Orders `primitives` leaf by leaf and fills the tree's nodes. Everything else of the tree is the caller's. */
mt_status mt_aabb_build(mt_context *context, boxed_primitive *primitives, mt_index count, mt_aabb_tree *tree);

#endif
