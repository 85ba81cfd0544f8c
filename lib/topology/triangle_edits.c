/* Swapping, splitting and collapsing edges of the triangle-neighbour structure. The invariant: after each operation
 * every invariant of the structure holds among what is not deleted. Cost: O(1), O(valences) to collapse; and what the
 * verdicts cost. */
#include "lib/topology/triangle_edit.h"

mt_status mt_triangle_swap_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_surgery_view view = mt_triangle_view(surgery);
    bool exists = side < 3 * own->triangle_count && own->vertices[side] != MT_NONE;
    mt_status status =
        mt_surgery_enter_swap(context, &view, &surgery->log, exists ? triangle_side(own, side) >> 1 : MT_NONE);
    if (status != MT_OK) {
        return status;
    }
    mt_index left_a = side, left_b = mt_triangle_next_corner(left_a), left_c = mt_triangle_next_corner(left_b);
    mt_index right_b = own->neighbors[side], right_a = mt_triangle_next_corner(right_b);
    mt_index right_d = mt_triangle_next_corner(right_a);
    mt_index a = own->vertices[left_a], b = own->vertices[left_b];
    mt_index beyond_c = own->neighbors[left_b], beyond_d = own->neighbors[right_a];
    own->vertices[left_b] = own->vertices[right_d];
    own->vertices[right_a] = own->vertices[left_c];
    triangle_pair(own, right_b, beyond_c);
    triangle_pair(own, left_a, beyond_d);
    triangle_pair(own, left_b, right_a);
    own->vertex_corner[a] = own->vertex_corner[a] == right_a ? left_a : own->vertex_corner[a];
    own->vertex_corner[b] = own->vertex_corner[b] == left_b ? right_b : own->vertex_corner[b];
    return MT_OK;
}

/* The triangle (a b c), whose side from a to b is `side`, keeps (a m c); returns the side from m to b of the new one.
 */
static mt_index split_left(mt_triangle_surgery *surgery, mt_index side, mt_index middle)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index at_b = mt_triangle_next_corner(side), b = own->vertices[at_b];
    mt_index added = mt_triangle_new(surgery, middle, b, own->vertices[mt_triangle_next_corner(at_b)]);
    own->vertices[at_b] = middle;
    triangle_pair(own, added + 1, own->neighbors[at_b]);
    triangle_pair(own, at_b, added + 2);
    if (own->vertex_corner[b] == at_b) {
        own->vertex_corner[b] = added + 1;
    }
    return added;
}

/* The triangle (b a d), whose side from b to a is `side`, keeps (m a d); returns the side from b to m of the new one.
 */
static mt_index split_right(mt_triangle_surgery *surgery, mt_index side, mt_index middle)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index at_d = mt_triangle_previous_corner(side), b = own->vertices[side], d = own->vertices[at_d];
    mt_index added = mt_triangle_new(surgery, b, middle, d);
    own->vertices[side] = middle;
    triangle_pair(own, added + 2, own->neighbors[at_d]);
    triangle_pair(own, at_d, added + 1);
    if (own->vertex_corner[b] == side) {
        own->vertex_corner[b] = added;
    }
    if (own->vertex_corner[d] == at_d) {
        own->vertex_corner[d] = added + 2;
    }
    return added;
}

mt_status mt_triangle_split_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side, mt_index tail,
                                 double weight, mt_index *vertex)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_status status = mt_triangle_reserve(context, surgery, 1, 2);
    mt_index along = mt_triangle_side_from(surgery, side, tail);
    mt_surgery_view view = mt_triangle_view(surgery);
    status = status == MT_OK ? mt_surgery_enter_split_edge(context, &view, &surgery->log, along, weight) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_index left = triangle_side_corner(own, along), right = triangle_side_corner(own, along ^ 1u);
    mt_index middle = mt_triangle_new_vertex(surgery);
    mt_index left_added = left == MT_NONE ? MT_NONE : split_left(surgery, left, middle);
    mt_index right_added = right == MT_NONE ? MT_NONE : split_right(surgery, right, middle);
    triangle_pair(own, left_added, right_added);
    own->vertex_corner[middle] = left_added == MT_NONE ? right : left_added;
    if (vertex) {
        *vertex = middle;
    }
    return MT_OK;
}

/* The two triangles beyond the other sides of one beside a collapsed edge, by the sides that become neighbours; each
 * may be MT_NONE. */
typedef struct flank {
    mt_index one, two;
} flank;

static flank take_out(mt_triangle_surgery *surgery, mt_index side)
{
    if (side == MT_NONE) {
        return (flank){MT_NONE, MT_NONE};
    }
    const mt_index *neighbors = surgery->structure.neighbors;
    flank beyond = {neighbors[mt_triangle_next_corner(side)], neighbors[mt_triangle_previous_corner(side)]};
    mt_triangle_delete(surgery, side / 3);
    return beyond;
}

/* The ends of the edge that is left, which may have become the boundary. */
static void anchor_flank(mt_triangle_neighbor_mesh *own, flank at)
{
    mt_index side = at.one != MT_NONE ? at.one : at.two;
    if (side != MT_NONE) {
        mt_triangle_anchor(own, side);
        mt_triangle_anchor(own, mt_triangle_next_corner(side));
    }
}

/* All corners of the vertex, around which no neighbour has changed yet. */
static void move_corners(mt_triangle_neighbor_mesh *own, mt_index vertex, mt_index to)
{
    mt_index begin = own->vertex_corner[vertex], corner = begin;
    do {
        own->vertices[corner] = to;
        corner = mt_triangle_neighbor_counterclockwise(own, corner);
    } while (corner != MT_NONE && corner != begin);
}

mt_status mt_triangle_collapse_edge(mt_context *context, mt_triangle_surgery *surgery, mt_index side, mt_index tail,
                                    double weight)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index along = mt_triangle_side_from(surgery, side, tail);
    mt_surgery_view view = mt_triangle_view(surgery);
    mt_status status = mt_surgery_enter_collapse(context, &view, &surgery->log, along, weight);
    if (status != MT_OK) {
        return status;
    }
    mt_index left = triangle_side_corner(own, along), right = triangle_side_corner(own, along ^ 1u);
    move_corners(own, tail, triangle_side_head(own, along));
    flank beyond_left = take_out(surgery, left), beyond_right = take_out(surgery, right);
    triangle_pair(own, beyond_left.one, beyond_left.two);
    triangle_pair(own, beyond_right.one, beyond_right.two);
    anchor_flank(own, beyond_left);
    anchor_flank(own, beyond_right);
    own->vertex_corner[tail] = MT_NONE;
    surgery->vertex_deleted[tail] = 1;
    return MT_OK;
}
