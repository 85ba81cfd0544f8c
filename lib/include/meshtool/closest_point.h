/* The nearest point of a mesh's surface, wires and points.
 *
 * Candidates are culled by the tree's float boxes and a float distance with its error bound; what remains is measured
 * in double from the mesh's own vertices. Where a point is shared by several elements (a vertex, an edge) all of them
 * measure the same bits, and the lowest element wins. */
#ifndef MESHTOOL_CLOSEST_POINT_H
#define MESHTOOL_CLOSEST_POINT_H

#include <meshtool/surface_tree.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How the tree is walked; the answer is the same. */
typedef enum mt_closest_order {
    MT_CLOSEST_DEPTH_FIRST = 0, /* nearest child first, on a stack: the fastest, as a rule */
    MT_CLOSEST_BEST_FIRST       /* nearest node of all first, from a priority queue: opens the fewest nodes */
} mt_closest_order;

/* All zeros means the defaults. */
typedef struct mt_closest_options {
    mt_closest_order order;
    double maximum; /* nothing farther is looked for (as far counts); 0: no limit */
    bool has_hint;  /* `hint` is an element of the tree that may be near: its distance bounds the search */
    mt_index hint;
} mt_closest_options;

typedef struct mt_closest {
    mt_vec3 point;
    double distance;
    double weights[3]; /* of the element's vertices; one that is exactly 0: the point lies on the edge opposite */
    mt_index
        element; /* numbered as meshtool/surface_tree.h says; below the triangle count: a triangle; MT_NONE: none */
} mt_closest;

/* False when the tree is empty, the point is not finite or nothing is within the maximum. options may be NULL.
 * Thread-safe. */
bool mt_surface_tree_closest(const mt_surface_tree *tree, mt_vec3 point, const mt_closest_options *options,
                             mt_closest *out);

/* The nearest point of one element, by the same arithmetic. */
void mt_surface_element_closest(const mt_surface_tree *tree, mt_index element, mt_vec3 point, mt_closest *out);

/* Its distance alone. */
double mt_surface_element_distance(const mt_surface_tree *tree, mt_index element, mt_vec3 point);

#ifdef __cplusplus
}
#endif
#endif
