/* A counting sort deals the corners to their vertices; several threads own a range of vertices each and pass over all
 * corners, so that each list ascends.
 *
 * Angles are those of Kahan's advice: from the lengths of cross and dot product, which is right for the thinnest and
 * the flattest corners; the angle of a corner that points into its polygon is what is left of the full turn. */
#include "lib/algorithms/normals_ring.h"
#include "lib/algorithms/normals_face.h"

#include <meshtool/elementary.h>

#include <string.h>

#define RANGES_MAXIMUM 8 /* threads that pass over all corners */

typedef struct ring_job {
    mt_normal_rings *rings;
    mt_index range_count;
    mt_index most[RANGES_MAXIMUM];
    mt_index totals[RANGES_MAXIMUM]; /* corners of each range, then where its corners begin */
} ring_job;

static mt_index range_begin(const ring_job *job, uint64_t range)
{
    return (mt_index)(job->rings->mesh->vertex_count * range / job->range_count);
}

/* begins[v + 1] becomes the number of corners of v. */
static void count_range(void *user, uint64_t range, uint64_t range_end)
{
    (void)range_end;
    ring_job *job = user;
    const mt_mesh *mesh = job->rings->mesh;
    mt_index begin = range_begin(job, range), count = range_begin(job, range + 1) - begin;
    mt_index *counts = job->rings->begins + 1 + begin;
    mt_index most = 0, total = 0;
    memset(counts, 0, count * sizeof *counts);
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index vertex = mesh->corner_vertices[corner] - begin;
        if (vertex < count) {
            counts[vertex]++;
        }
    }
    for (mt_index vertex = 0; vertex < count; vertex++) {
        most = counts[vertex] > most ? counts[vertex] : most;
        total += counts[vertex];
    }
    job->most[range] = most;
    job->totals[range] = total;
}

/* Counts become beginnings, which storing the corners moves to the ends: the beginnings of the next. */
static void deal_range(void *user, uint64_t range, uint64_t range_end)
{
    (void)range_end;
    const ring_job *job = user;
    const mt_mesh *mesh = job->rings->mesh;
    mt_index begin = range_begin(job, range), count = range_begin(job, range + 1) - begin;
    mt_index *cursors = job->rings->begins + 1 + begin;
    mt_index at = job->totals[range];
    for (mt_index vertex = 0; vertex < count; vertex++) {
        mt_index size = cursors[vertex];
        cursors[vertex] = at;
        at += size;
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index vertex = mesh->corner_vertices[corner] - begin;
        if (vertex < count) {
            job->rings->corners[cursors[vertex]++] = corner;
        }
    }
}

static void find_corner_faces(void *user, uint64_t begin, uint64_t end)
{
    const mt_normal_rings *rings = user;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        for (mt_index corner = mt_mesh_face_begin(rings->mesh, face); corner < mt_mesh_face_end(rings->mesh, face);
             corner++) {
            rings->corner_faces[corner] = face;
        }
    }
}

static void find_units(void *user, uint64_t begin, uint64_t end)
{
    const mt_normal_rings *rings = user;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        rings->units[face] = mt_unit_vector(mt_any_area_vector(rings->mesh, face).vector);
    }
}

static void fill(mt_context *context, mt_normal_rings *rings)
{
    unsigned threads = mt_context_thread_count(context);
    ring_job job = {.rings = rings, .range_count = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM};
    rings->begins[0] = 0;
    mt_parallel_for(context, job.range_count, 1, count_range, &job);
    mt_index at = 0;
    for (mt_index range = 0; range < job.range_count; range++) {
        mt_index total = job.totals[range];
        job.totals[range] = at;
        at += total;
        rings->most = job.most[range] > rings->most ? job.most[range] : rings->most;
    }
    mt_parallel_for(context, job.range_count, 1, deal_range, &job);
    if (rings->corner_faces) {
        mt_parallel_for(context, rings->mesh->face_count, MT_NORMALS_GRAIN, find_corner_faces, rings);
    }
    mt_parallel_for(context, rings->mesh->face_count, MT_NORMALS_GRAIN, find_units, rings);
}

