/* Sums over the neighbours of every vertex by passing over the sides instead of around the vertices: the structure is
 * read in the order in which it lies, and no step waits for the one before. So the order of a sum is that of the sides,
 * not that of the ring.
 *
 * Cost: O(sides) time, no memory. One thread: what is added to is scattered. */
#include "lib/topology/inline.h"

#include <meshtool/halfedge.h>
#include <meshtool/triangle_neighbor.h>

#include <string.h>

MT_ALWAYS_INLINE void add(const double *values, mt_index from, mt_index component_count, double *sums, mt_index to)
{
    const double *value = values + (size_t)from * component_count;
    double *sum = sums + (size_t)to * component_count;
    for (mt_index i = 0; i < component_count; i++) {
        sum[i] += value[i];
    }
}

MT_ALWAYS_INLINE void sum_over_edges(const mt_halfedge_mesh *structure, const double *values, mt_index component_count,
                                     double *sums)
{
    for (mt_index h = 0; h < structure->halfedge_count; h += 2) {
        mt_index head = structure->halfedges[h].head, tail = structure->halfedges[h + 1].head;
        add(values, head, component_count, sums, tail);
        add(values, tail, component_count, sums, head);
    }
}

void mt_halfedge_sum_neighbors(const mt_halfedge_mesh *structure, const double *values, mt_index component_count,
                               double *sums)
{
    memset(sums, 0, (size_t)structure->vertex_count * component_count * sizeof *sums);
    if (component_count == 3) { /* by far the most frequent: without an inner loop */
        sum_over_edges(structure, values, 3, sums);
    } else {
        sum_over_edges(structure, values, component_count, sums);
    }
}

/* Every side gives its head to its tail; the side across gives the tail to the head, and there is none on the
 * boundary. */
MT_ALWAYS_INLINE void sum_over_sides(const mt_triangle_neighbor_mesh *structure, const double *values,
                                     mt_index component_count, double *sums)
{
    const mt_index *vertex = structure->vertices, *across = structure->neighbors;
    for (mt_index triangle = 0; triangle < structure->triangle_count; triangle++, vertex += 3, across += 3) {
        for (mt_index k = 0; k < 3; k++) {
            add(values, vertex[k == 2 ? 0 : k + 1], component_count, sums, vertex[k]);
        }
        if ((across[0] == MT_NONE) | (across[1] == MT_NONE) | (across[2] == MT_NONE)) {
            for (mt_index k = 0; k < 3; k++) {
                if (across[k] == MT_NONE) {
                    add(values, vertex[k], component_count, sums, vertex[k == 2 ? 0 : k + 1]);
                }
            }
        }
    }
}

void mt_triangle_neighbor_sum_neighbors(const mt_triangle_neighbor_mesh *structure, const double *values,
                                        mt_index component_count, double *sums)
{
    memset(sums, 0, (size_t)structure->vertex_count * component_count * sizeof *sums);
    if (component_count == 3) {
        sum_over_sides(structure, values, 3, sums);
    } else {
        sum_over_sides(structure, values, component_count, sums);
    }
}
