/* The two float tests, once for one triangle and for a vector of them: macros take either. */
#ifndef MT_SPATIAL_RAY_FORMULAS_H
#define MT_SPATIAL_RAY_FORMULAS_H

/* A corner relative to the origin, sheared so that the ray becomes the third axis (Woop, Benthin and Wald). */
#define MT_RAY_SHEAR(along, depth, shear) ((along) - (shear) * (depth))

/* Edge function of two sheared corners; exchanging them changes the sign and nothing else, without contraction. */
#define MT_RAY_EDGE(ax, ay, bx, by) ((bx) * (ay) - (by) * (ax))

#define MT_RAY_DOT(a, b) ((a)[0] * (b)[0] + (a)[1] * (b)[1] + (a)[2] * (b)[2])

#define MT_RAY_CROSS(a, b, out)                                                                                        \
    do {                                                                                                               \
        (out)[0] = (a)[1] * (b)[2] - (a)[2] * (b)[1];                                                                  \
        (out)[1] = (a)[2] * (b)[0] - (a)[0] * (b)[2];                                                                  \
        (out)[2] = (a)[0] * (b)[1] - (a)[1] * (b)[0];                                                                  \
    } while (0)

/* Moeller and Trumbore: scratch p and q, then determinant, u, v and t, all but the first to be divided by it. */
#define MT_RAY_MOELLER_TRUMBORE(direction, from_a, ab, ac, p, q, determinant, u, v, t)                                 \
    do {                                                                                                               \
        MT_RAY_CROSS(direction, ac, p);                                                                                \
        (determinant) = MT_RAY_DOT(ab, p);                                                                             \
        (u) = MT_RAY_DOT(from_a, p);                                                                                   \
        MT_RAY_CROSS(from_a, ab, q);                                                                                   \
        (v) = MT_RAY_DOT(direction, q);                                                                                \
        (t) = MT_RAY_DOT(ac, q);                                                                                       \
    } while (0)

#endif
