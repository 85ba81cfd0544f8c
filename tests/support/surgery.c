#include "tests/support/surgery.h"
#include "tests/support/unit.h"

#include <meshtool/halfedge_surgery.h>
#include <meshtool/triangle_neighbor_surgery.h>
#include <meshtool/winged_edge_surgery.h>

#include <string.h>

/* Half-edges */

static mt_status halfedge_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    *out = NULL;
    mt_halfedge_mesh *structure = NULL;
    mt_status status = mt_halfedge_create(context, mesh, &structure);
    if (status == MT_OK) {
        status = mt_halfedge_surgery_create(context, structure, (mt_halfedge_surgery **)out);
    }
    mt_halfedge_destroy(context, structure);
    return status;
}

static void halfedge_destroy(mt_context *context, void *surgery)
{
    mt_halfedge_surgery_destroy(context, surgery);
}

/* A half-edge that is not there is not a cut that is missing. */
static mt_index halfedge_cut(const mt_halfedge_surgery *surgery, mt_index end, mt_index vertex)
{
    mt_index found = mt_halfedge_surgery_find(surgery, end, vertex);
    return found == MT_NONE && end != MT_NONE ? surgery->structure.halfedge_count : found;
}

static mt_surgery_verdict halfedge_judge(const void *surgery, const test_operation *at)
{
    mt_index h = mt_halfedge_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_halfedge_can_swap_edge(surgery, h == MT_NONE ? MT_NONE : h / 2);
    case TEST_SPLIT_EDGE:
        return mt_halfedge_can_split_edge(surgery, h);
    case TEST_SPLIT_VERTEX:
        return mt_halfedge_can_split_vertex(surgery, at->a, halfedge_cut(surgery, at->b, at->a),
                                            halfedge_cut(surgery, at->c, at->a));
    case TEST_COLLAPSE_EDGE:
        return mt_halfedge_can_collapse_edge(surgery, h);
    case TEST_REMOVE_FACE:
        return mt_halfedge_can_remove_face(surgery, at->face);
    default:
        return mt_halfedge_can_add_face(surgery, at->count, at->vertices);
    }
}

static mt_status halfedge_operate(mt_context *context, void *surgery, const test_operation *at)
{
    mt_index h = mt_halfedge_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_halfedge_swap_edge(context, surgery, h == MT_NONE ? MT_NONE : h / 2);
    case TEST_SPLIT_EDGE:
        return mt_halfedge_split_edge(context, surgery, h, at->weight, NULL);
    case TEST_SPLIT_VERTEX:
        return mt_halfedge_split_vertex(context, surgery, at->a, halfedge_cut(surgery, at->b, at->a),
                                        halfedge_cut(surgery, at->c, at->a), NULL);
    case TEST_COLLAPSE_EDGE:
        return mt_halfedge_collapse_edge(context, surgery, h, at->weight);
    case TEST_REMOVE_FACE:
        return mt_halfedge_remove_face(context, surgery, at->face);
    default:
        return mt_halfedge_add_face(context, surgery, at->count, at->vertices, NULL);
    }
}

static const mt_edit_log *halfedge_log(const void *surgery)
{
    return &((const mt_halfedge_surgery *)surgery)->log;
}

static mt_status halfedge_faces(mt_context *context, const void *surgery, mt_surgery_map *map, mt_mesh **out)
{
    *out = NULL;
    mt_halfedge_mesh *structure = NULL;
    mt_mesh *points = NULL;
    mt_status status = mt_halfedge_surgery_compact(context, surgery, map, &structure);
    status = status == MT_OK ? mt_halfedge_validate(context, structure) : status;
    if (status == MT_OK) {
        points = test_points(context, structure->vertex_count);
        status = points ? mt_halfedge_to_mesh(context, structure, points, out) : MT_ERROR_OUT_OF_MEMORY;
    }
    mt_mesh_destroy(context, points);
    mt_halfedge_destroy(context, structure);
    return status;
}

static mt_status halfedge_to_mesh(mt_context *context, const void *surgery, const mt_mesh *source, mt_mesh **out)
{
    return mt_halfedge_surgery_to_mesh(context, surgery, source, out);
}

static uint64_t halfedge_hash(const void *opaque)
{
    const mt_halfedge_surgery *surgery = opaque;
    const mt_halfedge_mesh *own = &surgery->structure;
    uint64_t hashes[] = {test_hash(own->halfedges, own->halfedge_count * sizeof *own->halfedges),
                         test_hash(own->vertex_halfedge, own->vertex_count * sizeof(mt_index)),
                         test_hash(own->face_halfedge, own->face_count * sizeof(mt_index)),
                         test_hash(surgery->vertex_deleted, own->vertex_count),
                         test_hash(surgery->marks, own->vertex_count),
                         surgery->log.count};
    return test_hash(hashes, sizeof hashes);
}

