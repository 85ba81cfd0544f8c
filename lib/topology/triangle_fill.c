/* Paired sides are nearly the packed neighbours themselves: the array is taken over, and only the boundary differs.
 * Where faces lie near each other one pass by the chains that pairing uses too does all at once.
 *
 * Cost: O(corners) time, no memory but the chains. */
#include "lib/topology/triangle_fill.h"

#include <string.h>

static void forget_corners(mt_triangle_neighbor_mesh *structure)
{
    memset(structure->vertex_corner, 0xff, structure->vertex_count * sizeof *structure->vertex_corner);
}

/* The corner that a boundary side leaves is the one where its fan begins. */
static void open_fans(mt_triangle_neighbor_mesh *structure)
{
    for (mt_index corner = 0; corner < 3 * structure->triangle_count; corner++) {
        if (structure->neighbors[corner] == MT_NONE) {
            structure->vertex_corner[structure->vertices[corner]] = corner;
        }
    }
}

void mt_triangle_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_triangle_neighbor_mesh *structure)
{
    mt_index *neighbors = pairs->next_side;
    pairs->next_side = NULL;
    structure->neighbors = neighbors;
    forget_corners(structure);
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index vertex = mesh->corner_vertices[corner];
        structure->vertices[corner] = vertex;
        structure->vertex_corner[vertex] = corner;
        neighbors[corner] = neighbors[corner] == corner ? MT_NONE : neighbors[corner];
    }
    if (pairs->boundary_count) {
        open_fans(structure);
    }
}

typedef struct triangle_filling {
    edge_chains chains;
    mt_index *vertices;
    mt_index *neighbors;
    mt_index *vertex_corner;
    bool fits; /* nothing met so far that the structure cannot hold */
} triangle_filling;

/* An entry notes its edge's first side, as 2 * corner + whether it runs to the higher vertex, until the second has
 * come: so what lies at the first side, which may be far away, is only written. Without a branch on which of the two
 * this is, which would be mispredicted every other time. */
MT_ALWAYS_INLINE void place_side(triangle_filling *fill, mt_index tail, mt_index head, mt_index corner)
{
    mt_index count = fill->chains.entry_count;
    mt_index edge = edge_chain_find(&fill->chains, tail < head ? tail : head, tail < head ? head : tail);
    mt_index *note = &fill->chains.entries[edge].note;
    bool is_first = edge == count;
    mt_index up = tail < head;
    mt_index own = 2 * corner + up;
    mt_index met = is_first ? own : *note;
    bool is_third = met == MT_NONE;
    mt_index first = is_third ? corner : met >> 1;
    fill->vertices[corner] = tail;
    fill->vertex_corner[tail] = corner;
    fill->neighbors[first] = corner;
    fill->neighbors[corner] = is_first ? MT_NONE : first;
    *note = is_first ? own : MT_NONE;
    fill->fits &= (tail != head) & (is_first | (!is_third & ((met & 1u) != up)));
}

bool mt_triangle_fill_by_chains(const mt_mesh *mesh, edge_chains *chains, mt_index edge_room,
                                mt_triangle_neighbor_mesh *structure)
{
    forget_corners(structure);
    triangle_filling fill = {*chains, structure->vertices, structure->neighbors, structure->vertex_corner, true};
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    const mt_index *vertex = mesh->corner_vertices;
    mt_index corner = 0;
    for (; corner < mesh->corner_count && fill.fits && fill.chains.steps <= step_limit; corner += 3, vertex += 3) {
        if (edge_room - fill.chains.entry_count < 3) {
            return false;
        }
        mt_index a = vertex[0], b = vertex[1], c = vertex[2];
        place_side(&fill, a, b, corner);
        place_side(&fill, b, c, corner + 1);
        place_side(&fill, c, a, corner + 2);
    }
    bool complete = fill.fits && corner == mesh->corner_count;
    if (complete && 2 * (uint64_t)fill.chains.entry_count != mesh->corner_count) {
        open_fans(structure);
    }
    return complete;
}
