/* The table of primitives, and what their families share. */
#include "lib/mesh/generate.h"

#include <meshtool/elementary.h>

#include <string.h>

/* The largest resolutions are those whose corners still have a number: 32767 x 32767 quads, 46340 x 23170 quads ... */
static const mt_primitive primitives[] = {
    {"tetrahedron", "4 triangles", NULL, 0, 0, 0, mt_generate_tetrahedron},
    {"cube", "6 quads", NULL, 0, 0, 0, mt_generate_cube},
    {"octahedron", "8 triangles", NULL, 0, 0, 0, mt_generate_octahedron},
    {"icosahedron", "20 triangles", NULL, 0, 0, 0, mt_generate_icosahedron},
    {"dodecahedron", "12 pentagons", NULL, 0, 0, 0, mt_generate_dodecahedron},
    {"icosphere", "a sphere of triangles of nearly one size", "level; each makes four triangles of one", 3, 1, 13,
     mt_generate_icosphere},
    {"uv-sphere", "a sphere of quads along meridians, triangles at the poles",
     "segments around; half as many from pole to pole", 32, 3, 46340, mt_generate_uv_sphere},
    {"grid", "a flat square of quads", "quads along a side", 10, 1, 32767, mt_generate_grid},
    {"cylinder", "a closed cylinder, its caps fans of triangles", "segments around", 32, 3, 400000000,
     mt_generate_cylinder},
    {"cone", "a closed cone, its base one polygon", "segments around", 32, 3, 800000000, mt_generate_cone},
    {"prism", "a closed prism, its caps one polygon each", "sides of the caps", 6, 3, 700000000, mt_generate_prism},
    {"torus", "a closed ring of quads, genus 1", "segments around the hole; half as many around the tube", 32, 6, 46340,
     mt_generate_torus},
    {"double-torus", "two rings joined by a neck, closed, genus 2", "segments around each hole", 24, 12, 32000,
     mt_generate_double_torus},
    {"moebius", "a strip with half a twist: one side, one boundary", "segments around", 48, 6, 65000,
     mt_generate_moebius},
    {"klein", "the Klein bottle: closed, one side, so no orientation fits",
     "segments along the bottle; half as many around", 48, 6, 46340, mt_generate_klein},
    {"teapot", "Newell's teapot of 32 Bezier patches; body, lid, handle and spout are open", "segments along a patch",
     8, 2, 5700, mt_generate_teapot},
    {"book", "pages that share one edge: not manifold", "pages", 3, 3, 500000000, mt_generate_book},
    {"bowtie", "two triangles that share one vertex: not manifold", NULL, 0, 0, 0, mt_generate_bowtie},
    {"book-bowtie", "a book of three pages and a triangle that touches it at a vertex: not manifold", NULL, 0, 0, 0,
     mt_generate_book_bowtie},
};

const mt_primitive *mt_primitives(size_t *count)
{
    *count = sizeof primitives / sizeof *primitives;
    return primitives;
}

static const mt_primitive *find_primitive(const char *name)
{
    for (size_t i = 0; i < sizeof primitives / sizeof *primitives; i++) {
        if (strcmp(primitives[i].name, name) == 0) {
            return &primitives[i];
        }
    }
    return NULL;
}

static mt_status fail_unknown(mt_context *context, const char *name)
{
    char known[512] = "";
    for (size_t i = 0; i < sizeof primitives / sizeof *primitives; i++) {
        strcat(known, i ? ", " : "");
        strcat(known, primitives[i].name);
        if (strlen(known) > sizeof known - 64) {
            strcat(known, " ...");
            break;
        }
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "no primitive is called '%s'; known are %s", name, known);
}