/* Winged edges */

static mt_status winged_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    *out = NULL;
    mt_winged_edge_mesh *structure = NULL;
    mt_status status = mt_winged_edge_create(context, mesh, &structure);
    if (status == MT_OK) {
        status = mt_winged_surgery_create(context, structure, (mt_winged_surgery **)out);
    }
    mt_winged_edge_destroy(context, structure);
    return status;
}

static void winged_destroy(mt_context *context, void *surgery)
{
    mt_winged_surgery_destroy(context, surgery);
}

static mt_index winged_cut(const mt_winged_surgery *surgery, mt_index vertex, mt_index end)
{
    mt_index found = mt_winged_surgery_find(surgery, vertex, end);
    return found == MT_NONE && end != MT_NONE ? surgery->structure.edge_count : found;
}

static mt_surgery_verdict winged_judge(const void *surgery, const test_operation *at)
{
    mt_index edge = mt_winged_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_winged_can_swap_edge(surgery, edge);
    case TEST_SPLIT_EDGE:
        return mt_winged_can_split_edge(surgery, edge, at->a);
    case TEST_SPLIT_VERTEX:
        return mt_winged_can_split_vertex(surgery, at->a, winged_cut(surgery, at->a, at->b),
                                          winged_cut(surgery, at->a, at->c));
    case TEST_COLLAPSE_EDGE:
        return mt_winged_can_collapse_edge(surgery, edge, at->a);
    case TEST_REMOVE_FACE:
        return mt_winged_can_remove_face(surgery, at->face);
    default:
        return mt_winged_can_add_face(surgery, at->count, at->vertices);
    }
}

static mt_status winged_operate(mt_context *context, void *surgery, const test_operation *at)
{
    mt_index edge = mt_winged_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_winged_swap_edge(context, surgery, edge);
    case TEST_SPLIT_EDGE:
        return mt_winged_split_edge(context, surgery, edge, at->a, at->weight, NULL);
    case TEST_SPLIT_VERTEX:
        return mt_winged_split_vertex(context, surgery, at->a, winged_cut(surgery, at->a, at->b),
                                      winged_cut(surgery, at->a, at->c), NULL);
    case TEST_COLLAPSE_EDGE:
        return mt_winged_collapse_edge(context, surgery, edge, at->a, at->weight);
    case TEST_REMOVE_FACE:
        return mt_winged_remove_face(context, surgery, at->face);
    default:
        return mt_winged_add_face(context, surgery, at->count, at->vertices, NULL);
    }
}

static const mt_edit_log *winged_log(const void *surgery)
{
    return &((const mt_winged_surgery *)surgery)->log;
}

static mt_status winged_faces(mt_context *context, const void *surgery, mt_surgery_map *map, mt_mesh **out)
{
    *out = NULL;
    mt_winged_edge_mesh *structure = NULL;
    mt_mesh *points = NULL;
    mt_status status = mt_winged_surgery_compact(context, surgery, map, &structure);
    status = status == MT_OK ? mt_winged_edge_validate(context, structure) : status;
    if (status == MT_OK) {
        points = test_points(context, structure->vertex_count);
        status = points ? mt_winged_edge_to_mesh(context, structure, points, out) : MT_ERROR_OUT_OF_MEMORY;
    }
    mt_mesh_destroy(context, points);
    mt_winged_edge_destroy(context, structure);
    return status;
}

static mt_status winged_to_mesh(mt_context *context, const void *surgery, const mt_mesh *source, mt_mesh **out)
{
    return mt_winged_surgery_to_mesh(context, surgery, source, out);
}

static uint64_t winged_hash(const void *opaque)
{
    const mt_winged_surgery *surgery = opaque;
    const mt_winged_edge_mesh *own = &surgery->structure;
    uint64_t hashes[] = {test_hash(own->edges, own->edge_count * sizeof *own->edges),
                         test_hash(own->vertex_edge, own->vertex_count * sizeof(mt_index)),
                         test_hash(own->face_edge, own->face_count * sizeof(mt_index)),
                         test_hash(surgery->vertex_deleted, own->vertex_count),
                         test_hash(surgery->marks, own->vertex_count),
                         surgery->log.count};
    return test_hash(hashes, sizeof hashes);
}

/* Triangle neighbours */

static mt_status triangle_create(mt_context *context, const mt_mesh *mesh, void **out)
{
    *out = NULL;
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_status status = mt_triangle_neighbor_create(context, mesh, &structure);
    if (status == MT_OK) {
        status = mt_triangle_surgery_create(context, structure, (mt_triangle_surgery **)out);
    }
    mt_triangle_neighbor_destroy(context, structure);
    return status;
}

static void triangle_destroy(mt_context *context, void *surgery)
{
    mt_triangle_surgery_destroy(context, surgery);
}

