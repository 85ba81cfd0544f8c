/* Between the plain and the packed form of the triangle-neighbour structure.
 *
 * Cost: O(triangles) time, no memory but the result. */
#include "lib/topology/triangle_validate.h"

#include <string.h>

void mt_triangle_neighbor_unpack(const mt_triangle_neighbor_mesh *structure, mt_index *triangles)
{
    for (size_t corner = 0; corner < 3 * (size_t)structure->triangle_count; corner++) {
        triangles[corner] = mt_triangle_of_corner(structure->neighbors[corner]);
    }
}

/* The corner in `triangle` whose side runs from `tail` to `head`, MT_NONE: there is none. */
static mt_index find_side(const mt_index *vertices, mt_index triangle, mt_index tail, mt_index head)
{
    for (mt_index corner = 3 * triangle; corner < 3 * triangle + 3; corner++) {
        if (vertices[corner] == tail && vertices[mt_triangle_next_corner(corner)] == head) {
            return corner;
        }
    }
    return MT_NONE;
}

/* False when the triangle across has no such side, or another one across it. */
static bool pack_side(const mt_index *triangles, mt_triangle_neighbor_mesh *structure, mt_index corner)
{
    const mt_index *vertices = structure->vertices;
    mt_index across = triangles[corner];
    mt_index side = MT_NONE;
    if (across != MT_NONE) {
        if (across >= structure->triangle_count) {
            return false;
        }
        side = find_side(vertices, across, vertices[mt_triangle_next_corner(corner)], vertices[corner]);
        if (side == MT_NONE || triangles[side] != corner / 3) {
            return false;
        }
    }
    structure->neighbors[corner] = side;
    mt_index *own = &structure->vertex_corner[vertices[corner]];
    if (*own == MT_NONE || structure->neighbors[*own] != MT_NONE) {
        *own = corner;
    }
    return true;
}

static mt_status pack(mt_context *context, const mt_index *triangles, mt_triangle_neighbor_mesh *structure)
{
    memset(structure->vertex_corner, 0xff, structure->vertex_count * sizeof *structure->vertex_corner);
    for (mt_index corner = 0; corner < 3 * structure->triangle_count; corner++) {
        if (structure->vertices[corner] >= structure->vertex_count) {
            return mt_fail(context, MT_ERROR_ARGUMENT, "triangle %u names vertex %u of %u", corner / 3,
                           structure->vertices[corner], structure->vertex_count);
        }
    }
    for (mt_index corner = 0; corner < 3 * structure->triangle_count; corner++) {
        if (!pack_side(triangles, structure, corner)) {
            return mt_fail(context, MT_ERROR_ARGUMENT,
                           "triangle %u names triangle %u as its neighbour across side %u, which does not answer it",
                           corner / 3, triangles[corner], corner % 3);
        }
    }
    return mt_triangle_neighbor_inspect(context, structure, MT_ERROR_ARGUMENT);
}

mt_status mt_triangle_neighbor_pack(mt_context *context, mt_index vertex_count, mt_index triangle_count,
                                    const mt_index *vertices, const mt_index *triangles,
                                    mt_triangle_neighbor_mesh **out)
{
    *out = NULL;
    if (3 * (uint64_t)triangle_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%u triangles have more sides than an index can number",
                       triangle_count);
    }
    mt_triangle_neighbor_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    if (!structure) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    structure->vertex_count = vertex_count;
    structure->triangle_count = triangle_count;
    structure->vertices = mt_allocate_array(context, 3 * (uint64_t)triangle_count, sizeof *structure->vertices);
    structure->neighbors = mt_allocate_array(context, 3 * (uint64_t)triangle_count, sizeof *structure->neighbors);
    structure->vertex_corner = mt_allocate_array(context, vertex_count, sizeof *structure->vertex_corner);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (structure->vertices && structure->neighbors && structure->vertex_corner) {
        memcpy(structure->vertices, vertices, 3 * (size_t)triangle_count * sizeof *vertices);
        status = pack(context, triangles, structure);
    }
    if (status == MT_OK) {
        *out = structure;
    } else {
        mt_triangle_neighbor_destroy(context, structure);
    }
    return status;
}
