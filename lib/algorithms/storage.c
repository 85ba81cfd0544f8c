/* Storage by formula, and as the context counts it. */
#include <meshtool/storage.h>

#include <meshtool/halfedge.h>
#include <meshtool/strips.h>
#include <meshtool/triangle_neighbor.h>
#include <meshtool/triangulate.h>
#include <meshtool/winged_edge.h>

#include <string.h>

typedef struct storage_counts {
    uint64_t vertices, faces, triangles, corners, edges, offsets;
} storage_counts;

static storage_counts count_all(const mt_mesh *mesh, uint64_t edge_count)
{
    storage_counts n = {.vertices = mesh->vertex_count, .faces = mesh->face_count, .corners = mesh->corner_count};
    n.triangles = n.corners - 2 * n.faces;
    n.edges = edge_count == MT_STORAGE_CLOSED ? (n.corners + 1) / 2 : edge_count;
    n.offsets = mesh->face_offsets ? n.faces + 1 : 0;
    return n;
}

mt_storage mt_storage_by_formula(const mt_mesh *mesh, mt_storage_kind kind, uint64_t edge_count)
{
    storage_counts n = count_all(mesh, edge_count);
    const mt_storage rows[MT_STORAGE_COUNT] = {
        [MT_STORAGE_SEPARATE_TRIANGLES] = {"separate_triangles", "separate triangles", "9 n_t", 9 * n.triangles, 0},
        [MT_STORAGE_INDEXED_MESH] = {"indexed_mesh", "indexed triangles", "3 n_v + 3 n_t", 3 * n.vertices,
                                     3 * n.triangles},
        [MT_STORAGE_INDEXED_POLYGONS] = {"indexed_polygons", "indexed polygons",
                                         n.offsets ? "3 n_v + corners + n_f + 1" : "3 n_v + corners", 3 * n.vertices,
                                         n.corners + n.offsets},
        [MT_STORAGE_TRIANGLE_STRIPS] = {"triangle_strips", "triangle strips", "3 n_v + n_t + 2", 3 * n.vertices,
                                        n.triangles ? n.triangles + 2 : 0},
        [MT_STORAGE_TRIANGLE_FANS] = {"triangle_fans", "triangle fans", "3 n_v + 1.5 n_t", 3 * n.vertices,
                                      (3 * n.triangles + 1) / 2},
        [MT_STORAGE_TRIANGLE_NEIGHBOR] = {"triangle_neighbor", "triangle neighbors", "4 n_v + 6 n_t", 3 * n.vertices,
                                          n.vertices + 6 * n.triangles},
        [MT_STORAGE_TRIANGLE_NEIGHBOR_PLAIN] = {"triangle_neighbor_plain", "the same, plain", "4 n_v + 6 n_t",
                                                3 * n.vertices, n.vertices + 6 * n.triangles},
        [MT_STORAGE_WINGED_EDGE] = {"winged_edge", "winged edges", "4 n_v + 8 n_e + n_f", 3 * n.vertices,
                                    n.vertices + n.faces + 8 * n.edges},
        [MT_STORAGE_HALF_EDGE] = {"half_edge", "half-edges", "4 n_v + 6 n_e + n_f", 3 * n.vertices,
                                  n.vertices + n.faces + 6 * n.edges},
    };
    return rows[kind];
}

mt_mesh mt_storage_bare_mesh(const mt_mesh *mesh)
{
    mt_mesh bare = {.vertex_count = mesh->vertex_count,
                    .position_type = mesh->position_type,
                    .positions = mesh->positions,
                    .face_count = mesh->face_count,
                    .corner_count = mesh->corner_count,
                    .face_size = mesh->face_size,
                    .face_offsets = mesh->face_offsets,
                    .corner_vertices = mesh->corner_vertices,
                    .up = mesh->up};
    return bare;
}

/* Each builds its way from a mesh, stores the bytes held for it beside *bytes, and drops it. */
typedef mt_status (*storage_builder)(mt_context *context, const mt_mesh *mesh, uint64_t *bytes);

static mt_status build_separate(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    uint64_t before = mt_context_bytes(context), size = 3 * mt_type_size(mesh->position_type);
    char *points = mt_allocate_array(context, mesh->corner_count, size);
    if (!points) {
        return mt_context_error(context)->status;
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        const char *from = (const char *)mesh->positions + mesh->corner_vertices[corner] * size;
        memcpy(points + corner * size, from, size);
    }
    *bytes = mt_context_bytes(context) - before;
    mt_free(context, points);
    return MT_OK;
}

static mt_status build_indexed(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    uint64_t before = mt_context_bytes(context);
    mt_mesh *copy = NULL;
    mt_status status = mt_mesh_copy(context, mesh, &copy);
    *bytes = mt_context_bytes(context) - before;
    mt_mesh_destroy(context, copy);
    return status;
}

