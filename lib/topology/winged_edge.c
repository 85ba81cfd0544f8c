/* Building and unbuilding the winged-edge structure. A mesh that the structure cannot hold is refused with its first
 * offender (refusal.c), never thinned out.
 *
 * That no vertex has several fans shows in a count: one ring a vertex is walked, and every edge must be met twice.
 *
 * Cost: O(vertices + corners) time; 32 bytes an edge, 4 a vertex and 4 a face kept; meanwhile 4 a vertex more,
 * or from pairs 16 a corner. */
#include "lib/topology/ring_check.h"
#include "lib/topology/source_mesh.h"
#include "lib/topology/winged_fill.h"

#include <meshtool/refusal.h>

#define WHO_NEEDS "winged edges need"

static ring_step walk_ring(const void *structure, mt_index vertex, mt_index at)
{
    const mt_winged_edge *edge = &((const mt_winged_edge_mesh *)structure)->edges[at];
    bool leaves = edge->tail == vertex;
    return (ring_step){leaves ? edge->head : edge->tail, leaves ? edge->lprev : edge->rprev};
}

static const void *place_of(const void *structure, mt_index at)
{
    return &((const mt_winged_edge_mesh *)structure)->edges[at];
}

static void check_rings(void *user, uint64_t begin, uint64_t end)
{
    ring_check_vertices(walk_ring, place_of, user, begin, end);
}

/* Whether the rings of all vertices meet every edge at both ends, and none a neighbour twice. */
static bool rings_hold(mt_context *context, const mt_winged_edge_mesh *structure, bool edges_are_known)
{
    ring_check check = {structure, structure->vertex_edge, edges_are_known, 0, false};
    return ring_check_holds(context, check_rings, &check, structure->vertex_count, 2 * (uint64_t)structure->edge_count);
}

static mt_status allocate_edges(mt_context *context, uint64_t edge_count, mt_winged_edge_mesh *structure)
{
    if (2 * edge_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu edges have more sides than an index can number",
                       (unsigned long long)edge_count);
    }
    structure->edges = mt_allocate_array(context, edge_count, sizeof *structure->edges);
    return structure->edges ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status build_from_pairs(mt_context *context, const mt_mesh *mesh, mt_winged_edge_mesh *structure)
{
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        status = mt_refuse_sides(context, mesh, pairs, WHO_NEEDS);
    }
    if (status == MT_OK) {
        structure->edge_count = pairs->edge_count;
        status = allocate_edges(context, pairs->edge_count, structure);
    }
    if (status == MT_OK) {
        mt_winged_fill(mesh, pairs, structure);
        status = rings_hold(context, structure, true) ? MT_OK : mt_refuse_vertex(context, mesh, WHO_NEEDS);
    }
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

/* The fast way. Sets *done when the structure is complete; else the slow way finds out why. */
static mt_status build_open(mt_context *context, const mt_mesh *mesh, mt_winged_edge_mesh *structure, bool *done)
{
    uint64_t edge_room = edge_chain_room(mesh);
    bool simple = true;
    mt_status status = mt_polygons_are_simple(context, mesh, &simple);
    if (status != MT_OK || !simple || 2 * edge_room > MT_INDEX_MAX) {
        return status;
    }
    open_sides open = {0};
    status = allocate_edges(context, edge_room, structure);
    if (status == MT_OK) {
        status = open_sides_init(context, mesh->vertex_count, &open);
    }
    if (status == MT_OK) {
        *done =
            mt_winged_fill_open(mesh, &open, (mt_index)edge_room, structure) && rings_hold(context, structure, false);
    }
    mt_free(context, open.newest);
    if (!*done) {
        mt_free(context, structure->edges);
        structure->edges = NULL;
    }
    return status;
}

static mt_status build(mt_context *context, const mt_mesh *mesh, mt_winged_edge_mesh *structure)
{
    structure->vertex_count = mesh->vertex_count;
    structure->face_count = mesh->face_count;
    structure->vertex_edge = mt_allocate_array(context, mesh->vertex_count, sizeof *structure->vertex_edge);
    structure->face_edge = mt_allocate_array(context, mesh->face_count, sizeof *structure->face_edge);
    if (!structure->vertex_edge || !structure->face_edge) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    bool done = false;
    if (mt_edge_chains_suit(mesh)) {
        mt_status status = build_open(context, mesh, structure, &done);
        if (status != MT_OK || done) {
            return status;
        }
    }
    return build_from_pairs(context, mesh, structure);
}

mt_status mt_winged_edge_create(mt_context *context, const mt_mesh *mesh, mt_winged_edge_mesh **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "winged edges", "walks around vertices and faces, both ways");
    mt_winged_edge_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? build(context, mesh, structure) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        *out = structure;
    } else {
        mt_winged_edge_destroy(context, structure);
    }
    mt_part_end(context, part);
    return status;
}

void mt_winged_edge_destroy(mt_context *context, mt_winged_edge_mesh *structure)
{
    if (structure) {
        mt_free(context, structure->edges);
        mt_free(context, structure->vertex_edge);
        mt_free(context, structure->face_edge);
        mt_free(context, structure);
    }
}

uint64_t mt_winged_edge_size(const mt_winged_edge_mesh *structure)
{
    return sizeof *structure + structure->edge_count * (uint64_t)sizeof *structure->edges +
           ((uint64_t)structure->vertex_count + structure->face_count) * sizeof(mt_index);
}

static uint64_t count_corners(const mt_winged_edge_mesh *structure)
{
    uint64_t count = 0;
    for (mt_index edge = 0; edge < structure->edge_count; edge++) {
        count += structure->edges[edge].left != MT_NONE;
        count += structure->edges[edge].right != MT_NONE;
    }
    return count;
}

static void write_faces(const mt_winged_edge_mesh *structure, mt_mesh *mesh)
{
    mt_index corner = 0;
    for (mt_index face = 0; face < structure->face_count; face++) {
        mt_index begin = structure->face_edge[face];
        mt_index edge = begin;
        do {
            mesh->corner_vertices[corner++] = mt_winged_edge_origin(structure, edge, face);
            edge = mt_winged_edge_next(structure, edge, face);
        } while (edge != begin);
        mesh->face_offsets[face + 1] = corner;
    }
}

mt_status mt_winged_edge_to_mesh(mt_context *context, const mt_winged_edge_mesh *structure, const mt_mesh *source,
                                 mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = structure->vertex_count,
                             .face_count = structure->face_count,
                             .corner_count = count_corners(structure)};
    mt_status status = mt_source_mesh_create(context, source, &layout, out);
    if (status == MT_OK) {
        write_faces(structure, *out);
        mt_mesh_compact_faces(context, *out);
    }
    return status;
}
