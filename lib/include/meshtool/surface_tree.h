/* A tree of boxes over a mesh's triangles (wires and points where asked), for rays and closest points.
 *
 * Wide: each node has up to eight children, whose boxes one vector operation tests. Boxes are floats in the space of
 * meshtool/ray.h, rounded outwards. The tree keeps the triangles' corners in float beside their numbers; what needs
 * doubles reads the mesh, which is borrowed, as is its triangulation: both outlive the tree. */
#ifndef MESHTOOL_SURFACE_TREE_H
#define MESHTOOL_SURFACE_TREE_H

#include <meshtool/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What of a mesh stands in the tree. Elements are numbered through: the triangles of the triangulation; then the
 * segments of the wires, by the place of their first vertex in wire_vertices; then the point elements; then the
 * vertices. */
typedef enum mt_surface_elements {
    MT_SURFACE_TRIANGLES = 1,
    MT_SURFACE_WIRES = 2,
    MT_SURFACE_POINTS = 4,
    MT_SURFACE_VERTICES = 8
} mt_surface_elements;

/* What building may cost to make searching cheap. Answers are the same. */
typedef enum mt_build_quality {
    MT_BUILD_BALANCED, /* each box is cut where rays expect the least work */
    MT_BUILD_FAST      /* in the middle of its longest side: for few rays */
} mt_build_quality;

typedef struct mt_surface_tree_options {
    unsigned elements; /* of mt_surface_elements; 0: triangles */
    mt_build_quality quality;
} mt_surface_tree_options;

typedef struct mt_surface_tree mt_surface_tree;

/* Builds the tree: binned surface-area heuristic (Wald, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies", RT 2007), in O(n log n), the same for any number of threads. options may be NULL. Elements with a
 * corner that is not finite are left out and counted. A tree of nothing answers that there is nothing.
 * MT_ERROR_TOO_LARGE past 2^28 elements, MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_surface_tree_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                 const mt_surface_tree_options *options, mt_surface_tree **out);
/* NULL is allowed. */
void mt_surface_tree_destroy(mt_context *context, mt_surface_tree *tree);

/* Checks every invariant: each element in one leaf, each box within its parent's. MT_ERROR_INTERNAL. O(size). */
mt_status mt_surface_tree_validate(mt_context *context, const mt_surface_tree *tree);

/* The space in which rays meet this tree's triangles. */
const mt_ray_space *mt_surface_tree_space(const mt_surface_tree *tree);
/* Elements in the tree, and those left out because they are not finite. */
mt_index mt_surface_tree_count(const mt_surface_tree *tree);
mt_index mt_surface_tree_left_out(const mt_surface_tree *tree);
/* Bytes held. */
uint64_t mt_surface_tree_size(const mt_surface_tree *tree);

/* The nearest hit among the triangles, equal t the lowest triangle; false when there is none. The same bits as asking
 * mt_ray_hit_triangle of every triangle. Thread-safe. */
bool mt_surface_tree_nearest_hit(const mt_surface_tree *tree, const mt_ray *ray, mt_ray_profile profile,
                                 mt_ray_hit *hit);

/* Whether anything is hit within the ray's range. Thread-safe. */
bool mt_surface_tree_any_hit(const mt_surface_tree *tree, const mt_ray *ray, mt_ray_profile profile);

#ifdef __cplusplus
}
#endif
#endif
