#include "tests/support/connectivity.h"
#include "tests/support/unit.h"

#include <meshtool/halfedge.h>
#include <meshtool/triangle_neighbor.h>
#include <meshtool/winged_edge.h>

static void add(test_ring *ring, mt_index neighbor, mt_index face)
{
    assert_true(ring->count < TEST_RING_ROOM);
    ring->spokes[ring->count++] = (test_spoke){neighbor, face};
}

static uint64_t hash_three(const void *a, size_t a_size, const mt_index *b, size_t b_count, const mt_index *c,
                           size_t c_count)
{
    uint64_t hashes[3] = {test_hash(a, a_size), test_hash(b, b_count * sizeof *b), test_hash(c, c_count * sizeof *c)};
    return test_hash(hashes, sizeof hashes);
}

/* Half-edges */

static mt_status halfedge_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    return mt_halfedge_create(context, mesh, (mt_halfedge_mesh **)out);
}

static void halfedge_destroy(mt_context *context, void *structure)
{
    mt_halfedge_destroy(context, structure);
}

static mt_status halfedge_validate(mt_context *context, const void *structure)
{
    return mt_halfedge_validate(context, structure);
}

static mt_status halfedge_to_mesh(mt_context *context, const void *structure, const mt_mesh *source, mt_mesh **out)
{
    return mt_halfedge_to_mesh(context, structure, source, out);
}

static uint64_t halfedge_size(const void *structure)
{
    return mt_halfedge_size(structure);
}

static uint64_t halfedge_hash(const void *opaque)
{
    const mt_halfedge_mesh *structure = opaque;
    return hash_three(structure->halfedges, structure->halfedge_count * sizeof *structure->halfedges,
                      structure->vertex_halfedge, structure->vertex_count, structure->face_halfedge,
                      structure->face_count);
}

static void halfedge_vertex_ring(const void *structure, mt_index vertex, bool clockwise, test_ring *ring)
{
    mt_halfedge_ring at =
        clockwise ? mt_halfedge_ring_begin_clockwise(structure, vertex) : mt_halfedge_ring_begin(structure, vertex);
    while (mt_halfedge_ring_goes_on(&at)) {
        assert_int_equal(mt_halfedge_head(structure, at.halfedge), vertex);
        add(ring, at.neighbor, at.face);
        if (clockwise) {
            mt_halfedge_ring_clockwise(structure, &at);
        } else {
            mt_halfedge_ring_counterclockwise(structure, &at);
        }
    }
}

static void halfedge_face_ring(const void *structure, mt_index face, bool clockwise, test_ring *ring)
{
    mt_index begin = ((const mt_halfedge_mesh *)structure)->face_halfedge[face], h = begin;
    do {
        add(ring, mt_halfedge_tail(structure, h), mt_halfedge_face(structure, h ^ 1u));
        h = clockwise ? mt_halfedge_previous(structure, h) : mt_halfedge_next(structure, h);
    } while (h != begin);
}

/* Winged edges */

static mt_status winged_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    return mt_winged_edge_create(context, mesh, (mt_winged_edge_mesh **)out);
}

static void winged_destroy(mt_context *context, void *structure)
{
    mt_winged_edge_destroy(context, structure);
}

static mt_status winged_validate(mt_context *context, const void *structure)
{
    return mt_winged_edge_validate(context, structure);
}

static mt_status winged_to_mesh(mt_context *context, const void *structure, const mt_mesh *source, mt_mesh **out)
{
    return mt_winged_edge_to_mesh(context, structure, source, out);
}

static uint64_t winged_size(const void *structure)
{
    return mt_winged_edge_size(structure);
}

static uint64_t winged_hash(const void *opaque)
{
    const mt_winged_edge_mesh *structure = opaque;
    return hash_three(structure->edges, structure->edge_count * sizeof *structure->edges, structure->vertex_edge,
                      structure->vertex_count, structure->face_edge, structure->face_count);
}

