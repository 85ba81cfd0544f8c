/* What is left is derived from the source as far as it is copied; what was mixed runs through the log's steps. */
#include "lib/topology/surgery_mesh.h"
#include "lib/topology/edit_program.h"
#include "lib/topology/surgery_creases.h"

#include <meshtool/derive.h>

typedef struct surgery_job {
    mt_context *context;
    const mt_mesh *source;
    const mt_edit_log *log;
    const mt_surgery_shape *shape;
    mt_edit_reading reading;
    mt_index *face_offsets, *corner_vertices;
    mt_index *vertex_sources, *corner_sources; /* per new element the source's, MT_NONE where values are set later */
} surgery_job;

static mt_status check_source(mt_context *context, const mt_mesh *source, const mt_edit_log *log)
{
    if (log->is_off) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the log of surgery was off, so nothing can follow it");
    }
    if (source->vertex_count != log->vertex_count || source->face_count != log->face_count) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "surgery began with %u vertices and %u faces, but the mesh has %u and %u", log->vertex_count,
                       log->face_count, source->vertex_count, source->face_count);
    }
    return MT_OK;
}

static bool has_corner_values(const mt_mesh *mesh)
{
    bool has = false;
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        has = has || mesh->attributes[i].domain == MT_DOMAIN_CORNER;
    }
    return has;
}

static void list_faces(const surgery_job *job)
{
    const mt_surgery_shape *shape = job->shape;
    mt_index count = 0;
    for (mt_index face = 0; face < shape->face_count; face++) {
        if (shape->face_offsets[face] != shape->face_offsets[face + 1]) {
            job->face_offsets[count++] = shape->face_offsets[face];
        }
    }
    job->face_offsets[count] = job->reading.corner_count;
    for (mt_index c = 0; c < job->reading.corner_count; c++) {
        job->corner_vertices[c] = job->reading.vertex_numbers[shape->corner_vertices[c]];
    }
}

/* Whether corner `b` follows `a` in the source's face. */
static bool follows(const mt_mesh *source, mt_index a, mt_index b, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(source, face), end = mt_mesh_face_end(source, face);
    return b == (a + 1 < end ? a + 1 : begin);
}

/* mt_mesh_derive turns normals where corners run backwards. None do here, but a face whose corners were exchanged one
 * by one could look so; its second corner is then set later, as if mixed. */
static void hide_exchanged_corners(const surgery_job *job)
{
    const mt_index *slots = job->reading.corner_slots;
    for (mt_index i = 0; i < job->reading.face_count; i++) {
        mt_index begin = job->face_offsets[i], end = job->face_offsets[i + 1], face = job->reading.face_slots[i];
        bool whole = face != MT_NONE;
        for (mt_index c = begin; whole && c < end; c++) {
            whole = follows(job->source, slots[c], slots[c + 1 < end ? c + 1 : begin], face);
        }
        job->corner_sources[begin + 1] = whole ? job->corner_sources[begin + 1] : MT_NONE;
    }
}

static void find_sources(const surgery_job *job)
{
    const mt_edit_reading *reading = &job->reading;
    for (mt_index v = 0; v < reading->vertex_count; v++) {
        mt_index slot = reading->vertex_slots[v];
        job->vertex_sources[v] = slot < job->source->vertex_count ? slot : MT_NONE;
    }
    for (mt_index c = 0; c < reading->corner_count; c++) {
        mt_index slot = reading->corner_slots[c];
        job->corner_sources[c] = slot < job->source->corner_count ? slot : MT_NONE;
    }
    hide_exchanged_corners(job);
}

static mt_status derive(surgery_job *job, mt_mesh **out)
{
    const mt_edit_reading *reading = &job->reading;
    job->face_offsets = mt_allocate_array(job->context, (uint64_t)reading->face_count + 1, sizeof(mt_index));
    job->corner_vertices = mt_allocate_array(job->context, reading->corner_count, sizeof(mt_index));
    job->vertex_sources = mt_allocate_array(job->context, reading->vertex_count, sizeof(mt_index));
    job->corner_sources = mt_allocate_array(job->context, reading->corner_count, sizeof(mt_index));
    if (!job->face_offsets || !job->corner_vertices || !job->vertex_sources || !job->corner_sources) {
        return mt_context_error(job->context)->status;
    }
    list_faces(job);
    find_sources(job);
    const mt_derivation derivation = {.vertex_count = reading->vertex_count,
                                      .vertex_sources = job->vertex_sources,
                                      .vertex_targets = reading->vertex_targets,
                                      .face_count = reading->face_count,
                                      .face_offsets = job->face_offsets,
                                      .face_sources = reading->face_slots,
                                      .corner_count = reading->corner_count,
                                      .corner_sources = job->corner_sources,
                                      .corner_vertices = job->corner_vertices};
    mt_mesh without_sharpness = *job->source;
    without_sharpness.crease_count = 0;
    without_sharpness.sharp_vertex_count = 0;
    return mt_mesh_derive(job->context, &without_sharpness, &derivation, out);
}

