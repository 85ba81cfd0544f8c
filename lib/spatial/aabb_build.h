/* Building a tree from boxes, apart from where the boxes come from. */
#ifndef MT_SPATIAL_AABB_BUILD_H
#define MT_SPATIAL_AABB_BUILD_H

#include <meshtool/aabb_tree.h>

#define MT_AABB_LEAF_SIZE 8

/* Orders the tree's primitives leaf by leaf and fills its nodes. */
mt_status mt_aabb_build(mt_context *context, mt_aabb_tree *tree);

#endif
