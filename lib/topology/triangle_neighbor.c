/* Building and unbuilding the triangle-neighbour structure. A mesh that the structure cannot hold is refused with its
 * first offender (refusal.c), never thinned out.
 *
 * That no vertex has several fans shows in a count: one fan a vertex is walked, and all corners must be met.
 *
 * Cost: O(vertices + corners) time; 24 bytes a triangle and 4 a vertex kept, what pairing needs meanwhile. */
#include <meshtool/refusal.h>

#include "lib/topology/ring_check.h"
#include "lib/topology/source_mesh.h"
#include "lib/topology/triangle_fill.h"

#include <string.h>

#define WHO_NEEDS "triangle neighbours need"

static mt_status refuse_polygons(mt_context *context, const mt_mesh *mesh)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        if (sides != 3) {
            return mt_fail(context, MT_ERROR_INVALID_MESH,
                           "face %u has %u sides, and the triangle-neighbour structure holds triangles alone; "
                           "`meshtool convert --triangulate` makes them",
                           face, sides);
        }
        if (!mesh->face_offsets) {
            break;
        }
    }
    return MT_OK;
}

static ring_step walk_fan(const void *structure, mt_index vertex, mt_index at)
{
    const mt_triangle_neighbor_mesh *triangles = structure;
    mt_index side = mt_triangle_previous_corner(at);
    mt_index next = triangles->neighbors[side];
    if (next == MT_NONE) {
        next = triangles->vertex_corner[vertex];
    }
    return (ring_step){triangles->vertices[side], next};
}

static const void *place_of(const void *structure, mt_index at)
{
    return &((const mt_triangle_neighbor_mesh *)structure)->neighbors[mt_triangle_previous_corner(at)];
}

static void check_fans(void *user, uint64_t begin, uint64_t end)
{
    ring_check_vertices(walk_fan, place_of, user, begin, end);
}

/* Whether the fans of all vertices meet every corner, and none a neighbour twice. On the boundary the first neighbour
 * is not looked at: were it met twice, so would this vertex be in its fan, since opposite open sides have been joined.
 */
static bool fans_hold(mt_context *context, const mt_triangle_neighbor_mesh *structure, bool edges_are_known)
{
    ring_check check = {structure, structure->vertex_corner, edges_are_known, 0, false};
    return ring_check_holds(context, check_fans, &check, structure->vertex_count,
                            3 * (uint64_t)structure->triangle_count);
}

static mt_status build_from_pairs(mt_context *context, const mt_mesh *mesh, mt_triangle_neighbor_mesh *structure)
{
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        status = mt_refuse_sides(context, mesh, pairs, WHO_NEEDS);
    }
    if (status == MT_OK) {
        mt_triangle_fill(mesh, pairs, structure);
        status = fans_hold(context, structure, true) ? MT_OK : mt_refuse_vertex(context, mesh, WHO_NEEDS);
    }
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

/* The fast way. Sets *done when the structure is complete; else the slow way finds out why. */
static mt_status build_open(mt_context *context, const mt_mesh *mesh, mt_triangle_neighbor_mesh *structure, bool *done)
{
    open_sides open;
    mt_status status = open_sides_init(context, mesh->vertex_count, &open);
    structure->neighbors = mt_allocate_array(context, mesh->corner_count, sizeof *structure->neighbors);
    if (status == MT_OK && structure->neighbors) {
        *done = mt_triangle_fill_open(mesh, &open, structure) && fans_hold(context, structure, false);
    }
    status = structure->neighbors ? status : MT_ERROR_OUT_OF_MEMORY;
    mt_free(context, open.newest);
    if (!*done) {
        mt_free(context, structure->neighbors);
        structure->neighbors = NULL;
    }
    return status;
}

static mt_status build(mt_context *context, const mt_mesh *mesh, mt_triangle_neighbor_mesh *structure)
{
    structure->vertex_count = mesh->vertex_count;
    structure->triangle_count = mesh->face_count;
    structure->vertices = mt_allocate_array(context, mesh->corner_count, sizeof *structure->vertices);
    structure->vertex_corner = mt_allocate_array(context, mesh->vertex_count, sizeof *structure->vertex_corner);
    if (!structure->vertices || !structure->vertex_corner) {
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

mt_status mt_triangle_neighbor_create(mt_context *context, const mt_mesh *mesh, mt_triangle_neighbor_mesh **out)
{
    *out = NULL;
    mt_status status = refuse_polygons(context, mesh);
    if (status != MT_OK) {
        return status;
    }
    int part = mt_part_begin(context, "triangle neighbours", "steps across sides and around vertices");
    mt_triangle_neighbor_mesh *structure = mt_allocate_zeroed(context, sizeof *structure);
    status = structure ? build(context, mesh, structure) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        *out = structure;
    } else {
        mt_triangle_neighbor_destroy(context, structure);
    }
    mt_part_end(context, part);
    return status;
}

void mt_triangle_neighbor_destroy(mt_context *context, mt_triangle_neighbor_mesh *structure)
{
    if (structure) {
        mt_free(context, structure->vertices);
        mt_free(context, structure->neighbors);
        mt_free(context, structure->vertex_corner);
        mt_free(context, structure);
    }
}

uint64_t mt_triangle_neighbor_size(const mt_triangle_neighbor_mesh *structure)
{
    return sizeof *structure + (6 * (uint64_t)structure->triangle_count + structure->vertex_count) * sizeof(mt_index);
}

mt_status mt_triangle_neighbor_to_mesh(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                       const mt_mesh *source, mt_mesh **out)
{
    mt_mesh_layout layout = {
        .vertex_count = structure->vertex_count, .face_count = structure->triangle_count, .face_size = 3};
    mt_status status = mt_source_mesh_create(context, source, &layout, out);
    if (status == MT_OK) {
        memcpy((*out)->corner_vertices, structure->vertices,
               3 * (size_t)structure->triangle_count * sizeof *structure->vertices);
    }
    return status;
}
