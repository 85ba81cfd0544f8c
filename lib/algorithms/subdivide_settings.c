#include "lib/algorithms/subdivide_settings.h"

#include "lib/algorithms/subdivide_rule.h"

/* By the value of each tag, what the options call it. */
static const uint8_t boundaries[] = {MT_SUBDIVIDE_BOUNDARY_NONE, MT_SUBDIVIDE_BOUNDARY_CORNERS,
                                     MT_SUBDIVIDE_BOUNDARY_SMOOTH};
static const uint8_t face_varyings[] = {
    MT_SUBDIVIDE_FACE_VARYING_NONE,          MT_SUBDIVIDE_FACE_VARYING_CORNERS_ONLY,
    MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1, MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS2,
    MT_SUBDIVIDE_FACE_VARYING_BOUNDARIES,    MT_SUBDIVIDE_FACE_VARYING_ALL};
static const uint8_t crease_methods[] = {MT_SUBDIVIDE_CREASES_NORMAL, MT_SUBDIVIDE_CREASES_CHAIKIN};
static const uint8_t triangles[] = {MT_SUBDIVIDE_TRIANGLES_NORMAL, MT_SUBDIVIDE_TRIANGLES_SMOOTH};

/* The option given, else the tag's, else the first, which is 1 in each. */
static unsigned settle(unsigned given, const mt_mesh *mesh, mt_subdivision_tag tag, const uint8_t *of_tag)
{
    unsigned value = 0;
    if (given) {
        return given;
    }
    return mt_subdivision_tag_get(mesh, tag, &value) ? of_tag[value] : 1;
}

static mt_status check_lists(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *settings)
{
    mt_index highest_vertex = 0, highest_face = 0;
    for (mt_index i = 0; i < settings->crease_count; i++) {
        const mt_edge_value *crease = &settings->creases[i];
        mt_index higher = crease->a > crease->b ? crease->a : crease->b;
        highest_vertex = higher > highest_vertex ? higher : highest_vertex;
    }
    for (mt_index i = 0; i < settings->sharp_vertex_count; i++) {
        mt_index vertex = settings->sharp_vertices[i].vertex;
        highest_vertex = vertex > highest_vertex ? vertex : highest_vertex;
    }
    for (mt_index i = 0; i < settings->hole_count; i++) {
        highest_face = settings->holes[i] > highest_face ? settings->holes[i] : highest_face;
    }
    if ((settings->crease_count || settings->sharp_vertex_count) && highest_vertex >= mesh->vertex_count) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "sharpness is asked for at vertex %u, counted from 0, but the mesh has %u vertices",
                       highest_vertex, mesh->vertex_count);
    }
    if (settings->hole_count && highest_face >= mesh->face_count) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "face %u, counted from 0, is asked to be a hole, but the mesh has %u faces", highest_face,
                       mesh->face_count);
    }
    return MT_OK;
}

mt_status mt_subdivide_settle(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options,
                              mt_subdivide_options *settings)
{
    *settings = options ? *options : (mt_subdivide_options){0};
    settings->level_count += settings->level_count == 0;
    settings->boundary = (mt_subdivide_boundary)settle(settings->boundary, mesh, MT_TAG_BOUNDARY, boundaries);
    settings->face_varying =
        (mt_subdivide_face_varying)settle(settings->face_varying, mesh, MT_TAG_FACE_VARYING, face_varyings);
    settings->crease_method =
        (mt_subdivide_crease_method)settle(settings->crease_method, mesh, MT_TAG_CREASE_METHOD, crease_methods);
    settings->triangles = (mt_subdivide_triangles)settle(settings->triangles, mesh, MT_TAG_SMOOTH_TRIANGLES, triangles);
    if (settings->level_count > MT_SUBDIVIDE_LEVEL_LIMIT) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "%u levels are more than the %u that can be asked for",
                       settings->level_count, MT_SUBDIVIDE_LEVEL_LIMIT);
    }
    return check_lists(context, mesh, settings);
}

