/* Boundary pinches: vertices where the boundary touches itself, so that its loops are not told apart. Where a mesh is
 * not non-manifold every vertex ends two boundary edges at most, and nothing is looked at.
 *
 * Cost: O(corners) time and a byte a vertex, for a mesh that is non-manifold. */
#include "lib/algorithms/manifold_check.h"

static mt_index add_end(uint8_t *ends, mt_index vertex)
{
    if (ends[vertex] == PINCH_ENDS) {
        return 0;
    }
    ends[vertex]++;
    return ends[vertex] == PINCH_ENDS;
}

mt_status mt_manifold_find_pinches(manifold_check *check)
{
    const mt_mesh *mesh = check->mesh;
    if (check->report->manifold_class != MT_NON_MANIFOLD || check->pairs->boundary_count == 0) {
        return MT_OK;
    }
    check->boundary_ends = mt_allocate_zeroed(check->context, mesh->vertex_count);
    if (!check->boundary_ends) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_index count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index c = begin; c < end; c++) {
            if (check->pairs->next_side[c] == c) {
                mt_index next = c + 1 < end ? c + 1 : begin;
                count += add_end(check->boundary_ends, mesh->corner_vertices[c]);
                count += add_end(check->boundary_ends, mesh->corner_vertices[next]);
            }
        }
    }
    check->report->defect_counts[MT_DEFECT_BOUNDARY_PINCH] = count;
    return MT_OK;
}
