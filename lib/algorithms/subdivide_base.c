/* Level 0 of the connectivity, from the edge pairs: what later levels have in closed form is counted here once.
 * Cost: O(corners); 4 bytes a vertex and 1 to 12 a corner, none of it hashed or sorted. */
#include "lib/algorithms/subdivide_topology.h"

/* Corners of a counting block; a multiple of 12, so that no triangle or quad straddles two. */
#define RANK_GRAIN 12288

typedef struct rank_job {
    const mt_index *twins;
    mt_index *ranks;
    mt_index *block_counts;
    unsigned face_size;
} rank_job;

static void count_first_corners(void *user, uint64_t begin, uint64_t end)
{
    const rank_job *job = user;
    mt_index count = 0;
    for (uint64_t corner = begin; corner < end; corner++) {
        count += job->twins[corner] >= corner;
    }
    job->block_counts[begin / RANK_GRAIN] = count;
}

static void write_ranks(void *user, uint64_t begin, uint64_t end)
{
    const rank_job *job = user;
    uint64_t step = job->face_size ? job->face_size : 1;
    mt_index rank = job->block_counts[begin / RANK_GRAIN];
    mt_index *ranks = job->ranks + begin / step;
    for (uint64_t first = begin; first < end; first += step) {
        *ranks++ = rank;
        for (uint64_t corner = first; corner < first + step; corner++) {
            rank += job->twins[corner] >= corner;
        }
    }
}

static mt_index sum_blocks(mt_index *counts, uint64_t block_count)
{
    mt_index sum = 0;
    for (uint64_t block = 0; block < block_count; block++) {
        mt_index count = counts[block];
        counts[block] = sum;
        sum += count;
    }
    return sum;
}

static mt_status rank_edges(mt_context *context, mt_subdivide_topology *topology)
{
    bool per_face = topology->face_size != 0;
    uint64_t block_count = (uint64_t)topology->corner_count / RANK_GRAIN + 1;
    rank_job job = {.twins = topology->twins, .face_size = topology->face_size};
    topology->owned[0] = job.ranks =
        mt_allocate_array(context, per_face ? topology->face_count : topology->corner_count, sizeof(mt_index));
    job.block_counts = mt_allocate_array_zeroed(context, block_count, sizeof(mt_index));
    if (!job.ranks || !job.block_counts) {
        mt_free(context, job.block_counts);
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, topology->corner_count, RANK_GRAIN, count_first_corners, &job);
    topology->edge_count = sum_blocks(job.block_counts, block_count);
    mt_parallel_for(context, topology->corner_count, RANK_GRAIN, write_ranks, &job);
    topology->edge_ranks = job.ranks;
    mt_free(context, job.block_counts);
    return MT_OK;
}

typedef struct face_job {
    const mt_mesh *mesh;
    mt_index *offsets; /* NULL when the mesh has them */
    mt_index *corner_faces;
} face_job;

static void write_corner_faces(void *user, uint64_t begin, uint64_t end)
{
    const face_job *job = user;
    for (uint64_t face = begin; face < end; face++) {
        mt_index first = mt_mesh_face_begin(job->mesh, (mt_index)face);
        mt_index last = mt_mesh_face_end(job->mesh, (mt_index)face);
        if (job->offsets) {
            job->offsets[face + 1] = last;
        }
        for (mt_index corner = first; corner < last; corner++) {
            job->corner_faces[corner] = (mt_index)face;
        }
    }
}

static mt_status describe_faces(mt_context *context, const mt_mesh *mesh, mt_subdivide_topology *topology)
{
    if (!mesh->face_offsets && (mesh->face_size == 3 || mesh->face_size == 4)) {
        topology->face_size = mesh->face_size;
        return MT_OK;
    }
    face_job job = {.mesh = mesh};
    topology->owned[1] = job.corner_faces = mt_allocate_array(context, mesh->corner_count, sizeof(mt_index));
    if (!mesh->face_offsets) {
        topology->owned[2] = job.offsets = mt_allocate_array(context, (uint64_t)mesh->face_count + 1, sizeof(mt_index));
    }
    if (!job.corner_faces || (!job.offsets && !mesh->face_offsets)) {
        return mt_context_error(context)->status;
    }
    if (job.offsets) {
        job.offsets[0] = 0;
    }
    mt_parallel_for(context, mesh->face_count, MT_SUBDIVIDE_GRAIN, write_corner_faces, &job);
    topology->corner_faces = job.corner_faces;
    topology->face_offsets = job.offsets ? job.offsets : mesh->face_offsets;
    return MT_OK;
}

