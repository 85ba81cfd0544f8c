/* How many bits Draco and glTF keep of a coordinate. Vertices keep their order, so that what a reader gets is held
 * against what was written, vertex by vertex; of glTF also what its integers say without the reader. */
#include "tradeoff/glb_oracle.h"
#include "tradeoff/reference_surface.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/mesh_format.h>
#include <meshtool/predicates.h>
#include <meshtool/triangulate.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

static const char *const levels[] = {"Draco 8 bits",
                                     "Draco 10 bits",
                                     "Draco 11 bits",
                                     "Draco 12 bits",
                                     "Draco 14 bits",
                                     "Draco 16 bits",
                                     "Draco 20 bits",
                                     "glTF 8 bits",
                                     "glTF 12 bits",
                                     "glTF 16 bits",
                                     NULL};
static const struct {
    bool is_draco; /* else KHR_mesh_quantization */
    unsigned bits;
} ways[] = {{true, 8},  {true, 10}, {true, 11}, {true, 12},  {true, 14},
            {true, 16}, {true, 20}, {false, 8}, {false, 12}, {false, 16}};

typedef struct quantization_state {
    mt_mesh *triangles;
    double diagonal;
    double extent; /* the largest side */
    double reach;  /* the largest coordinate, without its sign */
    void *bytes;
    size_t size;
} quantization_state;

static const char *reason_against(const mt_mesh *mesh, double reach)
{
    return mesh->face_count == 0                       ? "the mesh has no faces"
           : mt_mesh_bounds(mesh).non_finite_count > 0 ? "some vertices are not finite"
           : reach > (double)FLT_MAX                   ? "its coordinates are not within single precision"
                                                       : NULL;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    mt_bounds bounds = mt_mesh_bounds(subject->mesh);
    *why = reason_against(subject->mesh, subject->reach);
    if (*why) {
        return MT_OK;
    }
    quantization_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->diagonal = subject->diagonal;
    s->extent = mt_vec3_max_abs(mt_vec3_subtract(bounds.maximum, bounds.minimum));
    s->reach = subject->reach;
    mt_mesh *bare = NULL; /* seams would have Draco part their vertices */
    mt_status status = tradeoff_bare_mesh(context, subject->mesh, subject->mesh->position_type, &bare);
    if (status == MT_OK) {
        status = mt_mesh_triangulate(context, bare, &s->triangles);
    }
    mt_mesh_destroy(context, bare);
    return status;
}

static void release(void *state, mt_context *context)
{
    quantization_state *s = state;
    mt_mesh_destroy(context, s->triangles);
    mt_free(context, s);
}

/* What this program, or a file of the kind, does not hold. */
static const char *refuse(const void *state, size_t level)
{
    const quantization_state *s = state;
    const mt_mesh_format *draco = mt_mesh_format_by_extension("drc");
    if (ways[level].is_draco) {
        return draco && draco->write && draco->read ? NULL : "this meshtool was built without Draco";
    }
    bool has_steps = s->extent <= (double)FLT_MAX && s->extent / ((1u << ways[level].bits) - 1) >= (double)FLT_MIN;
    return has_steps || s->extent == 0 ? NULL : "its steps are not within single precision";
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    quantization_state *s = state;
    mt_mesh_write_options options = {.format = "glb", .quantize_bits = ways[level].bits};
    if (ways[level].is_draco) {
        options = (mt_mesh_write_options){.format = "drc"};
        options.draco = (mt_draco_options){.compress = true, .position_bits = ways[level].bits, .sequential = true};
    }
    return mt_mesh_write_memory(context, s->triangles, &options, &s->bytes, &s->size);
}

static void discard(void *state, mt_context *context)
{
    quantization_state *s = state;
    mt_free(context, s->bytes);
    s->bytes = NULL;
}

static void corners_of(const mt_mesh *mesh, mt_index face, mt_vec3 p[3])
{
    for (mt_index i = 0; i < 3; i++) {
        p[i] = mt_mesh_position(mesh, mesh->corner_vertices[3 * (size_t)face + i]);
    }
}

static mt_vec3 normal_of(const mt_vec3 p[3])
{
    return mt_vec3_cross(mt_vec3_subtract(p[1], p[0]), mt_vec3_subtract(p[2], p[0]));
}

