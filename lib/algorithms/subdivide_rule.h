/* What a vertex does at a level, by the sharpness around it.
 *
 * Sources: DeRose, Kass and Truong, "Subdivision Surfaces in Character Animation", SIGGRAPH 1998; the RenderMan
 * convention (10 and more is infinite); OpenSubdiv 3.5 where those leave a choice (blending by the mean of what decays,
 * Chaikin's sharpness). Sharpness is computed in single precision, as there: a weight of 2/3 then has the same bits. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_RULE_H
#define LIB_ALGORITHMS_SUBDIVIDE_RULE_H

#include <meshtool/types.h>

#define MT_SHARPNESS_INFINITE 10.0f

/* By the count of sharp edges: none, one, two, more; CORNER too when the vertex itself is sharp. Smooth and dart
 * vertices have the same mask. */
typedef enum mt_subdivide_vertex_rule {
    MT_VERTEX_SMOOTH,
    MT_VERTEX_DART,
    MT_VERTEX_CREASE,
    MT_VERTEX_CORNER
} mt_subdivide_vertex_rule;

/* Boundary edges count as sharp. */
mt_subdivide_vertex_rule mt_vertex_rule_of(float vertex_sharpness, mt_index sharp_edge_count);

/* Less 1 a level; infinite stays; never below 0. */
float mt_sharpness_next(float sharpness);

/* The semi-sharp edges of a vertex summed up, which Chaikin's rule needs. */
typedef struct mt_sharpness_sum {
    double sum; /* exact for all that differ by less than 2^29: so their order does not matter */
    mt_index count;
} mt_sharpness_sum;

void mt_sharpness_sum_add(mt_sharpness_sum *sum, float sharpness);

/* Sharpness of the half of an edge at a vertex; `around` sums the edges of that vertex, this one among them. Chaikin:
 * 3/4 of its own and 1/4 of the mean of the others, less 1. */
float mt_sharpness_next_at(float sharpness, bool chaikin, const mt_sharpness_sum *around);

/* What decays at a vertex from one level to the next; its mean, at most 1, is how much of the parent's rule remains. */
void mt_sharpness_decay_add(mt_sharpness_sum *decay, float parent, float child, bool chaikin);
float mt_sharpness_decay_weight(const mt_sharpness_sum *decay);

#endif
