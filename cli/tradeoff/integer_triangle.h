/* Whether two triangles of a mesh intersect, by signs of determinants of whole numbers, one pair at a time. */
#ifndef MESHTOOL_CLI_TRADEOFF_INTEGER_TRIANGLE_H
#define MESHTOOL_CLI_TRADEOFF_INTEGER_TRIANGLE_H

#include <meshtool/mesh.h>

#include <stdbool.h>

/* Finite points. */
typedef struct integer_triangle {
    mt_vec3 points[3];
    mt_index vertices[3];
} integer_triangle;

/* By the definition of meshtool/self_intersection.h; false when one of them has no area. */
bool integer_triangles_intersect(const integer_triangle *a, const integer_triangle *b);

#endif
