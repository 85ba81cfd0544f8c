#include "connectivity.h"

#include <meshtool/halfedge.h>
#include <meshtool/triangle_neighbor.h>
#include <meshtool/winged_edge.h>

/* Half-edges */

static mt_status create_halfedges(mt_context *context, const mt_mesh *mesh, void **out)
{
    mt_halfedge_mesh *structure = NULL;
    mt_status status = mt_halfedge_create(context, mesh, &structure);
    *out = structure;
    return status;
}

static void destroy_halfedges(mt_context *context, void *structure)
{
    mt_halfedge_destroy(context, structure);
}

static uint64_t size_of_halfedges(const void *structure)
{
    return mt_halfedge_size(structure);
}

static mt_index count_halfedges(const void *structure)
{
    return ((const mt_halfedge_mesh *)structure)->halfedge_count;
}

static mt_index count_halfedge_edges(const void *structure)
{
    return count_halfedges(structure) / 2;
}

static mt_index count_halfedge_vertices(const void *structure)
{
    return ((const mt_halfedge_mesh *)structure)->vertex_count;
}

static mt_index count_halfedge_faces(const void *structure)
{
    return ((const mt_halfedge_mesh *)structure)->face_count;
}

static mt_index count_halfedge_boundary(const void *structure)
{
    mt_index count = 0;
    for (mt_index edge = 0; edge < count_halfedge_edges(structure); edge++) {
        count += mt_halfedge_edge_is_boundary(structure, edge);
    }
    return count;
}

static void halfedge_row(const void *structure, mt_index halfedge, mt_index *values)
{
    values[0] = mt_halfedge_twin(halfedge);
    values[1] = mt_halfedge_next(structure, halfedge);
    values[2] = mt_halfedge_head(structure, halfedge);
    values[3] = mt_halfedge_face(structure, halfedge);
}

static void halfedge_vertex_row(const void *structure, mt_index vertex, mt_index *values)
{
    values[0] = ((const mt_halfedge_mesh *)structure)->vertex_halfedge[vertex];
}

static void halfedge_face_row(const void *structure, mt_index face, mt_index *values)
{
    values[0] = ((const mt_halfedge_mesh *)structure)->face_halfedge[face];
}

/* Winged edges */

static mt_status create_winged_edges(mt_context *context, const mt_mesh *mesh, void **out)
{
    mt_winged_edge_mesh *structure = NULL;
    mt_status status = mt_winged_edge_create(context, mesh, &structure);
    *out = structure;
    return status;
}

static void destroy_winged_edges(mt_context *context, void *structure)
{
    mt_winged_edge_destroy(context, structure);
}

static uint64_t size_of_winged_edges(const void *structure)
{
    return mt_winged_edge_size(structure);
}

static mt_index count_winged_edges(const void *structure)
{
    return ((const mt_winged_edge_mesh *)structure)->edge_count;
}

static mt_index count_winged_vertices(const void *structure)
{
    return ((const mt_winged_edge_mesh *)structure)->vertex_count;
}

static mt_index count_winged_faces(const void *structure)
{
    return ((const mt_winged_edge_mesh *)structure)->face_count;
}

static mt_index count_winged_boundary(const void *structure)
{
    mt_index count = 0;
    for (mt_index edge = 0; edge < count_winged_edges(structure); edge++) {
        count += mt_winged_edge_is_boundary(structure, edge);
    }
    return count;
}

static void winged_row(const void *structure, mt_index number, mt_index *values)
{
    const mt_winged_edge *edge = &((const mt_winged_edge_mesh *)structure)->edges[number];
    const mt_index row[] = {edge->tail,  edge->head,  edge->left,  edge->right,
                            edge->lprev, edge->lnext, edge->rprev, edge->rnext};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        values[i] = row[i];
    }
}

static void winged_vertex_row(const void *structure, mt_index vertex, mt_index *values)
{
    values[0] = ((const mt_winged_edge_mesh *)structure)->vertex_edge[vertex];
}

