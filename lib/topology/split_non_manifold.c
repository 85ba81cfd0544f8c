/* Splitting to a fixpoint in three rounds (cutting along singular edges as in Gueziec, Taubin, Lazarus and Horn,
 * "Cutting and Stitching", 2001, but with the least pieces that vertex numbers can tell apart):
 *
 * 1. Corners of a vertex that hang together across edges of two faces keep one vertex, other fans get their own. This
 * cuts non-manifold edges as far as their ends come apart; where two faces still name both ends, they stay joined.
 * 2. What is left over has both ends within one fan: such fans are cut, and so are those that meet a face twice.
 * 3. Cutting a fan can divide those of its neighbours: these are told apart.
 *
 * After the second round no edge has a third side, and telling vertices apart never gives one: so three rounds do.
 *
 * Cost: O(vertices + corners) time; the pairing of edges, and 8 bytes a vertex and some 20 a corner meanwhile. */
#include <meshtool/split_non_manifold.h>

#include "lib/topology/split_creases.h"
#include "lib/topology/split_fans.h"

#include <meshtool/derive.h>

#include <string.h>

/* Whether the faces of two corners are the same sequence of vertices, at these corners and onward. */
static bool same_face(const mt_mesh *mesh, mt_index corner, mt_index face, mt_index other, mt_index other_face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), other_begin = mt_mesh_face_begin(mesh, other_face);
    mt_index sides = mt_mesh_face_sides(mesh, face);
    bool same = sides == mt_mesh_face_sides(mesh, other_face);
    mt_index i = corner - begin, j = other - other_begin;
    for (mt_index step = 0; same && step < sides; step++) {
        same = mesh->corner_vertices[begin + i] == mesh->corner_vertices[other_begin + j];
        i = i + 1 < sides ? i + 1 : 0;
        j = j + 1 < sides ? j + 1 : 0;
    }
    return same;
}

/* Marks the sides of misoriented edges, but for those of faces given twice. One look a face decides: a face given twice
 * shares all its edges with the other. */
static void mark_misoriented(const mt_mesh *mesh, const mt_edge_pairs *pairs, uint8_t *misoriented)
{
    memset(misoriented, 0, mesh->corner_count);
    for (mt_index face = 0; face < mesh->face_count && pairs->misoriented_count; face++) {
        bool looked = false, twice = false;
        mt_index end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < end; corner++) {
            if (mt_edge_class_of(mesh, pairs, corner) != MT_EDGE_MISORIENTED) {
                continue;
            }
            mt_index other = pairs->next_side[corner];
            mt_index other_face = mt_mesh_corner_face(mesh, other);
            twice = looked ? twice : face != other_face && same_face(mesh, corner, face, other, other_face);
            looked = true;
            misoriented[corner] = !twice;
        }
    }
}

static mt_status split_once(mt_context *context, fan_splitting *splitting, uint8_t *misoriented, bool cut)
{
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, &splitting->mesh, &pairs);
    if (status != MT_OK) {
        return status;
    }
    if (misoriented) {
        mark_misoriented(&splitting->mesh, pairs, misoriented);
    }
    mt_split_fans(splitting, pairs, cut);
    mt_edge_pairs_destroy(context, pairs);
    return MT_OK;
}

static mt_status split_to_fixpoint(mt_context *context, fan_splitting *splitting, uint8_t *misoriented)
{
    mt_status status = split_once(context, splitting, misoriented, false);
    mt_index before = splitting->mesh.vertex_count;
    if (status == MT_OK) {
        status = split_once(context, splitting, NULL, true);
    }
    if (status == MT_OK && splitting->mesh.vertex_count != before) {
        status = split_once(context, splitting, NULL, false);
    }
    return status;
}

static mt_status derive(mt_context *context, const mt_mesh *mesh, const fan_splitting *splitting, mt_mesh **out)
{
    mt_derivation derivation = {.vertex_count = splitting->mesh.vertex_count,
                                .vertex_sources = splitting->sources,
                                .face_count = mesh->face_count,
                                .face_size = mesh->face_size,
                                .face_offsets = mesh->face_offsets,
                                .corner_count = mesh->corner_count,
                                .corner_vertices = splitting->mesh.corner_vertices};
    mt_status status = mt_mesh_derive(context, mesh, &derivation, out);
    if (status == MT_OK && splitting->mesh.vertex_count != mesh->vertex_count) {
        status = mt_split_creases(context, mesh, splitting->sources, *out);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}

static void list_corner_faces(const mt_mesh *mesh, mt_index *corner_face)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            corner_face[corner] = face;
        }
    }
}

