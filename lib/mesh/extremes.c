/* The table of extremes, and those that are a plain shape moved, scaled or spoilt. */
#include "lib/mesh/generate.h"

#include <stdio.h>
#include <string.h>

typedef mt_vec3 (*mover)(mt_vec3 p, double magnitude);

static mt_status move_torus(mt_context *context, double magnitude, mover move, mt_mesh **out)
{
    mt_status status = mt_generate_torus(context, 32, out);
    for (mt_index vertex = 0; status == MT_OK && vertex < (*out)->vertex_count; vertex++) {
        mt_mesh_set_position(*out, vertex, move(mt_mesh_position(*out, vertex), magnitude));
    }
    return status;
}

static mt_vec3 move_far(mt_vec3 p, double magnitude)
{
    return mt_vec3_make(p.x + magnitude, p.y + magnitude, p.z + magnitude);
}

static mt_status offset(mt_context *context, double magnitude, mt_mesh **out)
{
    return move_torus(context, magnitude, move_far, out);
}

static mt_status scale(mt_context *context, double magnitude, mt_mesh **out)
{
    return move_torus(context, magnitude, mt_vec3_scale, out);
}

static mt_vec3 tilt(mt_vec3 p, double magnitude)
{
    return mt_vec3_make(p.x, p.y + p.x / magnitude, p.z);
}

/* A square that rises by 1 / magnitude along x: rays along x graze it. */
static mt_status grazing(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_status status = mt_generate_grid(context, 16, out);
    for (mt_index vertex = 0; status == MT_OK && vertex < (*out)->vertex_count; vertex++) {
        mt_mesh_set_position(*out, vertex, tilt(mt_mesh_position(*out, vertex), magnitude));
    }
    return status;
}

static mt_status non_finite(mt_context *context, double magnitude, mt_mesh **out)
{
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    mt_status status = mt_generate_icosphere(context, 3, out);
    for (mt_index i = 0; status == MT_OK && i < (*out)->vertex_count && i < magnitude; i++) {
        ((double *)(*out)->positions)[3 * (size_t)i + i % 3] = bad[i % 3];
    }
    return status;
}

static mt_status empty(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = (uint64_t)magnitude, .face_size = 3, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    for (mt_index i = 0; status == MT_OK && i < (*out)->vertex_count; i++) {
        mt_mesh_set_position(*out, i, mt_vec3_make(i, i % 7, i % 11));
    }
    return status;
}

static mt_status winding(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_status status = mt_generate_icosphere(context, 3, out);
    mt_index step = (mt_index)magnitude;
    for (mt_index face = 0; status == MT_OK && face < (*out)->face_count; face += step) {
        mt_index *corners = (*out)->corner_vertices + 3 * (size_t)face, first = corners[0];
        corners[0] = corners[1];
        corners[1] = first;
    }
    return status;
}

static mt_status crease(mt_context *context, double magnitude, mt_mesh **out)
{
    return mt_generate_prism(context, (mt_index)magnitude, out);
}

static mt_vec3 warp(mt_vec3 p, double magnitude)
{
    return mt_vec3_make(p.x, p.y + magnitude * (p.x * p.x - p.z * p.z), p.z);
}

/* Quads whose corners lie in no plane. */
static mt_status warped(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_status status = mt_generate_grid(context, 8, out);
    for (mt_index vertex = 0; status == MT_OK && vertex < (*out)->vertex_count; vertex++) {
        mt_mesh_set_position(*out, vertex, warp(mt_mesh_position(*out, vertex), magnitude));
    }
    return status;
}

static const mt_extreme extremes[] = {
    {"offset", "a torus of size 3 far from the origin", "distance along each axis", 1e7, 0, 1e300, false, offset},
    {"scale", "a torus made small or large", "factor", 1e-150, 1e-320, 1e307, false, scale},
    {"sliver", "a closed needle", "length over width", 1e6, 1, 1e300, false, mt_extreme_sliver},
    {"grazing", "a square that rays along x barely meet", "run over rise", 1e4, 1e-3, 1e300, false, grazing},
    {"flat", "a closed box with no thickness, or little", "thickness", 0, 0, 1, false, mt_extreme_flat},
    {"nearly-flat", "a tetrahedron with a corner close to the plane of the others", "height", 1e-15, 0, 1, false,
     mt_extreme_nearly_flat},
    {"walls", "two squares close together", "distance", 4e-5, 0, 1, false, mt_extreme_walls},
    {"stadium", "a teapot in a stadium", "ratio of their sizes", 1e6, 1, 1e150, false, mt_extreme_stadium},
    {"valence", "a cone of triangles around one vertex", "triangles", 1e4, 3, 1e8, true, mt_extreme_valence},
    {"pole", "two poles, each where many quads meet", "quads around each", 50, 3, 1e7, true, mt_extreme_pole},
    {"polygon", "a comb: one concave face", "sides", 1000, 8, 1e8, true, mt_extreme_polygon},
    {"warped", "quads that are not planar", "height of the saddle", 0.5, 0, 1e150, false, warped},
    {"duplicates", "one triangle again and again, with vertices of its own", "copies", 1000, 1, 1e8, true,
     mt_extreme_duplicates},
    {"centroids", "triangles of all sizes around one point", "triangles", 1000, 1, 1e8, true, mt_extreme_centroids},
    {"specks", "squares far smaller than what lies between them", "side, their distance being 1", 1e-4, 0, 1, false,
     mt_extreme_specks},
    {"winding", "a sphere with faces turned over", "one face in so many", 2, 1, 1e9, true, winding},
    {"crease", "a prism whose sides meet at 360 degrees over their number", "sides", 8, 3, 7e8, true, crease},
    {"non-finite", "a sphere with vertices that are nan or infinite", "such vertices", 1, 0, 642, true, non_finite},
    {"empty", "vertices alone, or nothing", "vertices", 0, 0, 1e9, true, empty},
};

const mt_extreme *mt_extremes(size_t *count)
{
    *count = sizeof extremes / sizeof *extremes;
    return extremes;
}

static const mt_extreme *find_extreme(const char *name)
{
    for (size_t i = 0; i < sizeof extremes / sizeof *extremes; i++) {
        if (strcmp(extremes[i].name, name) == 0) {
            return &extremes[i];
        }
    }
    return NULL;
}

static mt_status fail_unknown(mt_context *context, const char *name)
{
    char known[512] = "";
    for (size_t i = 0; i < sizeof extremes / sizeof *extremes; i++) {
        size_t length = strlen(known);
        snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", extremes[i].name);
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "no extreme is called 'extreme:%s'; known are %s", name, known);
}

mt_status mt_generate_extreme(mt_context *context, const char *name, const mt_generate_options *options, mt_mesh **out)
{
    const mt_extreme *extreme = find_extreme(name);
    if (!extreme) {
        return fail_unknown(context, name);
    }
    if (options->resolution) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "an extreme has no resolution, but a magnitude: %s",
                       extreme->meaning);
    }
    double magnitude = options->has_magnitude ? options->magnitude : extreme->magnitude;
    bool fits = magnitude >= extreme->minimum && magnitude <= extreme->maximum;
    if (!fits || (extreme->is_whole && magnitude != (double)(uint64_t)magnitude)) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "the magnitude of extreme:%s (%s) must be a %snumber from %g to %g, not %g", extreme->name,
                       extreme->meaning, extreme->is_whole ? "whole " : "", extreme->minimum, extreme->maximum,
                       magnitude);
    }
    return extreme->generate(context, magnitude, out);
}