static void winged_face_row(const void *structure, mt_index face, mt_index *values)
{
    values[0] = ((const mt_winged_edge_mesh *)structure)->face_edge[face];
}

/* Triangle neighbours */

static mt_status create_triangles(mt_context *context, const mt_mesh *mesh, void **out)
{
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_status status = mt_triangle_neighbor_create(context, mesh, &structure);
    *out = structure;
    return status;
}

static void destroy_triangles(mt_context *context, void *structure)
{
    mt_triangle_neighbor_destroy(context, structure);
}

static uint64_t size_of_triangles(const void *structure)
{
    return mt_triangle_neighbor_size(structure);
}

static mt_index count_triangles(const void *structure)
{
    return ((const mt_triangle_neighbor_mesh *)structure)->triangle_count;
}

static mt_index count_triangle_vertices(const void *structure)
{
    return ((const mt_triangle_neighbor_mesh *)structure)->vertex_count;
}

static mt_index count_triangle_boundary(const void *structure)
{
    mt_index count = 0;
    for (mt_index corner = 0; corner < 3 * count_triangles(structure); corner++) {
        count += mt_triangle_neighbor_is_boundary(structure, corner);
    }
    return count;
}

/* Of the sides, those across which a neighbour lies are two an edge. */
static mt_index count_triangle_edges(const void *structure)
{
    return (3 * count_triangles(structure) + count_triangle_boundary(structure)) / 2;
}

static void triangle_row(const void *opaque, mt_index triangle, mt_index *values)
{
    const mt_triangle_neighbor_mesh *structure = opaque;
    for (mt_index i = 0; i < 3; i++) {
        mt_index corner = 3 * triangle + i;
        values[i] = structure->vertices[corner];
        values[3 + i] = mt_triangle_neighbor_across(structure, corner);
        values[6 + i] = structure->neighbors[corner];
    }
}

static void triangle_vertex_row(const void *opaque, mt_index vertex, mt_index *values)
{
    const mt_triangle_neighbor_mesh *structure = opaque;
    values[0] = mt_triangle_of_corner(structure->vertex_corner[vertex]);
    values[1] = structure->vertex_corner[vertex];
}

const cli_connectivity cli_connectivities[CLI_CONNECTIVITY_COUNT] = {
    {"half-edge",
     create_halfedges,
     destroy_halfedges,
     size_of_halfedges,
     count_halfedge_edges,
     count_halfedge_boundary,
     {{"halfedges", "half-edge", {"pair", "next", "head", "face"}, sizeof(mt_halfedge), count_halfedges, halfedge_row},
      {"vertices", "vertex", {"halfedge"}, sizeof(mt_index), count_halfedge_vertices, halfedge_vertex_row},
      {"faces", "face", {"halfedge"}, sizeof(mt_index), count_halfedge_faces, halfedge_face_row}}},
    {"winged-edge",
     create_winged_edges,
     destroy_winged_edges,
     size_of_winged_edges,
     count_winged_edges,
     count_winged_boundary,
     {{"edges",
       "edge",
       {"tail", "head", "left", "right", "lprev", "lnext", "rprev", "rnext"},
       sizeof(mt_winged_edge),
       count_winged_edges,
       winged_row},
      {"vertices", "vertex", {"edge"}, sizeof(mt_index), count_winged_vertices, winged_vertex_row},
      {"faces", "face", {"edge"}, sizeof(mt_index), count_winged_faces, winged_face_row}}},
    {"triangle-neighbor",
     create_triangles,
     destroy_triangles,
     size_of_triangles,
     count_triangle_edges,
     count_triangle_boundary,
     {{"triangles",
       "triangle",
       {"v0", "v1", "v2", "n0", "n1", "n2", "corner0", "corner1", "corner2"},
       6 * sizeof(mt_index),
       count_triangles,
       triangle_row},
      {"vertices", "vertex", {"triangle", "corner"}, sizeof(mt_index), count_triangle_vertices, triangle_vertex_row}}},
};