static mt_status check_options(mt_context *context, const mt_primitive *primitive, const mt_generate_options *options)
{
    mt_index resolution = options->resolution;
    if (options->has_magnitude) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a %s has no magnitude; extremes have one", primitive->name);
    }
    if (resolution && !primitive->resolution) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a %s has no resolution to choose, but %u was given",
                       primitive->name, resolution);
    }
    if (resolution && (resolution < primitive->minimum || resolution > primitive->maximum)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the resolution of a %s (%s) must lie from %u to %u, not %u",
                       primitive->name, primitive->resolution_meaning, primitive->minimum, primitive->maximum,
                       resolution);
    }
    return MT_OK;
}

/* A mirrored zero is written as -0, which reads badly in text and helps nobody. */
static void clear_signs_of_zeros(mt_mesh *mesh)
{
    double *positions = mesh->positions;
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        positions[i] += 0.0;
    }
}

static mt_status generate_primitive(mt_context *context, const char *name, const mt_generate_options *options,
                                    mt_mesh **out)
{
    const mt_primitive *primitive = find_primitive(name);
    if (!primitive) {
        return fail_unknown(context, name);
    }
    mt_status status = check_options(context, primitive, options);
    if (status != MT_OK) {
        return status;
    }
    return primitive->generate(context, options->resolution ? options->resolution : primitive->resolution, out);
}

mt_status mt_generate(mt_context *context, const char *name, const mt_generate_options *options, mt_mesh **out)
{
    static const mt_generate_options defaults = {0};
    options = options ? options : &defaults;
    *out = NULL;
    if (options->position_type != 0 && options->position_type != MT_F32 && options->position_type != MT_F64) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "positions are stored as 32-bit or 64-bit floats only");
    }
    mt_status status = strncmp(name, "extreme:", 8) == 0 ? mt_generate_extreme(context, name + 8, options, out)
                                                         : generate_primitive(context, name, options, out);
    if (status == MT_OK) {
        clear_signs_of_zeros(*out);
    }
    if (status == MT_OK && options->position_type == MT_F32) {
        status = mt_mesh_set_position_type(context, *out, MT_F32, NULL);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}

/* ---- shared by the families ---- */

void mt_generate_face(mt_mesh *mesh, mt_index face, const mt_index *vertices, mt_index sides)
{
    mt_index begin = mesh->face_offsets[face];
    memcpy(mesh->corner_vertices + begin, vertices, sides * sizeof *vertices);
    mesh->face_offsets[face + 1] = begin + sides;
}

mt_status mt_generate_literal(mt_context *context, const mt_literal *literal, mt_mesh **out)
{
    mt_mesh_layout layout = {
        .vertex_count = literal->vertex_count, .face_count = literal->face_count, .position_type = MT_F64};
    const uint8_t *face = literal->faces;
    for (mt_index i = 0; i < literal->face_count; i++) {
        layout.corner_count += face[0];
        face += face[0] + 1;
    }
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    memcpy(mesh->positions, literal->positions, 3 * (size_t)literal->vertex_count * sizeof(double));
    face = literal->faces;
    for (mt_index i = 0; i < literal->face_count; i++) {
        mt_index begin = mesh->face_offsets[i];
        for (mt_index k = 0; k < face[0]; k++) {
            mesh->corner_vertices[begin + k] = face[1 + k];
        }
        mesh->face_offsets[i + 1] = begin + face[0];
        face += face[0] + 1;
    }
    mt_mesh_compact_faces(context, mesh);
    return MT_OK;
}

mt_circle_point mt_circle(uint64_t i, uint64_t n)
{
    uint64_t eighths = 8 * (i % n), octant = eighths / n, rest = eighths % n;
    uint64_t numerator = octant % 2 ? n - rest : rest; /* of the angle within the first octant, over 8n turns */
    double angle = MT_PI / 4 * ((double)numerator / (double)n);
    double c = mt_cos(angle), s = mt_sin(angle);
    if (numerator == n) {
        c = s = 0.70710678118654752440;
    }
    bool swaps = octant == 1 || octant == 2 || octant == 5 || octant == 6;
    double x = swaps ? s : c, y = swaps ? c : s;
    mt_circle_point point = {octant >= 2 && octant < 6 ? -x : x, octant >= 4 ? -y : y};
    return point;
}
