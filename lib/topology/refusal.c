/* Each refusal names the first offender in the order of the mesh and what can mend it. What it takes to word a message
 * is spent only on failure. Cost: O(corners). */
#include "lib/topology/refusal.h"

#include <meshtool/components.h>
#include <meshtool/degenerate_faces.h>
#include <meshtool/vertex_fans.h>

#include <stdio.h>
#include <string.h>

#define FACES_NAMED 6
#define FACE_TEXT (FACES_NAMED * 12 + 8)

static mt_index next_corner(const mt_mesh *mesh, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    return corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
}

static mt_index repeated_vertex(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    for (mt_index i = begin; i < end; i++) {
        for (mt_index j = begin; j < i; j++) {
            if (mesh->corner_vertices[i] == mesh->corner_vertices[j]) {
                return mesh->corner_vertices[i];
            }
        }
    }
    return MT_NONE;
}

static bool is_triangles(const mt_mesh *mesh)
{
    return !mesh->face_offsets && mesh->face_size == 3;
}

static mt_status find_degenerate_face(mt_context *context, const mt_mesh *mesh, mt_index *face)
{
    *face = MT_NONE;
    uint8_t *flags = mt_allocate(context, mesh->face_count);
    mt_index count = 0;
    mt_status status = flags ? mt_find_degenerate_faces(context, mesh, flags, &count) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK && count) {
        const uint8_t *first = memchr(flags, 1, mesh->face_count);
        *face = (mt_index)(first - flags);
    }
    mt_free(context, flags);
    return status;
}

mt_status mt_polygons_are_simple(mt_context *context, const mt_mesh *mesh, bool *simple)
{
    mt_index face = MT_NONE;
    mt_status status = is_triangles(mesh) ? MT_OK : find_degenerate_face(context, mesh, &face);
    *simple = face == MT_NONE;
    return status;
}

static mt_status refuse_degenerate_face(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    if (is_triangles(mesh) && pairs->degenerate_side_count == 0) {
        return MT_OK;
    }
    mt_index face = MT_NONE;
    mt_status status = find_degenerate_face(context, mesh, &face);
    if (status != MT_OK || face == MT_NONE) {
        return status;
    }
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD,
                   "face %u names vertex %u more than once, which no connectivity structure can hold; "
                   "`meshtool repair --drop-degenerate` drops such faces",
                   face, repeated_vertex(mesh, face));
}

static mt_index first_corner_of_class(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_edge_class edge_class)
{
    mt_index corner = 0;
    while (mt_edge_class_of(mesh, pairs, corner) != edge_class) {
        corner++;
    }
    return corner;
}

/* "4, 9, 13", cut short where there are many; returns how many sides the edge has. */
static mt_index list_faces(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first, char text[FACE_TEXT])
{
    mt_index faces[FACES_NAMED];
    mt_index count = mt_edge_faces(mesh, pairs, first, FACES_NAMED, faces);
    int length = 0;
    for (mt_index i = 0; i < count && i < FACES_NAMED; i++) {
        length += snprintf(text + length, (size_t)(FACE_TEXT - length), "%s%u", i ? ", " : "", faces[i]);
    }
    if (count > FACES_NAMED) {
        snprintf(text + length, (size_t)(FACE_TEXT - length), ", ...");
    }
    return count;
}

static mt_status refuse_non_manifold_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    char faces[FACE_TEXT];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_NON_MANIFOLD);
    mt_index count = list_faces(mesh, pairs, corner, faces);
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD,
                   "edge %u-%u is shared by %u faces (%s), connectivity structures hold at most two; "
                   "`meshtool repair --split` separates them",
                   mesh->corner_vertices[corner], mesh->corner_vertices[next_corner(mesh, corner)], count, faces);
}

static mt_status refuse_misoriented_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    mt_components *components = NULL;
    mt_status status = mt_components_create(context, mesh, pairs, false, &components);
    if (status != MT_OK) {
        return status;
    }
    bool orientable = components->orientable;
    mt_components_destroy(context, components);
    char faces[FACE_TEXT];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_MISORIENTED);
    list_faces(mesh, pairs, corner, faces);
    const char *cure = orientable ? "`meshtool repair --orient` turns faces until all agree"
                                  : "no turning of faces can mend it, the surface has only one side";
    return mt_fail(context, MT_ERROR_NOT_ORIENTED, "faces %s run along edge %u-%u in the same direction; %s", faces,
                   mesh->corner_vertices[corner], mesh->corner_vertices[next_corner(mesh, corner)], cure);
}

mt_status mt_refuse_sides(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    mt_status status = refuse_degenerate_face(context, mesh, pairs);
    if (status != MT_OK) {
        return status;
    }
    if (pairs->non_manifold_count) {
        return refuse_non_manifold_edge(context, mesh, pairs);
    }
    return pairs->misoriented_count ? refuse_misoriented_edge(context, mesh, pairs) : MT_OK;
}

static mt_index first_face_of_vertex(const mt_mesh *mesh, mt_index vertex)
{
    mt_index corner = 0;
    while (mesh->corner_vertices[corner] != vertex) {
        corner++;
    }
    return mt_mesh_corner_face(mesh, corner);
}

mt_status mt_refuse_vertex(mt_context *context, const mt_mesh *mesh)
{
    mt_edge_pairs *pairs = NULL;
    mt_vertex_fans *fans = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status == MT_OK) {
        status = mt_vertex_fans_create(context, mesh, pairs, NULL, &fans);
    }
    if (status == MT_OK) {
        const uint8_t *first = memchr(fans->fans, MT_FANS_SEVERAL, mesh->vertex_count);
        mt_index vertex = (mt_index)(first - fans->fans);
        status = mt_fail(
            context, MT_ERROR_NOT_MANIFOLD,
            "several fans of faces meet in vertex %u alone (one holds face %u), connectivity structures hold one; "
            "`meshtool repair --split` separates them",
            vertex, first_face_of_vertex(mesh, vertex));
    }
    mt_vertex_fans_destroy(context, fans);
    mt_edge_pairs_destroy(context, pairs);
    return status;
}
