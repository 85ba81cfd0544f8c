/* Paired sides are nearly the packed neighbours themselves: the array is taken over, and only the boundary differs.
 * Where faces lie near each other one pass by open sides does all at once.
 *
 * Cost: O(corners) time, no memory but the lists' heads. */
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

/* The pass over the triangles by open sides, which are linked by their neighbours. */
typedef struct open_filling {
    open_sides open;
    mt_index *vertices;
    mt_index *neighbors;
    mt_index *vertex_corner;
    mt_index pair_count;
    bool fits; /* no side from a vertex to itself so far */
} open_filling;

MT_ALWAYS_INLINE void place_side(open_filling *fill, mt_index tail, mt_index head, mt_index corner)
{
    fill->fits &= tail != head;
    fill->vertices[corner] = tail;
    fill->vertex_corner[tail] = corner;
    mt_index *link = &fill->open.newest[tail];
    mt_index at = *link;
    while (at != MT_NONE && fill->vertices[at] != head) {
        link = &fill->neighbors[at];
        at = *link;
        fill->open.steps++;
    }
    if (at != MT_NONE) {
        *link = fill->neighbors[at];
        fill->neighbors[at] = corner;
        fill->neighbors[corner] = at;
        fill->pair_count++;
    } else {
        fill->neighbors[corner] = fill->open.newest[head];
        fill->open.newest[head] = corner;
    }
}

/* Sides that are still open are the boundary; the corner that one leaves is where its vertex's fan begins. */
static void close_lists(const open_filling *fill, mt_index vertex_count)
{
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        for (mt_index at = fill->open.newest[vertex]; at != MT_NONE;) {
            mt_index next = fill->neighbors[at];
            fill->neighbors[at] = MT_NONE;
            fill->vertex_corner[fill->vertices[at]] = at;
            at = next;
        }
    }
}

bool mt_triangle_fill_open(const mt_mesh *mesh, const open_sides *open, mt_triangle_neighbor_mesh *structure)
{
    forget_corners(structure);
    open_filling fill = {*open, structure->vertices, structure->neighbors, structure->vertex_corner, 0, true};
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    const mt_index *vertex = mesh->corner_vertices;
    mt_index corner = 0;
    for (; corner < mesh->corner_count && fill.fits && fill.open.steps <= step_limit; corner += 3, vertex += 3) {
        mt_index a = vertex[0], b = vertex[1], c = vertex[2];
        place_side(&fill, a, b, corner);
        place_side(&fill, b, c, corner + 1);
        place_side(&fill, c, a, corner + 2);
    }
    bool complete = fill.fits && corner == mesh->corner_count;
    if (complete && 2 * (uint64_t)fill.pair_count != mesh->corner_count) {
        close_lists(&fill, mesh->vertex_count);
    }
    return complete;
}