/* Faces that turned around, and those whose area is gone. */
static void count_spoilt(const mt_mesh *before, const mt_mesh *after, mt_index *flipped, mt_index *collapsed)
{
    *flipped = *collapsed = 0;
    for (mt_index face = 0; face < before->face_count; face++) {
        mt_vec3 p[3], q[3];
        corners_of(before, face, p);
        corners_of(after, face, q);
        bool had_area = !mt_collinear(p[0], p[1], p[2]), has_area = !mt_collinear(q[0], q[1], q[2]);
        *collapsed += had_area && !has_area;
        *flipped += has_area && mt_vec3_dot(normal_of(p), normal_of(q)) < 0;
    }
}

/* Half a step on each axis, and what is rounded: by Draco, which computes in single precision; of glTF in double. */
static double bound_of(const quantization_state *s, size_t level)
{
    double epsilon = ways[level].is_draco ? (double)FLT_EPSILON : DBL_EPSILON;
    double rounded = 2 * epsilon * (s->reach + s->diagonal) + (ways[level].is_draco ? (double)FLT_TRUE_MIN : 0);
    return sqrt(3) * (0.5 * s->extent / ((1u << ways[level].bits) - 1) + rounded) / s->diagonal;
}

/* What is not finite is as far as can be. */
static double distance_between(mt_vec3 right, mt_vec3 found)
{
    return mt_vec3_is_finite(found) ? mt_vec3_length(mt_vec3_subtract(right, found)) : (double)INFINITY;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    const quantization_state *s = state;
    mt_mesh *back = NULL;
    const char *name = ways[level].is_draco ? "quantised.drc" : "quantised.glb";
    mt_status status = mt_mesh_read_memory(context, name, s->bytes, s->size, NULL, &back, NULL);
    if (status != MT_OK) {
        return status;
    }
    bool is_same = back->vertex_count == s->triangles->vertex_count && back->face_count == s->triangles->face_count;
    double largest = 0, squares = 0, *integers = NULL;
    if (is_same && !ways[level].is_draco) {
        integers = mt_allocate_array(context, 3 * (uint64_t)back->vertex_count, sizeof *integers);
        if (!integers) {
            mt_mesh_destroy(context, back);
            return MT_ERROR_OUT_OF_MEMORY;
        }
        is_same = glb_oracle_positions(s->bytes, s->size, back->vertex_count, integers);
    }
    for (mt_index vertex = 0; is_same && vertex < back->vertex_count; vertex++) {
        mt_vec3 right = mt_mesh_position(s->triangles, vertex);
        double distance = distance_between(right, mt_mesh_position(back, vertex)) / s->diagonal;
        if (integers) {
            const double *p = integers + 3 * (size_t)vertex;
            distance = fmax(distance, distance_between(right, mt_vec3_make(p[0], p[1], p[2])) / s->diagonal);
        }
        largest = fmax(largest, distance);
        squares += distance * distance;
    }
    mt_free(context, integers);
    mt_index flipped = 0, collapsed = 0;
    if (is_same) {
        count_spoilt(s->triangles, back, &flipped, &collapsed);
    }
    tradeoff_add_size(row, "bytes", (double)s->size);
    tradeoff_add_error(row, "moved_max", largest);
    tradeoff_add_error(row, "moved_rms", sqrt(squares / back->vertex_count));
    tradeoff_add_error(row, "flipped_faces", flipped);
    tradeoff_add_error(row, "collapsed_faces", collapsed);
    row->is_defect = !is_same || largest > bound_of(s, level);
    snprintf(row->says, sizeof row->says,
             "%.3g bytes a triangle; vertices move by up to %.2g of the diagonal; %u faces turn over, %u collapse",
             (double)s->size / s->triangles->face_count, largest, (unsigned)flipped, (unsigned)collapsed);
    mt_mesh_destroy(context, back);
    return MT_OK;
}

const tradeoff_knob tradeoff_quantization = {
    .name = "quantization",
    .question = "How many bits of a coordinate do Draco and glTF keep?",
    .oracle = "what libdraco reads back, and glTF's integers by themselves, vertex by vertex",
    .axis = "moved_max",
    .levels = levels,
    .prepare = prepare,
    .refuse = refuse,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