/* One pass in the order of the corners: a scatter by several threads would need atomics, and costs more. */
mt_status mt_subdivide_find_vertex_corners(mt_context *context, mt_subdivide_topology *topology)
{
    mt_index *corners = mt_allocate_array(context, topology->vertex_count, sizeof *corners);
    if (!corners) {
        return mt_context_error(context)->status;
    }
    topology->owned[5] = corners;
    topology->vertex_corners = corners;
    topology->vertex_corner_shift = 0;
    topology->vertex_corner_count = topology->vertex_count;
    for (mt_index vertex = 0; vertex < topology->vertex_count; vertex++) {
        corners[vertex] = MT_NONE;
    }
    for (mt_index corner = 0; corner < topology->corner_count; corner++) {
        mt_index vertex = topology->corner_vertices[corner];
        if (corners[vertex] == MT_NONE || topology->twins[corner] == corner) {
            corners[vertex] = corner;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_topology_of_mesh(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                        mt_subdivide_topology *topology)
{
    *topology = (mt_subdivide_topology){.vertex_count = mesh->vertex_count,
                                        .face_count = mesh->face_count,
                                        .corner_count = mesh->corner_count,
                                        .corner_vertices = mesh->corner_vertices,
                                        .twins = pairs->next_side};
    mt_status status = describe_faces(context, mesh, topology);
    if (status == MT_OK) {
        status = rank_edges(context, topology);
    }
    if (status == MT_OK) {
        status = mt_subdivide_find_vertex_corners(context, topology);
    }
    if (status != MT_OK) {
        mt_subdivide_topology_release(context, topology);
    }
    return status;
}

/* Whether both ends of an edge have the same values on both sides. */
static bool is_whole(const mt_index *indices, mt_index corner, mt_index next, mt_index twin, mt_index twin_next)
{
    return indices[corner] == indices[twin_next] && indices[next] == indices[twin];
}

/* The twin for the values: none across a seam, nor where a value is missing. */
static mt_index value_twin(const mt_index *indices, mt_index corner, mt_index next, mt_index twin, mt_index twin_next)
{
    bool given = indices[corner] != MT_NONE && indices[next] != MT_NONE;
    return given && is_whole(indices, corner, next, twin, twin_next) ? twin : corner;
}

typedef struct value_job {
    const mt_subdivide_topology *base;
    const mt_index *indices;
    mt_index *twins;
    mt_index *corner_vertices; /* NULL when the indices serve, every corner having a value */
} value_job;

MT_SUBDIVIDE_INLINE void link_values(const value_job *job, uint64_t begin, uint64_t end, unsigned sides)
{
    const mt_subdivide_topology *base = job->base;
    for (mt_index corner = (mt_index)begin; corner < end; corner++) {
        mt_index twin = base->twins[corner];
        job->twins[corner] = value_twin(job->indices, corner, mt_subdivide_next(base, corner, sides), twin,
                                        mt_subdivide_next(base, twin, sides));
        if (job->corner_vertices) {
            job->corner_vertices[corner] = job->indices[corner] == MT_NONE ? 0 : job->indices[corner];
        }
    }
}

static void link_values_of_corners(void *user, uint64_t begin, uint64_t end)
{
    const value_job *job = user;
    switch (job->base->face_size) {
    case 3:
        link_values(job, begin, end, 3);
        break;
    case 4:
        link_values(job, begin, end, 4);
        break;
    default:
        link_values(job, begin, end, 0);
        break;
    }
}

static bool misses_values(const mt_attribute *attribute, mt_index corner_count)
{
    for (mt_index corner = 0; corner < corner_count; corner++) {
        if (attribute->indices[corner] == MT_NONE) {
            return true;
        }
    }
    return false;
}

mt_status mt_subdivide_topology_of_values(mt_context *context, const mt_subdivide_topology *base,
                                          const mt_attribute *attribute, mt_subdivide_topology *topology)
{
    *topology = (mt_subdivide_topology){.vertex_count = attribute->value_count,
                                        .face_count = base->face_count,
                                        .corner_count = base->corner_count,
                                        .scheme = base->scheme,
                                        .face_size = base->face_size,
                                        .face_offsets = base->face_offsets,
                                        .corner_faces = base->corner_faces};
    value_job job = {.base = base, .indices = attribute->indices};
    bool misses = misses_values(attribute, base->corner_count);
    topology->owned[1] = job.twins = mt_allocate_array(context, base->corner_count, sizeof(mt_index));
    if (misses) {
        topology->owned[2] = job.corner_vertices = mt_allocate_array(context, base->corner_count, sizeof(mt_index));
    }
    mt_status status = job.twins && (job.corner_vertices || !misses) ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        mt_parallel_for(context, base->corner_count, RANK_GRAIN, link_values_of_corners, &job);
        topology->twins = job.twins;
        topology->corner_vertices = misses ? job.corner_vertices : attribute->indices;
        status = rank_edges(context, topology);
    }
    if (status != MT_OK) {
        mt_subdivide_topology_release(context, topology);
    }
    return status;
}

static mt_index next_in_face(const mt_mesh *mesh, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    return corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
}

/* Sides of an edge besides its first and last. */
static mt_index count_between(const mt_edge_pairs *pairs, mt_index first)
{
    mt_index count = 0;
    for (mt_index side = pairs->next_side[pairs->next_side[first]]; side != first; side = pairs->next_side[side]) {
        count++;
    }
    return count;
}

mt_index mt_subdivide_seam_count(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_attribute *attribute,
                                 bool missing_is_one)
{
    mt_index count = 0;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index twin = pairs->next_side[corner];
        if (twin == MT_NONE || twin <= corner) {
            continue;
        }
        mt_index next = next_in_face(mesh, corner), twin_next = next_in_face(mesh, twin);
        mt_index between = count_between(pairs, corner);
        bool whole = missing_is_one ? is_whole(attribute->indices, corner, next, twin, twin_next)
                                    : value_twin(attribute->indices, corner, next, twin, twin_next) == twin;
        count += between ? between + 1 : !whole;
    }
    return count;
}
