/* Boundary loops. Where every vertex has one fan, a boundary vertex has exactly two boundary edges, so the boundary is
 * a set of closed walks with as many vertices as edges; walks are counted by union-find over the vertices, since faces
 * that run against each other leave no direction to walk in.
 *
 * Cost: nearly O(vertices + corners) time, 4 bytes a vertex; nothing when there is no boundary. */
#include "lib/algorithms/manifold_check.h"

static mt_index find_root(mt_index *parent, mt_index vertex)
{
    while (parent[vertex] != vertex) {
        parent[vertex] = parent[parent[vertex]];
        vertex = parent[vertex];
    }
    return vertex;
}

/* 1 when the ends of the edge were not joined before. */
static mt_index join_ends(mt_index *parent, mt_index a, mt_index b)
{
    mt_index low = find_root(parent, a);
    mt_index high = find_root(parent, b);
    parent[low < high ? high : low] = low < high ? low : high;
    return low != high;
}

static mt_index count_joins(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index *parent)
{
    mt_index joins = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index c = begin; c < end; c++) {
            if (pairs->next_side[c] == c) {
                mt_index next = c + 1 < end ? c + 1 : begin;
                joins += join_ends(parent, mesh->corner_vertices[c], mesh->corner_vertices[next]);
            }
        }
    }
    return joins;
}

mt_status mt_manifold_count_loops(manifold_check *check)
{
    mt_manifold_report *report = check->report;
    if (report->manifold_class == MT_NON_MANIFOLD) {
        return MT_OK;
    }
    report->boundary_loop_count = 0;
    if (check->pairs->boundary_count == 0) {
        return MT_OK;
    }
    mt_index *parent = mt_allocate_array(check->context, check->mesh->vertex_count, sizeof *parent);
    if (!parent) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index vertex = 0; vertex < check->mesh->vertex_count; vertex++) {
        parent[vertex] = vertex;
    }
    report->boundary_loop_count = check->pairs->boundary_count - count_joins(check->mesh, check->pairs, parent);
    mt_free(check->context, parent);
    return MT_OK;
}
