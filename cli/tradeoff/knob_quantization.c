/* How many bits Draco keeps of a coordinate. Vertices keep their order, so that what a reader gets is held against what
 * was written, vertex by vertex. */
#include "tradeoff/reference_surface.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/mesh_format.h>
#include <meshtool/predicates.h>
#include <meshtool/triangulate.h>

#include <math.h>
#include <stdio.h>

static const char *const levels[] = {"8 bits", "10 bits", "11 bits", "12 bits", "14 bits", "16 bits", "20 bits", NULL};
static const unsigned bits[] = {8, 10, 11, 12, 14, 16, 20};

typedef struct quantization_state {
    mt_mesh *triangles;
    double diagonal;
    void *bytes;
    size_t size;
} quantization_state;

static mt_status encode(mt_context *context, const mt_mesh *mesh, unsigned position_bits, void **bytes, size_t *size)
{
    mt_mesh_write_options options = {.format = "drc"};
    options.draco = (mt_draco_options){.compress = true, .position_bits = position_bits, .sequential = true};
    return mt_mesh_write_memory(context, mesh, &options, bytes, size);
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    const mt_mesh_format *draco = mt_mesh_format_by_extension("drc");
    if (subject->mesh->face_count == 0 || mt_mesh_bounds(subject->mesh).non_finite_count > 0) {
        *why = subject->mesh->face_count == 0 ? "the mesh has no faces" : "some vertices are not finite";
        return MT_OK;
    }
    if (!draco || !draco->write || !draco->read) {
        *why = "this meshtool was built without Draco";
        return MT_OK;
    }
    quantization_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->diagonal = subject->diagonal;
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

static mt_status run(void *state, size_t level, mt_context *context)
{
    quantization_state *s = state;
    return encode(context, s->triangles, bits[level], &s->bytes, &s->size);
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

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    const quantization_state *s = state;
    mt_mesh *back = NULL;
    mt_status status = mt_mesh_read_memory(context, "quantised.drc", s->bytes, s->size, NULL, &back, NULL);
    if (status != MT_OK) {
        return status;
    }
    bool is_same = back->vertex_count == s->triangles->vertex_count && back->face_count == s->triangles->face_count;
    double largest = 0, squares = 0;
    for (mt_index vertex = 0; is_same && vertex < back->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(s->triangles, vertex), q = mt_mesh_position(back, vertex);
        double distance = mt_vec3_length(mt_vec3_subtract(p, q)) / s->diagonal;
        largest = fmax(largest, distance);
        squares += distance * distance;
    }
    mt_index flipped = 0, collapsed = 0;
    if (is_same) {
        count_spoilt(s->triangles, back, &flipped, &collapsed);
    }
    tradeoff_add_size(row, "bytes", (double)s->size);
    tradeoff_add_error(row, "moved_max", largest);
    tradeoff_add_error(row, "moved_rms", sqrt(squares / back->vertex_count));
    tradeoff_add_error(row, "flipped_faces", flipped);
    tradeoff_add_error(row, "collapsed_faces", collapsed);
    /* Half a step on each axis, and what single precision rounds. */
    double bound = 0.5 * sqrt(3) / ((1u << bits[level]) - 1) + 4e-7;
    row->is_defect = !is_same || largest > bound;
    snprintf(row->says, sizeof row->says,
             "vertices move by up to %.2g of the diagonal; %u faces turn over, %u collapse", largest, (unsigned)flipped,
             (unsigned)collapsed);
    mt_mesh_destroy(context, back);
    return MT_OK;
}

const tradeoff_knob tradeoff_quantization = {
    .name = "quantization",
    .question = "How many bits of a coordinate does Draco keep?",
    .oracle = "what is read back, vertex by vertex",
    .axis = "moved_max",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
