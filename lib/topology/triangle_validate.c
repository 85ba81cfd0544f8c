/* The invariants of the triangle-neighbour structure, first of its sides, then of the rings around its vertices: those
 * may be walked once the sides are sound.
 *
 * Cost: O(size) time, 8 bytes a vertex. */
#include "lib/topology/triangle_validate.h"

#include <string.h>

typedef struct triangle_inspection {
    mt_context *context;
    const mt_triangle_neighbor_mesh *structure;
    mt_status status;       /* of a violation */
    mt_index *corner_count; /* per vertex */
    mt_index *ring_of;      /* per vertex the last one in whose ring it was met */
} triangle_inspection;

static mt_status inspect_vertices(const triangle_inspection *job, mt_index triangle)
{
    const mt_index *vertex = job->structure->vertices + 3 * (size_t)triangle;
    for (mt_index i = 0; i < 3; i++) {
        if (vertex[i] >= job->structure->vertex_count) {
            return mt_fail(job->context, job->status, "triangle %u names vertex %u of %u", triangle, vertex[i],
                           job->structure->vertex_count);
        }
        if (vertex[i] == vertex[(i + 1) % 3]) {
            return mt_fail(job->context, job->status, "triangle %u names vertex %u twice", triangle, vertex[i]);
        }
        job->corner_count[vertex[i]]++;
    }
    return MT_OK;
}

static mt_status inspect_side(const triangle_inspection *job, mt_index corner)
{
    const mt_triangle_neighbor_mesh *structure = job->structure;
    const mt_index *vertices = structure->vertices;
    mt_index across = structure->neighbors[corner];
    if (across == MT_NONE) {
        return MT_OK;
    }
    if (across >= 3 * structure->triangle_count || structure->neighbors[across] != corner || across == corner) {
        return mt_fail(job->context, job->status,
                       "side %u of triangle %u has corner %u across, which does not have it across", corner % 3,
                       corner / 3, across);
    }
    if (vertices[across] != vertices[mt_triangle_next_corner(corner)] ||
        vertices[mt_triangle_next_corner(across)] != vertices[corner]) {
        return mt_fail(job->context, job->status,
                       "side %u of triangle %u does not run along the same vertices, in the opposite direction, as "
                       "side %u of triangle %u across",
                       corner % 3, corner / 3, across % 3, across / 3);
    }
    return MT_OK;
}

static mt_status inspect_ring(const triangle_inspection *job, mt_index vertex)
{
    const mt_triangle_neighbor_mesh *structure = job->structure;
    mt_index begin = structure->vertex_corner[vertex];
    if (begin != MT_NONE && (begin >= 3 * structure->triangle_count || structure->vertices[begin] != vertex)) {
        return mt_fail(job->context, job->status, "vertex %u has corner %u, which is not one of its own", vertex,
                       begin);
    }
    mt_index triangles = 0;
    for (mt_triangle_ring ring = mt_triangle_ring_begin(structure, vertex); mt_triangle_ring_goes_on(&ring);
         mt_triangle_ring_counterclockwise(structure, &ring)) {
        if (job->ring_of[ring.neighbor] == vertex) {
            return mt_fail(job->context, job->status, "two edges join vertices %u and %u", vertex, ring.neighbor);
        }
        job->ring_of[ring.neighbor] = vertex;
        triangles += ring.corner != MT_NONE;
    }
    if (triangles != job->corner_count[vertex]) {
        return mt_fail(job->context, job->status, "the ring of vertex %u meets %u of its %u triangles", vertex,
                       triangles, job->corner_count[vertex]);
    }
    return MT_OK;
}

static mt_status inspect_all(const triangle_inspection *job)
{
    const mt_triangle_neighbor_mesh *structure = job->structure;
    mt_status status = MT_OK;
    for (mt_index triangle = 0; triangle < structure->triangle_count && status == MT_OK; triangle++) {
        status = inspect_vertices(job, triangle);
    }
    for (mt_index corner = 0; corner < 3 * structure->triangle_count && status == MT_OK; corner++) {
        status = inspect_side(job, corner);
    }
    for (mt_index vertex = 0; vertex < structure->vertex_count && status == MT_OK; vertex++) {
        status = inspect_ring(job, vertex);
    }
    return status;
}

mt_status mt_triangle_neighbor_inspect(mt_context *context, const mt_triangle_neighbor_mesh *structure,
                                       mt_status status)
{
    triangle_inspection job = {.context = context, .structure = structure, .status = status};
    job.corner_count = mt_allocate_array_zeroed(context, structure->vertex_count, sizeof *job.corner_count);
    job.ring_of = mt_allocate_array(context, structure->vertex_count, sizeof *job.ring_of);
    mt_status result = MT_ERROR_OUT_OF_MEMORY;
    if (job.corner_count && job.ring_of) {
        memset(job.ring_of, 0xff, structure->vertex_count * sizeof *job.ring_of);
        result = inspect_all(&job);
    }
    mt_free(context, job.corner_count);
    mt_free(context, job.ring_of);
    return result;
}

mt_status mt_triangle_neighbor_validate(mt_context *context, const mt_triangle_neighbor_mesh *structure)
{
    return mt_triangle_neighbor_inspect(context, structure, MT_ERROR_INTERNAL);
}