static mt_index triangle_cut(const mt_triangle_surgery *surgery, mt_index vertex, mt_index end)
{
    mt_index found = mt_triangle_surgery_find(surgery, vertex, end);
    return found == MT_NONE && end != MT_NONE ? 3 * surgery->structure.triangle_count : found;
}

static mt_surgery_verdict triangle_judge(const void *surgery, const test_operation *at)
{
    mt_index side = mt_triangle_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_triangle_can_swap_edge(surgery, side);
    case TEST_SPLIT_EDGE:
        return mt_triangle_can_split_edge(surgery, side, at->a);
    case TEST_SPLIT_VERTEX:
        return mt_triangle_can_split_vertex(surgery, at->a, triangle_cut(surgery, at->a, at->b),
                                            triangle_cut(surgery, at->a, at->c));
    case TEST_COLLAPSE_EDGE:
        return mt_triangle_can_collapse_edge(surgery, side, at->a);
    case TEST_REMOVE_FACE:
        return mt_triangle_can_remove_face(surgery, at->face);
    default:
        return mt_triangle_can_add_face(surgery, at->count, at->vertices);
    }
}

static mt_status triangle_operate(mt_context *context, void *surgery, const test_operation *at)
{
    mt_index side = mt_triangle_surgery_find(surgery, at->a, at->b);
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return mt_triangle_swap_edge(context, surgery, side);
    case TEST_SPLIT_EDGE:
        return mt_triangle_split_edge(context, surgery, side, at->a, at->weight, NULL);
    case TEST_SPLIT_VERTEX:
        return mt_triangle_split_vertex(context, surgery, at->a, triangle_cut(surgery, at->a, at->b),
                                        triangle_cut(surgery, at->a, at->c), NULL);
    case TEST_COLLAPSE_EDGE:
        return mt_triangle_collapse_edge(context, surgery, side, at->a, at->weight);
    case TEST_REMOVE_FACE:
        return mt_triangle_remove_face(context, surgery, at->face);
    default:
        return mt_triangle_add_face(context, surgery, at->count, at->vertices, NULL);
    }
}

static const mt_edit_log *triangle_log(const void *surgery)
{
    return &((const mt_triangle_surgery *)surgery)->log;
}

static mt_status triangle_faces(mt_context *context, const void *surgery, mt_surgery_map *map, mt_mesh **out)
{
    *out = NULL;
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_mesh *points = NULL;
    mt_status status = mt_triangle_surgery_compact(context, surgery, map, &structure);
    status = status == MT_OK ? mt_triangle_neighbor_validate(context, structure) : status;
    if (status == MT_OK) {
        points = test_points(context, structure->vertex_count);
        status = points ? mt_triangle_neighbor_to_mesh(context, structure, points, out) : MT_ERROR_OUT_OF_MEMORY;
    }
    mt_mesh_destroy(context, points);
    mt_triangle_neighbor_destroy(context, structure);
    return status;
}

static mt_status triangle_to_mesh(mt_context *context, const void *surgery, const mt_mesh *source, mt_mesh **out)
{
    return mt_triangle_surgery_to_mesh(context, surgery, source, out);
}

static uint64_t triangle_hash(const void *opaque)
{
    const mt_triangle_surgery *surgery = opaque;
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    size_t corner_count = 3 * (size_t)own->triangle_count;
    uint64_t hashes[] = {test_hash(own->vertices, corner_count * sizeof(mt_index)),
                         test_hash(own->neighbors, corner_count * sizeof(mt_index)),
                         test_hash(own->vertex_corner, own->vertex_count * sizeof(mt_index)),
                         test_hash(surgery->vertex_deleted, own->vertex_count),
                         test_hash(surgery->marks, own->vertex_count),
                         surgery->log.count};
    return test_hash(hashes, sizeof hashes);
}

mt_mesh *test_points(mt_context *context, mt_index count)
{
    mt_mesh *mesh = NULL;
    const mt_mesh_layout layout = {.vertex_count = count, .face_size = 3, .position_type = MT_F64};
    if (mt_mesh_create(context, &layout, &mesh) == MT_OK) {
        memset(mesh->positions, 0, 3 * sizeof(double) * count);
    }
    return mesh;
}

const test_surgeon test_surgeons[] = {
    {"half-edge", false, halfedge_create, halfedge_destroy, halfedge_judge, halfedge_operate, halfedge_log,
     halfedge_faces, halfedge_to_mesh, halfedge_hash},
    {"winged-edge", false, winged_create, winged_destroy, winged_judge, winged_operate, winged_log, winged_faces,
     winged_to_mesh, winged_hash},
    {"triangle-neighbor", true, triangle_create, triangle_destroy, triangle_judge, triangle_operate, triangle_log,
     triangle_faces, triangle_to_mesh, triangle_hash},
};
const size_t test_surgeon_count = sizeof test_surgeons / sizeof *test_surgeons;
