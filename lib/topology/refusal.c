/* Each refusal names the first offender in the order of the mesh and what can mend it. What it takes to word a message
 * is spent only on failure. Cost: O(corners). */
#include <meshtool/components.h>
#include <meshtool/degenerate_faces.h>
#include <meshtool/refusal.h>
#include <meshtool/vertex_fans.h>

#include <stdio.h>
#include <string.h>

#define FACES_NAMED 6
#define FACE_TEXT (FACES_NAMED * 12 + 8)

/* The ends of a corner's side, the lower number first. */
static void side_ends(const mt_mesh *mesh, mt_index corner, mt_index ends[2])
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    mt_index next = corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
    mt_index a = mesh->corner_vertices[corner], b = mesh->corner_vertices[next];
    ends[0] = a < b ? a : b;
    ends[1] = a < b ? b : a;
}

/* The first vertex that the face, which is known to do so, names again. */
static mt_status find_repeated_vertex(mt_context *context, const mt_mesh *mesh, mt_index face, mt_index *vertex)
{
    uint8_t *seen = mt_allocate_zeroed(context, mesh->vertex_count);
    if (!seen) {
        return mt_context_error(context)->status;
    }
    mt_index corner = mt_mesh_face_begin(mesh, face);
    while (!seen[mesh->corner_vertices[corner]]) {
        seen[mesh->corner_vertices[corner++]] = 1;
    }
    *vertex = mesh->corner_vertices[corner];
    mt_free(context, seen);
    return MT_OK;
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

static mt_status refuse_degenerate_face(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                        const char *who_needs)
{
    if (is_triangles(mesh) && pairs->degenerate_side_count == 0) {
        return MT_OK;
    }
    mt_index face = MT_NONE, vertex = MT_NONE;
    mt_status status = find_degenerate_face(context, mesh, &face);
    if (status == MT_OK && face != MT_NONE) {
        status = find_repeated_vertex(context, mesh, face, &vertex);
    }
    if (status != MT_OK || face == MT_NONE) {
        return status;
    }
    return mt_fail(
        context, MT_ERROR_NOT_MANIFOLD,
        "face %u names vertex %u more than once; %s a manifold mesh: `meshtool repair --drop-degenerate` can "
        "drop such faces",
        face, vertex, who_needs);
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

/* Whether two faces, which name no vertex twice, have the same vertices in the same or in the opposite order. */
static bool are_duplicates(const mt_mesh *mesh, mt_index a, mt_index b)
{
    mt_index sides = mt_mesh_face_sides(mesh, a);
    const mt_index *from = mesh->corner_vertices + mt_mesh_face_begin(mesh, a);
    const mt_index *to = mesh->corner_vertices + mt_mesh_face_begin(mesh, b);
    mt_index start = 0;
    if (mt_mesh_face_sides(mesh, b) != sides) {
        return false;
    }
    while (start < sides && to[start] != from[0]) {
        start++;
    }
    if (start == sides) {
        return false;
    }
    bool forward = true, backward = true;
    for (uint64_t i = 0; i < sides; i++) {
        forward = forward && from[i] == to[(start + i) % sides];
        backward = backward && from[i] == to[(start + sides - i) % sides];
    }
    return forward || backward;
}

/* Whether the first face on the edge has a double among the others. */
static bool edge_has_duplicates(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first)
{
    mt_index face = mt_mesh_corner_face(mesh, first);
    mt_index corner = pairs->next_side[first];
    while (corner != first && !are_duplicates(mesh, face, mt_mesh_corner_face(mesh, corner))) {
        corner = pairs->next_side[corner];
    }
    return corner != first;
}

static mt_status refuse_non_manifold_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                          const char *who_needs)
{
    char faces[FACE_TEXT];
    mt_index ends[2];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_NON_MANIFOLD);
    mt_index count = list_faces(mesh, pairs, corner, faces);
    side_ends(mesh, corner, ends);
    const char *cure = edge_has_duplicates(mesh, pairs, corner)
                           ? "some of them are the same face, and `meshtool repair --drop-duplicates` can drop those"
                           : "`meshtool repair --split` can separate them";
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD, "edge %u-%u is shared by %u faces (%s); %s a manifold mesh: %s",
                   ends[0], ends[1], count, faces, who_needs, cure);
}

static mt_status refuse_misoriented_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                         const char *who_needs)
{
    mt_components *components = NULL;
    mt_status status = mt_components_create(context, mesh, pairs, false, &components);
    if (status != MT_OK) {
        return status;
    }
    bool orientable = components->orientable;
    mt_components_destroy(context, components);
    char faces[FACE_TEXT];
    mt_index ends[2];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_MISORIENTED);
    list_faces(mesh, pairs, corner, faces);
    side_ends(mesh, corner, ends);
    const char *cure = orientable ? "`meshtool repair --orient` can turn faces until all agree"
                                  : "`meshtool repair --orient` cannot help, the surface has only one side";
    return mt_fail(context, MT_ERROR_NOT_ORIENTED,
                   "faces %s run along edge %u-%u in the same direction; %s faces that agree: %s", faces, ends[0],
                   ends[1], who_needs, cure);
}

mt_status mt_refuse_sides(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, const char *who_needs)
{
    mt_status status = refuse_degenerate_face(context, mesh, pairs, who_needs);
    if (status != MT_OK) {
        return status;
    }
    if (pairs->non_manifold_count) {
        return refuse_non_manifold_edge(context, mesh, pairs, who_needs);
    }
    return pairs->misoriented_count ? refuse_misoriented_edge(context, mesh, pairs, who_needs) : MT_OK;
}

static mt_index first_face_of_vertex(const mt_mesh *mesh, mt_index vertex)
{
    mt_index corner = 0;
    while (mesh->corner_vertices[corner] != vertex) {
        corner++;
    }
    return mt_mesh_corner_face(mesh, corner);
}

mt_status mt_refuse_vertex(mt_context *context, const mt_mesh *mesh, const char *who_needs)
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
        status = mt_fail(context, MT_ERROR_NOT_MANIFOLD,
                         "several fans of faces meet in vertex %u alone (one holds face %u); %s a manifold mesh: "
                         "`meshtool repair --split` can separate them",
                         vertex, first_face_of_vertex(mesh, vertex), who_needs);
    }
    mt_vertex_fans_destroy(context, fans);
    mt_edge_pairs_destroy(context, pairs);
    return status;
}