mt_status mt_normal_rings_init(mt_normals_job *job, mt_normal_rings *rings)
{
    const mt_mesh *mesh = job->mesh;
    mt_context *context = job->context;
    *rings = (mt_normal_rings){.mesh = mesh, .weight = job->options.weight};
    rings->begins = mt_allocate_array(context, (uint64_t)mesh->vertex_count + 1, sizeof(mt_index));
    rings->corners = mt_allocate_array(context, mesh->corner_count, sizeof(mt_index));
    rings->units = mt_allocate_array(context, mesh->face_count, sizeof(mt_vec3));
    if (mesh->face_offsets) {
        rings->corner_faces = mt_allocate_array(context, mesh->corner_count, sizeof(mt_index));
    }
    bool complete = rings->begins && rings->corners && rings->units && (rings->corner_faces || !mesh->face_offsets);
    if (!complete) {
        mt_normal_rings_release(context, rings);
        return mt_context_error(context)->status;
    }
    fill(context, rings);
    return MT_OK;
}

void mt_normal_rings_release(mt_context *context, mt_normal_rings *rings)
{
    mt_free(context, rings->begins);
    mt_free(context, rings->corners);
    mt_free(context, rings->units);
    mt_free(context, rings->corner_faces);
    *rings = (mt_normal_rings){0};
}

static mt_vec3 position(const mt_normal_rings *rings, mt_index corner)
{
    return mt_mesh_position(rings->mesh, rings->mesh->corner_vertices[corner]);
}

static mt_corner_span span_of(const mt_normal_rings *rings, mt_index corner, mt_index face)
{
    return mt_corner_span_of(position(rings, corner), position(rings, mt_ring_next(rings, corner, face)),
                             position(rings, mt_ring_previous(rings, corner, face)));
}

/* Brings the largest component into [0.5, 1); returns the power of two taken out. */
static int take_exponent(mt_vec3 *a)
{
    int exponent = 0;
    frexp(mt_largest_component(*a), &exponent);
    *a = mt_shift_vector(*a, -exponent);
    return exponent;
}

static double angle_of(mt_corner_span span, mt_vec3 unit)
{
    if (mt_vector_is_zero(span.to_next) || mt_vector_is_zero(span.to_previous)) {
        return 0;
    }
    if (!mt_is_plain(span.cross)) {
        int exponent = take_exponent(&span.to_next) + take_exponent(&span.to_previous);
        span.cross = mt_shift_vector(span.cross, -exponent);
    }
    double sine = sqrt(mt_symmetric_dot(span.cross, span.cross));
    double angle = mt_atan2(sine, mt_symmetric_dot(span.to_next, span.to_previous));
    return mt_symmetric_dot(span.cross, unit) < 0 ? 2 * MT_PI - angle : angle;
}

/* cross / (a^2 b^2), with powers of two kept apart so that no product leaves the range. */
static mt_scaled_vector max_term(mt_corner_span span)
{
    if (mt_vector_is_zero(span.cross)) {
        return (mt_scaled_vector){{0, 0, 0}, 0};
    }
    int exponent = -2 * (take_exponent(&span.to_next) + take_exponent(&span.to_previous) + span.exponent);
    exponent += take_exponent(&span.cross);
    double squares =
        mt_symmetric_dot(span.to_next, span.to_next) * mt_symmetric_dot(span.to_previous, span.to_previous);
    return (mt_scaled_vector){mt_vec3_scale(span.cross, 1 / squares), exponent};
}

mt_scaled_vector mt_corner_term(const mt_normal_rings *rings, mt_index corner)
{
    mt_index face = mt_ring_face(rings, corner);
    mt_vec3 unit = rings->units[face];
    if (mt_vector_is_zero(unit)) {
        return (mt_scaled_vector){{0, 0, 0}, 0};
    }
    switch (rings->weight) {
    case MT_NORMAL_WEIGHT_AREA:
        return mt_any_area_vector(rings->mesh, face);
    case MT_NORMAL_WEIGHT_ANGLE:
        return (mt_scaled_vector){mt_vec3_scale(unit, angle_of(span_of(rings, corner, face), unit)), 0};
    case MT_NORMAL_WEIGHT_MAX:
        return max_term(span_of(rings, corner, face));
    case MT_NORMAL_WEIGHT_UNIFORM:
        break;
    }
    return (mt_scaled_vector){unit, 0};
}