static bool allocate_splitting(mt_context *context, const mt_mesh *mesh, fan_splitting *splitting,
                               uint8_t **misoriented)
{
    uint64_t corners = mesh->corner_count, vertices = mesh->vertex_count + corners;
    splitting->mesh = *mesh;
    splitting->vertex_room = (mt_index)vertices;
    splitting->mesh.corner_vertices = mt_allocate_array(context, corners, sizeof(mt_index));
    splitting->misoriented = *misoriented = mt_allocate(context, corners);
    splitting->corner_face = mesh->face_offsets ? mt_allocate_array(context, corners, sizeof(mt_index)) : NULL;
    splitting->sources = mt_allocate_array(context, vertices, sizeof(mt_index));
    splitting->vertex_run = mt_allocate_array(context, vertices, sizeof(mt_index));
    splitting->face_run = mt_allocate_array(context, mesh->face_count, sizeof(mt_index));
    splitting->corner_done = mt_allocate(context, corners);
    splitting->vertex_seen = mt_allocate(context, vertices);
    return splitting->mesh.corner_vertices && *misoriented && (splitting->corner_face || !mesh->face_offsets) &&
           splitting->sources && splitting->vertex_run && splitting->face_run && splitting->corner_done &&
           splitting->vertex_seen;
}

static void prepare(const mt_mesh *mesh, fan_splitting *splitting)
{
    memcpy(splitting->mesh.corner_vertices, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        splitting->sources[vertex] = vertex;
    }
    if (splitting->corner_face) {
        list_corner_faces(mesh, splitting->corner_face);
    }
}

static void release_splitting(mt_context *context, fan_splitting *splitting)
{
    mt_free(context, splitting->mesh.corner_vertices);
    mt_free(context, (void *)splitting->misoriented);
    mt_free(context, splitting->corner_face);
    mt_free(context, splitting->sources);
    mt_free(context, splitting->vertex_run);
    mt_free(context, splitting->face_run);
    mt_free(context, splitting->corner_done);
    mt_free(context, splitting->vertex_seen);
}

/* The sources outlive the splitting, cut to their length. */
static mt_status hand_over_sources(mt_context *context, fan_splitting *splitting, mt_index **vertex_sources)
{
    mt_index *sources =
        mt_reallocate(context, splitting->sources, splitting->mesh.vertex_count * (uint64_t)sizeof *sources);
    if (!sources) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    *vertex_sources = sources;
    splitting->sources = NULL;
    return MT_OK;
}

static mt_status split(mt_context *context, const mt_mesh *mesh, fan_splitting *splitting, uint8_t *misoriented,
                       mt_mesh **out, mt_index **vertex_sources)
{
    prepare(mesh, splitting);
    mt_status status = split_to_fixpoint(context, splitting, misoriented);
    if (status == MT_OK) {
        status = derive(context, mesh, splitting, out);
    }
    if (status == MT_OK && vertex_sources) {
        status = hand_over_sources(context, splitting, vertex_sources);
        if (status != MT_OK) {
            mt_mesh_destroy(context, *out);
            *out = NULL;
        }
    }
    return status;
}

mt_status mt_split_non_manifold(mt_context *context, const mt_mesh *mesh, mt_mesh **out, mt_index **vertex_sources)
{
    *out = NULL;
    if (vertex_sources) {
        *vertex_sources = NULL;
    }
    if ((uint64_t)mesh->vertex_count + mesh->corner_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE,
                       "%u vertices and %u corners may make more vertices than an index can number", mesh->vertex_count,
                       mesh->corner_count);
    }
    int part = mt_part_begin(context, "split vertices", "what no connectivity structure can hold");
    fan_splitting splitting = {0};
    uint8_t *misoriented = NULL;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (allocate_splitting(context, mesh, &splitting, &misoriented)) {
        status = split(context, mesh, &splitting, misoriented, out, vertex_sources);
    }
    release_splitting(context, &splitting);
    mt_part_end(context, part);
    return status;
}