/* Vertices of a boundary edge that is not infinitely sharp by itself: 1. The sharpness of edges is looked up by marks
 * on their sides: a boundary edge has one. */
static void mark_open_vertices(const mt_mesh *mesh, const mt_edge_pairs *pairs, const uint8_t *sharp_sides,
                               uint8_t *open)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            if (pairs->next_side[corner] == corner && !sharp_sides[corner]) {
                mt_index next = corner + 1 < end ? corner + 1 : begin;
                open[mesh->corner_vertices[corner]] = 1;
                open[mesh->corner_vertices[next]] = 1;
            }
        }
    }
}

/* A boundary vertex has one boundary edge that leaves it, and by that its creases are found. */
static void mark_sharp_sides(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_index *leaving,
                             const mt_edge_value *creases, mt_index count, uint8_t *sharp_sides)
{
    for (mt_index i = 0; i < count; i++) {
        const mt_index ends[2][2] = {{creases[i].a, creases[i].b}, {creases[i].b, creases[i].a}};
        for (unsigned k = 0; k < 2; k++) {
            mt_index corner = leaving[ends[k][0]];
            if (corner == MT_NONE || pairs->next_side[corner] != corner) {
                continue;
            }
            mt_index face = mt_mesh_corner_face(mesh, corner);
            mt_index next = corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
            if (mesh->corner_vertices[next] == ends[k][1]) {
                sharp_sides[corner] = creases[i].value >= (double)MT_SHARPNESS_INFINITE;
            }
        }
    }
}

static mt_status mark_open_faces(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                 const mt_subdivide_options *settings, uint8_t *holes)
{
    uint8_t *open = mt_allocate_zeroed(context, mesh->vertex_count);
    uint8_t *sharp_sides = mt_allocate_zeroed(context, mesh->corner_count);
    mt_index *leaving = mt_allocate_array(context, mesh->vertex_count, sizeof *leaving);
    bool complete = open && sharp_sides && leaving;
    for (mt_index vertex = 0; complete && vertex < mesh->vertex_count; vertex++) {
        leaving[vertex] = MT_NONE;
    }
    for (mt_index corner = 0; complete && corner < mesh->corner_count; corner++) {
        if (pairs->next_side[corner] == corner) {
            leaving[mesh->corner_vertices[corner]] = corner;
        }
    }
    if (complete) {
        mark_sharp_sides(mesh, pairs, leaving, mesh->creases, mesh->crease_count, sharp_sides);
        mark_sharp_sides(mesh, pairs, leaving, settings->creases, settings->crease_count, sharp_sides);
        mark_open_vertices(mesh, pairs, sharp_sides, open);
    }
    for (mt_index face = 0; complete && face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            holes[face] |= open[mesh->corner_vertices[c]];
        }
    }
    mt_free(context, open);
    mt_free(context, sharp_sides);
    mt_free(context, leaving);
    return complete ? MT_OK : mt_context_error(context)->status;
}

mt_status mt_subdivide_holes(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                             const mt_subdivide_options *settings, uint8_t **holes)
{
    const mt_attribute *given = mt_mesh_find_holes(mesh);
    bool open = settings->boundary == MT_SUBDIVIDE_BOUNDARY_NONE;
    *holes = NULL;
    if (!given && !settings->hole_count && !open) {
        return MT_OK;
    }
    uint8_t *marks = mt_allocate_zeroed(context, mesh->face_count);
    if (!marks) {
        return mt_context_error(context)->status;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        marks[face] = mt_face_is_hole(given, face);
    }
    for (mt_index i = 0; i < settings->hole_count; i++) {
        marks[settings->holes[i]] = 1;
    }
    mt_status status = open ? mark_open_faces(context, mesh, pairs, settings, marks) : MT_OK;
    bool any = false;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        any = any || marks[face];
    }
    if (status != MT_OK || !any) {
        mt_free(context, marks);
        return status;
    }
    *holes = marks;
    return MT_OK;
}
