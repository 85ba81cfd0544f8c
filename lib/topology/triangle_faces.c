/* Removing and adding triangles of the triangle-neighbour structure. The invariant: after each operation every
 * invariant of the structure holds among what is not deleted. Cost: O(1), and O(valences) to find the sides of a new
 * triangle. */
#include "lib/topology/edit_entries.h"
#include "lib/topology/triangle_edit.h"

/* On the boundary a ring begins after the triangle that goes, if it does not begin elsewhere. */
static void leave_vertex(mt_triangle_neighbor_mesh *own, mt_index corner)
{
    mt_index following = mt_triangle_neighbor_counterclockwise(own, corner);
    if (following != MT_NONE) {
        own->vertex_corner[own->vertices[corner]] = following;
    } else if (own->neighbors[corner] == MT_NONE) {
        own->vertex_corner[own->vertices[corner]] = MT_NONE;
    }
}

mt_status mt_triangle_remove_face(mt_context *context, mt_triangle_surgery *surgery, mt_index triangle)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_status status = mt_surgery_expect(context, mt_triangle_can_remove_face(surgery, triangle), 0);
    if (status != MT_OK) {
        return status;
    }
    for (mt_index corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
        leave_vertex(own, corner);
    }
    for (mt_index corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
        triangle_pair(own, own->neighbors[corner], MT_NONE);
    }
    mt_triangle_delete(surgery, triangle);
    return MT_OK;
}

mt_status mt_triangle_add_face(mt_context *context, mt_triangle_surgery *surgery, mt_index count,
                               const mt_index *vertices, mt_index *face)
{
    mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_status status = mt_surgery_expect(context, mt_triangle_can_add_face(surgery, count, vertices), 0);
    status = status == MT_OK ? mt_triangle_reserve(context, surgery, 0, 1) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_index across[3];
    for (int i = 0; i < 3; i++) {
        across[i] = mt_triangle_surgery_find(surgery, vertices[(i + 1) % 3], vertices[i]);
    }
    mt_index corner = mt_triangle_new(surgery, vertices[0], vertices[1], vertices[2]);
    for (mt_index i = 0; i < 3; i++) {
        triangle_pair(own, corner + i, across[i]);
        if (across[i] == MT_NONE) {
            own->vertex_corner[vertices[i]] = corner + i;
        }
    }
    if (face) {
        *face = corner / 3;
    }
    return MT_OK;
}
