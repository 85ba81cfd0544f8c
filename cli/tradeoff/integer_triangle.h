/* Whether two triangles of a mesh intersect, or three points lie in a line, by signs of determinants of whole numbers.
 */
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

/* Finite points; coincident ones are in a line. */
bool integer_points_are_collinear(const mt_vec3 points[3]);

#endif
