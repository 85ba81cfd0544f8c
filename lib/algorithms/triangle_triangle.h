/* Exact contact between two triangles that know which vertices they share. */
#ifndef MT_ALGORITHMS_TRIANGLE_TRIANGLE_H
#define MT_ALGORITHMS_TRIANGLE_TRIANGLE_H

#include <meshtool/predicates.h>
#include <meshtool/self_intersection.h>

typedef struct indexed_triangle {
    mt_index vertices[3];
    mt_vec3 points[3];
} indexed_triangle;

/* Whether two triangles of non-zero area intersect, by the rule of self_intersection.h. */
bool mt_triangles_intersect(mt_arithmetic how, const indexed_triangle *a, const indexed_triangle *b);

#endif
