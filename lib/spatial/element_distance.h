/* The nearest point of one element, in double. */
#ifndef MT_SPATIAL_ELEMENT_DISTANCE_H
#define MT_SPATIAL_ELEMENT_DISTANCE_H

#include "lib/spatial/surface_tree.h"

typedef struct mt_element_distance {
    double square; /* in space */
    double weights[3];
} mt_element_distance;

/* From a point to an element of the tree. `scaled` is the point times the space's scale: differences to the vertices,
 * scaled alike, keep all of their digits, which the tree's own coordinates would not. */
mt_element_distance mt_element_distance_to(const mt_surface_tree *tree, mt_index number, mt_vec3 scaled);

#endif
