/* How far a piece of a triangle can be from the other surface. */
#ifndef MT_ALGORITHMS_DEVIATION_BOUND_H
#define MT_ALGORITHMS_DEVIATION_BOUND_H

#include "lib/algorithms/deviation_side.h"

/* A triangle, or a part of one, and what is nearest to its corners and its middle. */
typedef struct mt_deviation_piece {
    mt_deviation_triangle shape;
    mt_deviation_near corners[3], middle; /* a middle whose element is MT_NONE: not known */
} mt_deviation_piece;

static inline mt_vec3 mt_deviation_middle(const mt_deviation_triangle *t)
{
    return mt_deviation_point(t, 1.0 / 3, 1.0 / 3, 1.0 / 3);
}

/* An upper bound of the distance from any point of the piece to the surface `to`. Better ones are looked for until it
 * is no more than `enough`; the middle is searched for when it is not known and the corners do not suffice. */
double mt_deviation_bound(const mt_deviation_surface *to, mt_deviation_piece *piece, double enough);

#endif
