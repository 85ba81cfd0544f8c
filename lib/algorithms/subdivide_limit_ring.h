/* The quads around a vertex, and where Catmull-Clark takes it; or the triangles, and where Loop's scheme does.
 *
 * Sources: Halstead, Kass and DeRose, "Efficient, Fair Interpolation using Catmull-Clark Surfaces", SIGGRAPH 1993
 * (the masks of smooth vertices); Loop, 1987 (those of triangles); Biermann, Levin and Zorin, "Piecewise Smooth
 * Subdivision Surfaces with Normal Control", SIGGRAPH 2000 (how those of creases and boundaries are found). */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_LIMIT_RING_H
#define LIB_ALGORITHMS_SUBDIVIDE_LIMIT_RING_H

#include "lib/algorithms/subdivide_rule.h"

#include <meshtool/vector.h>

/* Face i lies between spokes i and i + 1, counter-clockwise; a closed ring has as many spokes as faces and begins again
 * with spoke 0, an open one has one more. Points are given as `scale` times what they differ from the center. */
typedef struct mt_limit_ring {
    mt_vec3 center;
    double scale;
    bool closed, triangles;
    mt_index face_count;
    mt_vec3 *ends;      /* of the spokes */
    mt_vec3 *diagonals; /* the corners of the quads opposite the center; of triangles room for as many ends */
} mt_limit_ring;

static inline mt_index mt_limit_spoke_count(const mt_limit_ring *ring)
{
    return ring->face_count + !ring->closed;
}

/* The spoke after a face. */
static inline mt_index mt_limit_next_spoke(const mt_limit_ring *ring, mt_index face)
{
    return ring->closed && face + 1 == ring->face_count ? 0 : face + 1;
}

/* The largest component of the spokes; 0 of a point. */
double mt_limit_ring_extent(const mt_limit_ring *ring);

/* Faces from one sharp spoke to the next, over which the surface is smooth; all of a ring that has none. */
typedef struct mt_limit_sector {
    mt_index first, face_count;
} mt_limit_sector;

/* Where the center goes under a rule that holds for ever: a crease follows spokes a and b. A dart's is right only of a
 * ring that mt_limit_refine has shrunk. */
mt_vec3 mt_limit_position(const mt_limit_ring *ring, mt_subdivide_vertex_rule rule, mt_index a, mt_index b);

/* The unit normal there, of a sector. Exact for smooth vertices and creases, and at corners of one face; a corner of
 * more has no tangent plane, and gets the mean of its faces' weighted by area. (0, 0, 1) where nothing defines one. Not
 * of darts. */
mt_vec3 mt_limit_normal(const mt_limit_ring *ring, mt_subdivide_vertex_rule rule, mt_limit_sector sector);

/* The tangents of a smooth vertex towards spoke `first` and a quarter turn on, up to factors. */
void mt_limit_smooth_tangents(const mt_limit_ring *ring, mt_index first, mt_vec3 *along, mt_vec3 *across);

/* A spoke's sharpness; that of its halves at the next level, at the center and at the far end. Only Chaikin's rule lets
 * these differ. Boundaries are infinitely sharp. */
typedef struct mt_limit_spoke {
    float sharpness, near, far;
} mt_limit_spoke;

typedef struct mt_limit_sharp_ring {
    mt_limit_ring ring;
    float sharpness; /* of the center */
    bool chaikin;
    mt_limit_spoke *spokes;
} mt_limit_sharp_ring;

/* Refines the ring, level by level, until one rule holds for ever, and returns it: until nothing of it is
 * semi-sharp. A dart, whose masks have no closed form, is refined until its position and normal stand still; *normal
 * is then its normal. O(spokes) for each of at most ten levels, of some hundreds for darts. */
mt_subdivide_vertex_rule mt_limit_refine(mt_limit_sharp_ring *ring, mt_vec3 *normal);

#endif
