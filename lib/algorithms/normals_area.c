/* Vertex normals by area: one pass over the faces adds each area vector at the face's vertices, then each sum is
 * brought to length 1. Several threads own a range of vertices each and all pass over the faces, adding what falls into
 * their range: so every sum runs over faces in ascending order, whoever runs it.
 *
 * Cost: linear; three doubles a vertex beside the result, none when that is in doubles. Random order of faces and
 * vertices costs cache misses; positions and sums are asked for some faces ahead. */
#include "lib/algorithms/normals.h"
#include "lib/algorithms/normals_face.h"

#include <string.h>

/* Threads that pass over all faces; with more of them passing would cost more than adding. */
#define RANGES_MAXIMUM 8

/* Faces that memory is given to fetch what they need. */
#define LOOK_AHEAD 16

typedef struct area_job {
    mt_normals_job *job;
    double *sums; /* 3 a vertex */
    mt_index range_count;
    bool out_of_range[RANGES_MAXIMUM]; /* per range: an area that cannot be summed as it is */
} area_job;

MT_INLINE void add_at(double *sums, mt_index vertex, mt_vec3 n)
{
    double *sum = sums + 3 * (size_t)vertex;
    sum[0] += n.x, sum[1] += n.y, sum[2] += n.z;
}

/* The area vector of a face that plain doubles do not serve. False: it is out of range. */
static bool find_area_vector(const mt_mesh *mesh, mt_index face, mt_vec3 *area_vector)
{
    mt_scaled_vector scaled = mt_face_area_vector(mesh, face);
    *area_vector = mt_shift_vector(scaled.vector, scaled.exponent);
    return mt_vector_is_zero(scaled.vector) || mt_is_plain(*area_vector);
}

/* One range of vertices; `whole`: it is all of them. */
typedef struct range {
    mt_index begin, count;
    bool whole, is_double;
    mt_index sides; /* 0: as the mesh says */
} range;

MT_INLINE bool touches(const range *own, const mt_index *vertices, mt_index sides)
{
    for (mt_index i = 0; i < sides; i++) {
        if (vertices[i] - own->begin < own->count) {
            return true;
        }
    }
    return false;
}

MT_INLINE void fetch_face(const mt_mesh *mesh, const double *sums, const range *own, const mt_index *vertices)
{
    size_t size = own->is_double ? 3 * sizeof(double) : 3 * sizeof(float);
    for (mt_index i = 0; i < own->sides; i++) {
        __builtin_prefetch((const char *)mesh->positions + vertices[i] * size);
        __builtin_prefetch(sums + 3 * (size_t)vertices[i], 1);
    }
}

MT_INLINE bool add_faces(const mt_mesh *mesh, double *sums, const range *own)
{
    bool fits = true;
    mt_index ahead = mesh->face_count > LOOK_AHEAD ? mesh->face_count - LOOK_AHEAD : 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = own->sides ? own->sides * face : mt_mesh_face_begin(mesh, face);
        mt_index sides = own->sides ? own->sides : mt_mesh_face_sides(mesh, face);
        const mt_index *vertices = mesh->corner_vertices + begin;
        if (own->sides && face < ahead) {
            fetch_face(mesh, sums, own, vertices + (size_t)own->sides * LOOK_AHEAD);
        }
        if (!own->whole && !touches(own, vertices, sides)) {
            continue;
        }
        mt_vec3 n;
        if (!mt_plain_area_vector(mesh->positions, own->is_double, vertices, sides, &n)) {
            fits = find_area_vector(mesh, face, &n) && fits;
        }
        for (mt_index i = 0; i < sides; i++) {
            if (own->whole || vertices[i] - own->begin < own->count) {
                add_at(sums, vertices[i], n);
            }
        }
    }
    return fits;
}

static bool add_triangles_whole(const mt_mesh *mesh, double *sums, bool is_double)
{
    range own = {0, mesh->vertex_count, true, true, 3};
    if (is_double) {
        return add_faces(mesh, sums, &own);
    }
    own.is_double = false;
    return add_faces(mesh, sums, &own);
}

static bool add_triangles(const mt_mesh *mesh, double *sums, mt_index begin, mt_index count)
{
    if (mesh->position_type == MT_F64) {
        range own = {begin, count, false, true, 3};
        return add_faces(mesh, sums, &own);
    }
    range own = {begin, count, false, false, 3};
    return add_faces(mesh, sums, &own);
}

static bool add_polygons(const mt_mesh *mesh, double *sums, mt_index begin, mt_index count)
{
    bool whole = count == mesh->vertex_count;
    range own = {begin, count, whole, mesh->position_type == MT_F64, 0};
    return add_faces(mesh, sums, &own);
}

static void add_range(void *user, uint64_t number, uint64_t end)
{
    (void)end;
    area_job *area = user;
    const mt_mesh *mesh = area->job->mesh;
    uint64_t begin = (uint64_t)mesh->vertex_count * number / area->range_count;
    uint64_t count = (uint64_t)mesh->vertex_count * (number + 1) / area->range_count - begin;
    memset(area->sums + 3 * begin, 0, 3 * count * sizeof(double));
    bool triangles = !mesh->face_offsets && mesh->face_size == 3, fits;
    if (triangles && area->range_count == 1) {
        fits = add_triangles_whole(mesh, area->sums, mesh->position_type == MT_F64);
    } else if (triangles) {
        fits = add_triangles(mesh, area->sums, (mt_index)begin, (mt_index)count);
    } else {
        fits = add_polygons(mesh, area->sums, (mt_index)begin, (mt_index)count);
    }
    area->out_of_range[number] = !fits;
}

static void make_units(void *user, uint64_t begin, uint64_t end)
{
    const area_job *area = user;
    mt_attribute *values = area->job->values;
    mt_index undefined = 0;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        const double *sum = area->sums + 3 * vertex;
        mt_vec3 n = mt_unit_vector(mt_vec3_make(sum[0], sum[1], sum[2]));
        mt_store_normal(values->values, values->type, vertex, n);
        undefined += mt_vector_is_zero(n);
    }
    mt_count_undefined(area->job, undefined);
}

static void sum_and_make_units(area_job *area, bool *done)
{
    mt_context *context = area->job->context;
    mt_index vertex_count = area->job->mesh->vertex_count;
    mt_parallel_for(context, area->range_count, 1, add_range, area);
    *done = true;
    for (mt_index i = 0; i < area->range_count; i++) {
        *done = *done && !area->out_of_range[i];
    }
    if (*done) {
        mt_parallel_for(context, vertex_count, MT_NORMALS_GRAIN, make_units, area);
    }
}

mt_status mt_normals_by_area(mt_normals_job *job, bool *done)
{
    unsigned threads = mt_context_thread_count(job->context);
    area_job area = {.job = job, .range_count = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM};
    if (job->values->type == MT_F64) {
        area.sums = job->values->values;
        sum_and_make_units(&area, done);
        return MT_OK;
    }
    area.sums = mt_allocate_array(job->context, job->mesh->vertex_count, 3 * sizeof(double));
    if (!area.sums) {
        return mt_context_error(job->context)->status;
    }
    sum_and_make_units(&area, done);
    mt_free(job->context, area.sums);
    return MT_OK;
}
