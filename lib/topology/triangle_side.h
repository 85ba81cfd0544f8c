/* Sides of a triangle-neighbour structure numbered as half-edges are: where the lower of an edge's two corners is c, 2c
 * runs along the side of c and 2c + 1 along that of the other, or outside. So surgery sees an outside here too, that
 * the structure itself does not have. Numbers last until the triangles beside change. */
#ifndef MT_TOPOLOGY_TRIANGLE_SIDE_H
#define MT_TOPOLOGY_TRIANGLE_SIDE_H

#include <meshtool/triangle_neighbor.h>

static inline mt_index triangle_side(const mt_triangle_neighbor_mesh *own, mt_index corner)
{
    mt_index across = own->neighbors[corner];
    return across < corner ? 2 * across + 1 : 2 * corner;
}

/* MT_NONE outside. */
static inline mt_index triangle_side_corner(const mt_triangle_neighbor_mesh *own, mt_index side)
{
    return side & 1u ? own->neighbors[side >> 1] : side >> 1;
}

/* MT_NONE when the side is not one. */
static inline mt_index triangle_side_head(const mt_triangle_neighbor_mesh *own, mt_index side)
{
    mt_index corner = side >> 1;
    if (own->vertices[corner] == MT_NONE || own->neighbors[corner] < corner) {
        return MT_NONE;
    }
    return own->vertices[side & 1u ? corner : mt_triangle_next_corner(corner)];
}

/* O(valence) outside. */
static inline mt_index triangle_side_next(const mt_triangle_neighbor_mesh *own, mt_index side)
{
    mt_index corner = triangle_side_corner(own, side);
    if (corner != MT_NONE) {
        return triangle_side(own, mt_triangle_next_corner(corner));
    }
    mt_index last = mt_triangle_previous_corner(side >> 1);
    while (own->neighbors[last] != MT_NONE) {
        last = mt_triangle_previous_corner(own->neighbors[last]);
    }
    return 2 * last + 1;
}

#endif