static uint64_t position_bytes(const mt_mesh *mesh)
{
    return 3 * (uint64_t)mesh->vertex_count * mt_type_size(mesh->position_type);
}

static mt_status build_runs(mt_context *context, const mt_mesh *mesh, mt_strip_kind kind, uint64_t *bytes)
{
    mt_strip_options options = {.kind = kind};
    mt_strips *strips = NULL;
    mt_status status = mt_strips_create(context, mesh, &options, &strips);
    if (status == MT_OK) {
        *bytes = mt_strips_index_count(strips) * sizeof(mt_index) + position_bytes(mesh);
    }
    mt_strips_destroy(context, strips);
    return status;
}

static mt_status build_strips(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    return build_runs(context, mesh, MT_STRIP_KIND_STRIP, bytes);
}

static mt_status build_fans(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    return build_runs(context, mesh, MT_STRIP_KIND_FAN, bytes);
}

static mt_status build_triangle_neighbor(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    uint64_t before = mt_context_bytes(context);
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_status status = mt_triangle_neighbor_create(context, mesh, &structure);
    *bytes = mt_context_bytes(context) - before + position_bytes(mesh);
    mt_triangle_neighbor_destroy(context, structure);
    return status;
}

/* The plain form has arrays alone: vertices and neighbours of triangles, and a triangle of each vertex. */
static mt_status build_plain(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_status status = mt_triangle_neighbor_create(context, mesh, &structure);
    if (status != MT_OK) {
        return status;
    }
    uint64_t before = mt_context_bytes(context);
    mt_index *vertices = mt_allocate_array(context, mesh->corner_count, sizeof *vertices);
    mt_index *neighbors = mt_allocate_array(context, mesh->corner_count, sizeof *neighbors);
    mt_index *triangles = mt_allocate_array(context, mesh->vertex_count, sizeof *triangles);
    if (vertices && neighbors && triangles) {
        memcpy(vertices, structure->vertices, mesh->corner_count * sizeof *vertices);
        mt_triangle_neighbor_unpack(structure, neighbors);
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            triangles[vertex] = mt_triangle_of_corner(structure->vertex_corner[vertex]);
        }
        *bytes = mt_context_bytes(context) - before + position_bytes(mesh);
    } else {
        status = mt_context_error(context)->status;
    }
    mt_free(context, vertices);
    mt_free(context, neighbors);
    mt_free(context, triangles);
    mt_triangle_neighbor_destroy(context, structure);
    return status;
}

static mt_status build_winged_edge(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    uint64_t before = mt_context_bytes(context);
    mt_winged_edge_mesh *structure = NULL;
    mt_status status = mt_winged_edge_create(context, mesh, &structure);
    *bytes = mt_context_bytes(context) - before + position_bytes(mesh);
    mt_winged_edge_destroy(context, structure);
    return status;
}

static mt_status build_halfedge(mt_context *context, const mt_mesh *mesh, uint64_t *bytes)
{
    uint64_t before = mt_context_bytes(context);
    mt_halfedge_mesh *structure = NULL;
    mt_status status = mt_halfedge_create(context, mesh, &structure);
    *bytes = mt_context_bytes(context) - before + position_bytes(mesh);
    mt_halfedge_destroy(context, structure);
    return status;
}

static const struct {
    storage_builder build;
    bool of_triangles;
} builders[MT_STORAGE_COUNT] = {
    [MT_STORAGE_SEPARATE_TRIANGLES] = {build_separate, true},
    [MT_STORAGE_INDEXED_MESH] = {build_indexed, true},
    [MT_STORAGE_INDEXED_POLYGONS] = {build_indexed, false},
    [MT_STORAGE_TRIANGLE_STRIPS] = {build_strips, false},
    [MT_STORAGE_TRIANGLE_FANS] = {build_fans, false},
    [MT_STORAGE_TRIANGLE_NEIGHBOR] = {build_triangle_neighbor, true},
    [MT_STORAGE_TRIANGLE_NEIGHBOR_PLAIN] = {build_plain, true},
    [MT_STORAGE_WINGED_EDGE] = {build_winged_edge, false},
    [MT_STORAGE_HALF_EDGE] = {build_halfedge, false},
};

mt_status mt_storage_measure(mt_context *context, const mt_mesh *mesh, mt_storage_kind kind, uint64_t *bytes)
{
    mt_mesh bare = mt_storage_bare_mesh(mesh);
    mt_mesh *triangles = NULL;
    mt_status status = MT_OK;
    *bytes = 0;
    if (builders[kind].of_triangles && (mesh->face_offsets || mesh->face_size != 3)) {
        status = mt_mesh_triangulate(context, &bare, &triangles);
    }
    if (status == MT_OK) {
        status = builders[kind].build(context, triangles ? triangles : &bare, bytes);
    }
    mt_mesh_destroy(context, triangles);
    if (status == MT_OK) {
        status = mt_progress(context, "measuring storage", 1);
    }
    return status;
}
