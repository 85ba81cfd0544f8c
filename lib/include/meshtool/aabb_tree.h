/* A tree of axis-aligned boxes over triangles (or anything with a box).
 *
 * Boxes are floats in the tree's own frame: p' = p * scale - center, with scale a power of two that brings the
 * whole into [-1, 1]. Each step of that map is monotone in every coordinate, and its result is rounded outwards, so
 * that boxes of things that touch always overlap, whatever the size and the place of the mesh. */
#ifndef MESHTOOL_AABB_TREE_H
#define MESHTOOL_AABB_TREE_H

#include <meshtool/mesh.h>
#include <meshtool/triangulate.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A box and two numbers, 32 bytes, laid out so that each half loads as one vector of four. */
typedef struct mt_aabb_node {
    float lower[3];
    mt_index first; /* inner: number of the left child, the right is first + 1; leaf: first of its `primitives` */
    float upper[3];
    mt_index count; /* primitives of a leaf, at least 1; 0 for an inner node */
} mt_aabb_node;

typedef struct mt_aabb_primitive {
    float lower[3];
    mt_index number; /* of the triangle */
    float upper[3];
    mt_index face; /* that the triangle is part of */
} mt_aabb_primitive;

typedef struct mt_aabb_tree {
    mt_index node_count; /* 0 when there are no primitives; else node 0 is the root */
    mt_index primitive_count;
    mt_aabb_node *nodes;
    mt_aabb_primitive *primitives; /* leaf by leaf */
    mt_vec3 center;
    double scale;
} mt_aabb_tree;

/* Builds the tree over the triangles of a mesh by its shared triangulation. Triangles with a vertex that is not finite,
 * and those for which skip (one byte each, may be NULL) is not 0, are left out. O(n log n) time; about 44 bytes a
 * triangle kept. The same tree for any number of threads. */
mt_status mt_aabb_tree_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                              const uint8_t *skip, mt_aabb_tree **out);
/* NULL is allowed. */
void mt_aabb_tree_destroy(mt_context *context, mt_aabb_tree *tree);

/* Checks every invariant: each primitive in one leaf, each box within its parent's. MT_ERROR_INTERNAL. O(size). */
mt_status mt_aabb_tree_validate(mt_context *context, const mt_aabb_tree *tree);

/* Two primitives whose boxes overlap; a != b, each unordered pair once. */
typedef struct mt_primitive_pair {
    mt_index a, b;
} mt_primitive_pair;

/* Receives pairs in batches, inside a parallel body: `task` numbers the part of the work, and one task's batches come
 * one after the other. Returns false to stop that task. */
typedef bool (*mt_pair_function)(void *user, mt_index task, const mt_primitive_pair *pairs, size_t count);

/* Tasks into which mt_aabb_tree_self_pairs cuts its work at most; it depends on nothing but this. */
#define MT_PAIR_TASKS_MAXIMUM 512

/* Every pair of primitives whose boxes overlap, but for those that have a key in common: keys holds four numbers a
 * primitive, in the order of tree->primitives, of which three are its keys (MT_NONE: none) and the fourth is not looked
 * at; NULL for no keys at all. MT_ERROR_OUT_OF_MEMORY. The tasks, and the order within each, do not depend on the
 * number of threads. */
mt_status mt_aabb_tree_self_pairs(mt_context *context, const mt_aabb_tree *tree, const mt_index *keys,
                                  mt_pair_function function, void *user);

#ifdef __cplusplus
}
#endif
#endif
