/* Building and unbuilding the half-edge structure: in one pass where faces lie near each other, else from paired sides.
 * A mesh that the structure cannot hold is refused with its first offender (refusal.c), never thinned out.
 *
 * Cost: O(vertices + corners) time; 12 bytes a half-edge, 4 a vertex and 4 a face kept; meanwhile 4 a vertex more, or
 * from pairs 16 a corner. */
#include "lib/topology/halfedge_fill.h"
#include "lib/topology/ring_check.h"
#include "lib/topology/source_mesh.h"

#include <meshtool/degenerate_faces.h>
#include <meshtool/refusal.h>

#include <string.h>

#define WHO_NEEDS "half-edges need"

static mt_status allocate_structure(mt_context *context, const mt_mesh *mesh, uint64_t edge_room,
                                    mt_halfedge_mesh *structure)
{
    if (2 * edge_room > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu edges need more half-edges than an index can number",
                       (unsigned long long)edge_room);
    }
    structure->vertex_count = mesh->vertex_count;
    structure->face_count = mesh->face_count;
    structure->halfedges = mt_allocate_array(context, 2 * edge_room, sizeof *structure->halfedges);
    structure->vertex_halfedge = mt_allocate_array(context, mesh->vertex_count, sizeof *structure->vertex_halfedge);
    structure->face_halfedge = mt_allocate_array(context, mesh->face_count, sizeof *structure->face_halfedge);
    bool complete = structure->halfedges && structure->vertex_halfedge && structure->face_halfedge;
    return complete ? MT_OK : mt_context_error(context)->status;
}

static void release_arrays(mt_context *context, mt_halfedge_mesh *structure)
{
    mt_free(context, structure->halfedges);
    mt_free(context, structure->vertex_halfedge);
    mt_free(context, structure->face_halfedge);
    *structure = (mt_halfedge_mesh){0};
}

static ring_step walk_ring(const void *structure, mt_index vertex, mt_index at)
{
    const mt_halfedge *halfedges = ((const mt_halfedge_mesh *)structure)->halfedges;
    mt_index next = halfedges[at].next;
    (void)vertex;
    return (ring_step){halfedges[next].head, next ^ 1u};
}

static const void *place_of(const void *structure, mt_index at)
{
    return &((const mt_halfedge_mesh *)structure)->halfedges[at];
}

static void check_rings(void *user, uint64_t begin, uint64_t end)
{
    ring_check_vertices(walk_ring, place_of, user, begin, end);
}

/* Whether the rings of all vertices meet every half-edge, and none a neighbour twice. */
static bool rings_hold(mt_context *context, const mt_halfedge_mesh *structure, bool edges_are_known)
{
    ring_check check = {structure, structure->vertex_halfedge, edges_are_known, 0, false};
    return ring_check_holds(context, check_rings, &check, structure->vertex_count, structure->halfedge_count);
}

static mt_status build_from_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs,
                                  mt_halfedge_mesh *structure)
{
    mt_status status = mt_refuse_sides(context, mesh, pairs, WHO_NEEDS);
    if (status == MT_OK) {
        status = allocate_structure(context, mesh, pairs->edge_count, structure);
    }
    if (status != MT_OK) {
        return status;
    }
    structure->halfedge_count = 2 * pairs->edge_count;
    if (!mt_halfedge_fill(mesh, pairs, structure) || !rings_hold(context, structure, true)) {
        return mt_refuse_vertex(context, mesh, WHO_NEEDS);
    }
    return MT_OK;
}

/* The fast way. Sets *done when the structure is complete; else it is empty, and the slow way finds out why. */
static mt_status build_open(mt_context *context, const mt_mesh *mesh, mt_halfedge_mesh *structure, bool *done)
{
    uint64_t edge_room = edge_chain_room(mesh);
    bool simple = true;
    mt_status status = mt_polygons_are_simple(context, mesh, &simple);
    if (status != MT_OK || !simple || 2 * edge_room > MT_INDEX_MAX) {
        return status;
    }
    open_sides open = {0};
    status = allocate_structure(context, mesh, edge_room, structure);
    if (status == MT_OK) {
        status = open_sides_init(context, mesh->vertex_count, &open);
    }
    if (status == MT_OK) {
        *done =
            mt_halfedge_fill_open(mesh, &open, (mt_index)edge_room, structure) && rings_hold(context, structure, false);
    }
    mt_free(context, open.newest);
    if (!*done) {
        release_arrays(context, structure);
    }
    return status;
}

static mt_status build(mt_context *context, const mt_mesh *mesh, mt_halfedge_mesh *structure)
{
    bool done = false;
    if (mt_edge_chains_suit(mesh)) {
        mt_status status = build_open(context, mesh, structure, &done);
        if (status != MT_OK || done) {
            return status;
        }
    }
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        status = build_from_pairs(context, mesh, pairs, structure);
    }
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

mt_status mt_halfedge_create(mt_context *context, const mt_mesh *mesh, mt_halfedge_mesh **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "half-edges", "walks around vertices and faces");
    mt_halfedge_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    mt_status status = structure ? build(context, mesh, structure) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        *out = structure;
    } else {
        mt_halfedge_destroy(context, structure);
    }
    mt_part_end(context, part);
    return status;
}

void mt_halfedge_destroy(mt_context *context, mt_halfedge_mesh *structure)
{
    if (structure) {
        release_arrays(context, structure);
        mt_free(context, structure);
    }
}

uint64_t mt_halfedge_size(const mt_halfedge_mesh *structure)
{
    return sizeof *structure + structure->halfedge_count * (uint64_t)sizeof *structure->halfedges +
           ((uint64_t)structure->vertex_count + structure->face_count) * sizeof(mt_index);
}

static uint64_t count_corners(const mt_halfedge_mesh *structure)
{
    uint64_t count = 0;
    for (mt_index h = 0; h < structure->halfedge_count; h++) {
        count += !mt_halfedge_is_boundary(structure, h);
    }
    return count;
}

static void write_faces(const mt_halfedge_mesh *structure, mt_mesh *mesh)
{
    mt_index corner = 0;
    for (mt_index face = 0; face < structure->face_count; face++) {
        mt_index begin = structure->face_halfedge[face];
        mt_index h = begin;
        do {
            mesh->corner_vertices[corner++] = mt_halfedge_tail(structure, h);
            h = mt_halfedge_next(structure, h);
        } while (h != begin);
        mesh->face_offsets[face + 1] = corner;
    }
}

mt_status mt_halfedge_to_mesh(mt_context *context, const mt_halfedge_mesh *structure, const mt_mesh *source,
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