static void winged_vertex_ring(const void *structure, mt_index vertex, bool clockwise, test_ring *ring)
{
    mt_winged_ring at =
        clockwise ? mt_winged_ring_begin_clockwise(structure, vertex) : mt_winged_ring_begin(structure, vertex);
    while (mt_winged_ring_goes_on(&at)) {
        add(ring, at.neighbor, at.face);
        assert_int_equal(at.neighbor, mt_winged_edge_other_vertex(structure, at.edge, vertex));
        if (clockwise) {
            mt_winged_ring_clockwise(structure, &at);
        } else {
            mt_winged_ring_counterclockwise(structure, &at);
        }
    }
}

static void winged_face_ring(const void *structure, mt_index face, bool clockwise, test_ring *ring)
{
    mt_index begin = ((const mt_winged_edge_mesh *)structure)->face_edge[face], edge = begin;
    do {
        add(ring, mt_winged_edge_origin(structure, edge, face), mt_winged_edge_other_face(structure, edge, face));
        edge = clockwise ? mt_winged_edge_previous(structure, edge, face) : mt_winged_edge_next(structure, edge, face);
    } while (edge != begin);
}

/* Triangle neighbours */

static mt_status triangle_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    return mt_triangle_neighbor_create(context, mesh, (mt_triangle_neighbor_mesh **)out);
}

static void triangle_destroy(mt_context *context, void *structure)
{
    mt_triangle_neighbor_destroy(context, structure);
}

static mt_status triangle_validate(mt_context *context, const void *structure)
{
    return mt_triangle_neighbor_validate(context, structure);
}

static mt_status triangle_to_mesh(mt_context *context, const void *structure, const mt_mesh *source, mt_mesh **out)
{
    return mt_triangle_neighbor_to_mesh(context, structure, source, out);
}

static uint64_t triangle_size(const void *structure)
{
    return mt_triangle_neighbor_size(structure);
}

static uint64_t triangle_hash(const void *opaque)
{
    const mt_triangle_neighbor_mesh *structure = opaque;
    size_t corner_count = 3 * (size_t)structure->triangle_count;
    return hash_three(structure->vertices, corner_count * sizeof *structure->vertices, structure->neighbors,
                      corner_count, structure->vertex_corner, structure->vertex_count);
}

static void triangle_vertex_ring(const void *structure, mt_index vertex, bool clockwise, test_ring *ring)
{
    mt_triangle_ring at =
        clockwise ? mt_triangle_ring_begin_clockwise(structure, vertex) : mt_triangle_ring_begin(structure, vertex);
    while (mt_triangle_ring_goes_on(&at)) {
        add(ring, at.neighbor, mt_triangle_of_corner(at.corner));
        if (clockwise) {
            mt_triangle_ring_clockwise(structure, &at);
        } else {
            mt_triangle_ring_counterclockwise(structure, &at);
        }
    }
}

static void triangle_face_ring(const void *opaque, mt_index face, bool clockwise, test_ring *ring)
{
    const mt_triangle_neighbor_mesh *structure = opaque;
    mt_index corner = 3 * face;
    do {
        add(ring, structure->vertices[corner], mt_triangle_neighbor_across(structure, corner));
        corner = clockwise ? mt_triangle_previous_corner(corner) : mt_triangle_next_corner(corner);
    } while (corner != 3 * face);
}

const test_structure test_structures[TEST_STRUCTURE_COUNT] = {
    {"half-edge", false, halfedge_create, halfedge_destroy, halfedge_validate, halfedge_to_mesh, halfedge_size,
     halfedge_hash, halfedge_vertex_ring, halfedge_face_ring},
    {"winged-edge", false, winged_create, winged_destroy, winged_validate, winged_to_mesh, winged_size, winged_hash,
     winged_vertex_ring, winged_face_ring},
    {"triangle-neighbor", true, triangle_create, triangle_destroy, triangle_validate, triangle_to_mesh, triangle_size,
     triangle_hash, triangle_vertex_ring, triangle_face_ring},
};
