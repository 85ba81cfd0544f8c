/* Vertex normals: by area in one pass over the faces where that serves; else each vertex gathers over its corners in
 * ascending order, with a power of two kept apart from each sum. Cost: linear. */
#include "lib/algorithms/normals_face.h"
#include "lib/algorithms/normals_ring.h"

typedef struct vertex_job {
    mt_normals_job *job;
    mt_normal_rings rings;
} vertex_job;

static mt_vec3 gather(const mt_normal_rings *rings, mt_index vertex)
{
    mt_scaled_vector sum = {{0, 0, 0}, 0};
    for (mt_index i = rings->begins[vertex]; i < rings->begins[vertex + 1]; i++) {
        mt_add_term(&sum, mt_corner_term(rings, rings->corners[i]));
    }
    return mt_unit_vector(sum.vector);
}

static void gather_block(void *user, uint64_t begin, uint64_t end)
{
    const vertex_job *vertices = user;
    mt_attribute *values = vertices->job->values;
    mt_index undefined = 0;
    for (mt_index vertex = (mt_index)begin; vertex < end; vertex++) {
        mt_vec3 n = gather(&vertices->rings, vertex);
        mt_store_normal(values->values, values->type, vertex, n);
        undefined += mt_vector_is_zero(n);
    }
    mt_count_undefined(vertices->job, undefined);
}

static mt_status gather_all(mt_normals_job *job)
{
    vertex_job vertices = {.job = job};
    mt_status status = mt_normal_rings_init(job, &vertices.rings);
    if (status == MT_OK) {
        mt_parallel_for(job->context, job->mesh->vertex_count, MT_NORMALS_GRAIN, gather_block, &vertices);
        mt_normal_rings_release(job->context, &vertices.rings);
    }
    return status;
}

mt_status mt_normals_of_vertices(mt_normals_job *job)
{
    bool done = false;
    mt_status status = job->options.weight == MT_NORMAL_WEIGHT_AREA ? mt_normals_by_area(job, &done) : MT_OK;
    return status == MT_OK && !done ? gather_all(job) : status;
}