static mt_status follow_positions(const surgery_job *job, mt_mesh *mesh)
{
    const mt_edit_reading *reading = &job->reading;
    mt_attribute source = {.semantic = MT_SEMANTIC_GENERIC,
                           .domain = MT_DOMAIN_VERTEX,
                           .type = job->source->position_type,
                           .component_count = 3,
                           .value_count = job->source->vertex_count,
                           .values = job->source->positions};
    mt_attribute target = source;
    target.values = mesh->positions;
    target.value_count = mesh->vertex_count;
    return mt_edit_program_run(job->context, &reading->vertices, &source, reading->vertex_slots, job->vertex_sources,
                               reading->vertex_count, &target);
}

static mt_status follow_attributes(const surgery_job *job, mt_mesh *mesh)
{
    const mt_edit_reading *reading = &job->reading;
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < mesh->attribute_count; i++) {
        const mt_attribute *source = &job->source->attributes[i];
        mt_attribute *target = &mesh->attributes[i];
        if (source->domain == MT_DOMAIN_VERTEX) {
            status = mt_edit_program_run(job->context, &reading->vertices, source, reading->vertex_slots,
                                         job->vertex_sources, reading->vertex_count, target);
        } else if (source->domain == MT_DOMAIN_CORNER) {
            status = mt_edit_program_run(job->context, &reading->corners, source, reading->corner_slots,
                                         job->corner_sources, reading->corner_count, target);
        }
    }
    return status;
}

static mt_status make_mesh(surgery_job *job, mt_mesh **out)
{
    mt_status status =
        mt_edit_read(job->context, job->source, job->log, job->shape, has_corner_values(job->source), &job->reading);
    status = status == MT_OK ? derive(job, out) : status;
    status = status == MT_OK ? follow_positions(job, *out) : status;
    status = status == MT_OK ? follow_attributes(job, *out) : status;
    if (status == MT_OK) {
        status = mt_surgery_creases(job->context, job->source, job->log, &job->reading, *out);
        mt_mesh_compact_faces(job->context, *out);
    }
    return status;
}

mt_status mt_surgery_mesh(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                          const mt_surgery_shape *shape, mt_mesh **out)
{
    *out = NULL;
    mt_status status = check_source(context, source, log);
    if (status != MT_OK) {
        return status;
    }
    surgery_job job = {.context = context, .source = source, .log = log, .shape = shape};
    status = make_mesh(&job, out);
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    mt_edit_reading_release(context, &job.reading);
    mt_index *blocks[] = {job.face_offsets, job.corner_vertices, job.vertex_sources, job.corner_sources};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        mt_free(context, blocks[i]);
    }
    return status;
}

/* The corners of living faces, one after the other; room NULL: only counts them. */
static mt_index list_corners(const mt_surgery_view *view, mt_index *offsets, mt_index *room)
{
    mt_index count = 0;
    for (mt_index face = 0; face < view->face_count; face++) {
        mt_index begin = view->face_side(view->structure, face), side = begin;
        offsets[face] = count;
        while (side != MT_NONE) {
            if (room) {
                room[count] = surgery_tail(view, side);
            }
            count++;
            side = surgery_next(view, side);
            side = side == begin ? MT_NONE : side;
        }
    }
    offsets[view->face_count] = count;
    return count;
}

mt_status mt_surgery_view_mesh(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                               const mt_surgery_view *view, mt_mesh **out)
{
    *out = NULL;
    mt_surgery_shape shape = {view->vertex_count, view->face_count, view->vertex_deleted, NULL, NULL};
    shape.face_offsets = mt_allocate_array(context, (uint64_t)view->face_count + 1, sizeof(mt_index));
    if (shape.face_offsets) {
        mt_index count = list_corners(view, shape.face_offsets, NULL);
        shape.corner_vertices = mt_allocate_array(context, count, sizeof(mt_index));
    }
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (shape.corner_vertices) {
        list_corners(view, shape.face_offsets, shape.corner_vertices);
        status = mt_surgery_mesh(context, source, log, &shape, out);
    }
    mt_free(context, shape.face_offsets);
    mt_free(context, shape.corner_vertices);
    return status;
}
