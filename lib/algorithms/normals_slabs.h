/* When sums at vertices are at work. Vertices go in groups of following numbers, faces in blocks: a group needs memory
 * for its sums, a slab, from the first block with a face at one of its vertices to the last, and hands it on to another
 * group then. Where faces lie near their vertices, as in files they do, a few slabs serve a mesh of any size, and stay
 * in the cache. */
#ifndef MT_ALGORITHMS_NORMALS_SLABS_H
#define MT_ALGORITHMS_NORMALS_SLABS_H

#include <meshtool/mesh.h>

/* Larger: slabs of meshes in a bad order leave the cache sooner; smaller: there are more of them to be told apart. */
#define MT_SLAB_SHIFT 10
#define MT_SLAB_SIZE ((mt_index)1 << MT_SLAB_SHIFT)

/* Larger: groups are at work for longer than they need be. */
#define MT_FACE_BLOCK ((mt_index)512)

/* The lowest and the highest vertex of a block. */
typedef struct mt_face_block {
    mt_index low, high;
} mt_face_block;

typedef struct mt_slab_plan {
    const mt_mesh *mesh;
    mt_index block_count, group_count;
    mt_face_block *blocks;
    mt_index *opened, *closed;           /* block_count + 1 each: the first group of each block's list, MT_NONE;
                                            opened[block_count]           lists the groups that no block has to do with */
    mt_index *next_opened, *next_closed; /* of each group: the next of its list */
} mt_slab_plan;

/* O(corners); 16 bytes a block and 8 a group. On failure all is released. */
mt_status mt_slab_plan_init(mt_context *context, const mt_mesh *mesh, mt_slab_plan *plan);
void mt_slab_plan_release(mt_context *context, mt_slab_plan *plan);

/* The most slabs that the groups from group_begin to group_end hold at once. */
mt_index mt_slab_plan_peak(const mt_slab_plan *plan, mt_index group_begin, mt_index group_end);

static inline mt_index mt_face_block_end(const mt_slab_plan *plan, mt_index begin)
{
    return plan->mesh->face_count - begin < MT_FACE_BLOCK ? plan->mesh->face_count : begin + MT_FACE_BLOCK;
}

#endif
