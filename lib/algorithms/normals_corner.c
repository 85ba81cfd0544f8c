/* Normals of corners. Blocks of vertices find those of their corners (normals_crease.c), keep one of each that differ
 * at a vertex and number them within the block; then all are put behind each other. Cost: as normals_crease.c says; 32
 * bytes a corner of the blocks at work meanwhile. */
#include "lib/algorithms/normals_crease.h"
#include "lib/algorithms/normals_face.h"

#include <meshtool/elementary.h>

#include <string.h>

#define VERTEX_BLOCK 4096

/* A corner at a vertex of many looks for its value among so many last ones. */
#define VALUES_COMPARED 64

/* How far a cosine must be exceeded, so that faces that meet at exactly the crease angle have a crease between them
 * whatever the rounding of their positions; larger would move an angle of 10 degrees by more than 1e-11 and 1e-5 of a
 * radian. */
#define COSINE_MARGIN_F64 0x1p-40
#define COSINE_MARGIN_F32 0x1p-20

/* What a block of vertices found. */
typedef struct value_block {
    mt_vec3 *values;
    mt_index count, first;
    bool failed;
} value_block;

typedef struct corner_job {
    mt_normals_job *job;
    mt_normal_rings rings;
    double limit;
    value_block *blocks;
} corner_job;

static bool is_same(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Numbers the values of one vertex from `first` on; returns the next number. */
static mt_index number_values(const mt_crease_star *star, mt_vec3 *values, mt_index first, mt_index *indices,
                              mt_index *undefined)
{
    mt_index count = first;
    for (mt_index i = 0; i < star->count; i++) {
        mt_vec3 n = star->corners[i].normal;
        mt_index least = count - first > VALUES_COMPARED ? count - VALUES_COMPARED : first, at = count;
        while (at > least && !is_same(values[at - 1], n)) {
            at--;
        }
        if (at == least) {
            values[count] = n;
            at = ++count;
        }
        indices[star->corners[i].corner] = at - 1;
        *undefined += mt_vector_is_zero(n);
    }
    return count;
}

static void solve_vertices(const corner_job *corners, mt_crease_star *star, mt_index begin, mt_index end,
                           value_block *block)
{
    mt_index undefined = 0;
    for (mt_index vertex = begin; vertex < end; vertex++) {
        mt_crease_star_solve(star, &corners->rings, vertex);
        block->count = number_values(star, block->values, block->count, corners->job->values->indices, &undefined);
    }
    mt_count_undefined(corners->job, undefined);
}

static mt_index most_corners(const mt_normal_rings *rings, mt_index begin, mt_index end)
{
    mt_index most = 0;
    for (mt_index vertex = begin; vertex < end; vertex++) {
        mt_index count = rings->begins[vertex + 1] - rings->begins[vertex];
        most = count > most ? count : most;
    }
    return most;
}

/* Most vertices have one value, so that the room for one a corner is soon given back. */
static void keep_values(mt_context *context, value_block *block)
{
    mt_vec3 *kept = mt_try_allocate(context, block->count * sizeof *kept);
    if (kept) {
        memcpy(kept, block->values, block->count * sizeof *kept);
    }
    mt_free(context, block->values);
    block->values = kept;
    block->failed = !kept;
}

static void solve_block(void *user, uint64_t begin, uint64_t end)
{
    const corner_job *corners = user;
    mt_context *context = corners->job->context;
    const mt_normal_rings *rings = &corners->rings;
    value_block *block = &corners->blocks[begin / VERTEX_BLOCK];
    mt_crease_star star;
    mt_index corner_count = rings->begins[end] - rings->begins[begin];
    bool has_room = mt_crease_star_init(context, most_corners(rings, (mt_index)begin, (mt_index)end), &star);
    block->values = has_room ? mt_try_allocate(context, corner_count * sizeof *block->values) : NULL;
    block->failed = !block->values;
    if (block->values) {
        star.limit = corners->limit;
        star.reachable_only = corners->job->options.reachable_only;
        solve_vertices(corners, &star, (mt_index)begin, (mt_index)end, block);
        keep_values(context, block);
    }
    mt_crease_star_release(context, &star);
}

static void store_block(void *user, uint64_t begin, uint64_t end)
{
    const corner_job *corners = user;
    const value_block *block = &corners->blocks[begin / VERTEX_BLOCK];
    mt_attribute *to = corners->job->values;
    for (mt_index i = 0; i < block->count; i++) {
        mt_store_normal(to->values, to->type, block->first + i, block->values[i]);
    }
    for (mt_index i = corners->rings.begins[begin]; i < corners->rings.begins[end]; i++) {
        to->indices[corners->rings.corners[i]] += block->first;
    }
}

static mt_status place_blocks(corner_job *corners, size_t block_count)
{
    mt_context *context = corners->job->context;
    mt_attribute *to = corners->job->values;
    mt_index total = 0;
    for (size_t i = 0; i < block_count; i++) {
        if (corners->blocks[i].failed) {
            return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory left for the normals of corners");
        }
        corners->blocks[i].first = total;
        total += corners->blocks[i].count;
    }
    void *values = mt_allocate_array(context, total, 3 * mt_type_size(to->type));
    if (!values) {
        return mt_context_error(context)->status;
    }
    mt_free(context, to->values);
    to->values = values;
    to->value_count = total;
    mt_parallel_for(context, corners->rings.mesh->vertex_count, VERTEX_BLOCK, store_block, corners);
    return MT_OK;
}

static mt_status solve(corner_job *corners)
{
    mt_context *context = corners->job->context;
    uint64_t vertex_count = corners->rings.mesh->vertex_count;
    size_t block_count = (size_t)((vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK);
    corners->blocks = mt_allocate_array_zeroed(context, block_count, sizeof *corners->blocks);
    if (!corners->blocks) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, vertex_count, VERTEX_BLOCK, solve_block, corners);
    mt_status status = place_blocks(corners, block_count);
    for (size_t i = 0; i < block_count; i++) {
        mt_free(context, corners->blocks[i].values);
    }
    mt_free(context, corners->blocks);
    return status;
}

static double cosine_limit(const mt_mesh *mesh, double angle)
{
    double margin = mesh->position_type == MT_F64 ? COSINE_MARGIN_F64 : COSINE_MARGIN_F32;
    return angle < 0 ? 2 : mt_cos(angle) + margin;
}

mt_status mt_normals_of_corners(mt_normals_job *job)
{
    corner_job corners = {.job = job, .limit = cosine_limit(job->mesh, job->options.crease_angle)};
    mt_status status = mt_normal_rings_init(job, &corners.rings);
    if (status == MT_OK) {
        status = solve(&corners);
        mt_normal_rings_release(job->context, &corners.rings);
    }
    return status;
}
