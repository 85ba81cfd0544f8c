/* The two sides of a winged edge by number: 2e runs from tail to head with the left face on its left, 2e + 1 back with
 * the right one. So they are numbered as half-edges are, and what surgery says of these holds of them.
 *
 * The side that a wing means is found by the vertex where the two sides touch; links must be set after the vertices. */
#ifndef MT_TOPOLOGY_WINGED_SIDE_H
#define MT_TOPOLOGY_WINGED_SIDE_H

#include <meshtool/winged_edge.h>

static inline mt_index winged_side_tail(const mt_winged_edge_mesh *own, mt_index side)
{
    const mt_winged_edge *edge = &own->edges[side >> 1];
    return side & 1u ? edge->head : edge->tail;
}

static inline mt_index winged_side_head(const mt_winged_edge_mesh *own, mt_index side)
{
    return winged_side_tail(own, side ^ 1u);
}

static inline mt_index winged_side_face(const mt_winged_edge_mesh *own, mt_index side)
{
    const mt_winged_edge *edge = &own->edges[side >> 1];
    return side & 1u ? edge->right : edge->left;
}

static inline mt_index winged_side_next(const mt_winged_edge_mesh *own, mt_index side)
{
    const mt_winged_edge *edge = &own->edges[side >> 1];
    mt_index next = side & 1u ? edge->rnext : edge->lnext;
    return 2 * next + (own->edges[next].tail != winged_side_head(own, side));
}

static inline mt_index winged_side_previous(const mt_winged_edge_mesh *own, mt_index side)
{
    const mt_winged_edge *edge = &own->edges[side >> 1];
    mt_index previous = side & 1u ? edge->rprev : edge->lprev;
    return 2 * previous + (own->edges[previous].head != winged_side_tail(own, side));
}

/* The next side that points to the same vertex, clockwise. */
static inline mt_index winged_side_clockwise(const mt_winged_edge_mesh *own, mt_index side)
{
    return winged_side_next(own, side) ^ 1u;
}

static inline void winged_side_set_tail(mt_winged_edge_mesh *own, mt_index side, mt_index vertex)
{
    mt_winged_edge *edge = &own->edges[side >> 1];
    *(side & 1u ? &edge->head : &edge->tail) = vertex;
}

static inline void winged_side_set_face(mt_winged_edge_mesh *own, mt_index side, mt_index face)
{
    mt_winged_edge *edge = &own->edges[side >> 1];
    *(side & 1u ? &edge->right : &edge->left) = face;
}

/* `after` follows `before` around their face. */
static inline void winged_side_link(mt_winged_edge_mesh *own, mt_index before, mt_index after)
{
    mt_winged_edge *first = &own->edges[before >> 1], *second = &own->edges[after >> 1];
    *(before & 1u ? &first->rnext : &first->lnext) = after >> 1;
    *(after & 1u ? &second->rprev : &second->lprev) = before >> 1;
}

#endif
