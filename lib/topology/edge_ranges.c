/* Edge pairing by ranges of lower vertices.
 *
 * First the sides are dealt to ranges, block of faces by block, so that each range's sides stand in corner order
 * whoever dealt them. Then each range is paired on its own, in cache: a counting sort deals its sides to vertices and,
 * among one vertex's sides, those that leave it before those that reach it; the few sides of a vertex are compared
 * with each other, many are sorted (edge_bucket.c).
 *
 * Cost: O(vertices + corners) time; 12 bytes a corner while it runs. Reading and dealing is sequential, whatever the
 * order of the faces; only the result is scattered. Known weakness: a vertex of very high valence makes one long range
 * that one thread must take alone. */
#include "lib/topology/edge_ranges.h"
#include "lib/topology/edge_bucket.h"

#include <string.h>

#define FACES_PER_BLOCK 32768
#define RANGE_SHIFT_MINIMUM 11   /* some 12000 sides a range: they and their counters fit the second-level cache */
#define RANGE_COUNT_MAXIMUM 1024 /* one cache line written to for each */
#define RANGES_PER_TASK 4
#define LOOK_AHEAD 48 /* sides whose places in the result memory is given time to fetch */

/* A side dealt to its range: the vertex within the range and whether the side reaches it (1) or leaves it (0). */
typedef struct ranged_side {
    mt_index key; /* 2 * (lower - first of range) + reaches */
    edge_side side;
} ranged_side;

typedef struct pairing {
    mt_context *context;
    const mt_mesh *mesh;
    mt_edge_pairs *pairs;
    unsigned range_shift;
    mt_index range_count;
    mt_index block_count;
    mt_index *cursors;      /* block_count * range_count: counts, then where the block's next side goes */
    mt_index *range_begins; /* range_count + 1 */
    ranged_side *sides;
    edge_tally *tallies; /* per range */
    bool *failed;        /* per task, when it got no memory */
} pairing;

static mt_index block_end(const pairing *job, mt_index block)
{
    uint64_t end = ((uint64_t)block + 1) * FACES_PER_BLOCK;
    return end < job->mesh->face_count ? (mt_index)end : job->mesh->face_count;
}

static void count_side(mt_index *cursors, unsigned shift, mt_index a, mt_index b)
{
    if (a != b) {
        cursors[(a < b ? a : b) >> shift]++;
    }
}

static void count_block(const pairing *job, mt_index block)
{
    const mt_mesh *mesh = job->mesh;
    mt_index *cursors = job->cursors + (size_t)block * job->range_count;
    memset(cursors, 0, job->range_count * sizeof *cursors);
    mt_index end = block_end(job, block);
    for (mt_index face = block * FACES_PER_BLOCK; face < end; face++) {
        const mt_index *vertex = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
        mt_index sides = mt_mesh_face_sides(mesh, face);
        mt_index previous = vertex[sides - 1];
        for (mt_index i = 0; i < sides; i++) {
            count_side(cursors, job->range_shift, previous, vertex[i]);
            previous = vertex[i];
        }
    }
}

static void count_blocks(void *user, uint64_t begin, uint64_t end)
{
    for (uint64_t block = begin; block < end; block++) {
        count_block(user, (mt_index)block);
    }
}

/* Counts become places: by range, then by block, so that a range's sides stand in corner order. */
static mt_index place_blocks(pairing *job)
{
    mt_index at = 0;
    for (mt_index range = 0; range < job->range_count; range++) {
        job->range_begins[range] = at;
        for (mt_index block = 0; block < job->block_count; block++) {
            mt_index *cursor = &job->cursors[(size_t)block * job->range_count + range];
            mt_index count = *cursor;
            *cursor = at;
            at += count;
        }
    }
    job->range_begins[job->range_count] = at;
    return at;
}

static void deal_side(const pairing *job, mt_index *cursors, mt_index a, mt_index b, mt_index corner)
{
    if (a == b) {
        job->pairs->next_side[corner] = MT_NONE;
        return;
    }
    bool reaches = b < a;
    mt_index lower = reaches ? b : a;
    mt_index mask = ((mt_index)1 << job->range_shift) - 1;
    ranged_side *to = &job->sides[cursors[lower >> job->range_shift]++];
    to->key = 2 * (lower & mask) + reaches;
    to->side.other = reaches ? a : b;
    to->side.corner = corner;
}

static void deal_blocks(void *user, uint64_t begin, uint64_t end)
{
    const pairing *job = user;
    const mt_mesh *mesh = job->mesh;
    for (mt_index block = (mt_index)begin; block < end; block++) {
        mt_index *cursors = job->cursors + (size_t)block * job->range_count;
        mt_index last = block_end(job, block);
        for (mt_index face = block * FACES_PER_BLOCK; face < last; face++) {
            mt_index corner = mt_mesh_face_begin(mesh, face);
            const mt_index *vertex = mesh->corner_vertices + corner;
            mt_index sides = mt_mesh_face_sides(mesh, face);
            for (mt_index i = 0; i + 1 < sides; i++) {
                deal_side(job, cursors, vertex[i], vertex[i + 1], corner + i);
            }
            deal_side(job, cursors, vertex[sides - 1], vertex[0], corner + sides - 1);
        }
    }
}

/* Memory that a task uses for one range after the other. */
typedef struct range_scratch {
    mt_index *ends; /* per key of the range, where its sides end */
    edge_side *sides;
    edge_side *spare;
} range_scratch;

static mt_index range_vertex_count(const pairing *job, mt_index range)
{
    uint64_t first = (uint64_t)range << job->range_shift;
    uint64_t left = job->mesh->vertex_count - first;
    uint64_t whole = (uint64_t)1 << job->range_shift;
    return (mt_index)(left < whole ? left : whole);
}

/* Counting sort by key; ends[key] becomes where the key's sides end. */
static void deal_to_vertices(const ranged_side *from, mt_index count, mt_index key_count, mt_index *ends, edge_side *to)
{
    memset(ends, 0, key_count * sizeof *ends);
    for (mt_index i = 0; i < count; i++) {
        ends[from[i].key]++;
    }
    mt_index at = 0;
    for (mt_index key = 0; key < key_count; key++) {
        mt_index here = ends[key];
        ends[key] = at;
        at += here;
    }
    for (mt_index i = 0; i < count; i++) {
        to[ends[from[i].key]++] = from[i].side;
    }
}

/* Asks for what will be written for these sides: with faces in a random order, places far apart. */
static void look_ahead(const mt_index *next_side, const edge_side *sides, mt_index begin, mt_index end)
{
    for (mt_index i = begin; i < end; i++) {
        __builtin_prefetch(&next_side[sides[i].corner], 1);
    }
}

static void pair_range(const pairing *job, mt_index range, const range_scratch *scratch)
{
    mt_index begin = job->range_begins[range];
    mt_index count = job->range_begins[range + 1] - begin;
    mt_index vertex_count = range_vertex_count(job, range);
    deal_to_vertices(job->sides + begin, count, 2 * vertex_count, scratch->ends, scratch->sides);
    mt_index *next_side = job->pairs->next_side;
    edge_tally tally = {0};
    mt_index at = 0, ahead = 0;
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        mt_index end = scratch->ends[2 * vertex + 1];
        mt_index up_count = scratch->ends[2 * vertex] - at;
        mt_index wanted = count - end > LOOK_AHEAD ? end + LOOK_AHEAD : count;
        look_ahead(next_side, scratch->sides, ahead, wanted);
        ahead = wanted;
        mt_edge_bucket_link(scratch->sides + at, up_count, end - at, scratch->spare, next_side, &tally);
        at = end;
    }
    job->tallies[range] = tally;
}

static bool make_scratch(const pairing *job, uint64_t begin, uint64_t end, range_scratch *scratch)
{
    uint64_t most = 0;
    for (uint64_t range = begin; range < end; range++) {
        uint64_t count = job->range_begins[range + 1] - job->range_begins[range];
        most = count > most ? count : most;
    }
    uint64_t key_count = 2 * (uint64_t)range_vertex_count(job, (mt_index)begin);
    scratch->ends = mt_try_allocate(job->context, key_count * sizeof *scratch->ends);
    scratch->sides = mt_try_allocate(job->context, most * sizeof *scratch->sides);
    scratch->spare = mt_try_allocate(job->context, most * sizeof *scratch->spare);
    return scratch->ends && scratch->sides && scratch->spare;
}

static void pair_ranges(void *user, uint64_t begin, uint64_t end)
{
    const pairing *job = user;
    range_scratch scratch = {0};
    if (make_scratch(job, begin, end, &scratch)) {
        for (mt_index range = (mt_index)begin; range < end; range++) {
            pair_range(job, range, &scratch);
        }
    } else {
        job->failed[begin / RANGES_PER_TASK] = true;
    }
    mt_free(job->context, scratch.ends);
    mt_free(job->context, scratch.sides);
    mt_free(job->context, scratch.spare);
}

static void choose_ranges(pairing *job)
{
    uint64_t vertex_count = job->mesh->vertex_count;
    job->range_shift = RANGE_SHIFT_MINIMUM;
    while (vertex_count >> job->range_shift >= RANGE_COUNT_MAXIMUM) {
        job->range_shift++;
    }
    job->range_count = (mt_index)(vertex_count >> job->range_shift) + 1;
    if (((uint64_t)(job->range_count - 1) << job->range_shift) == vertex_count) {
        job->range_count--;
    }
    job->block_count = (mt_index)(((uint64_t)job->mesh->face_count + FACES_PER_BLOCK - 1) / FACES_PER_BLOCK);
}

static mt_status check_tasks(const pairing *job)
{
    for (mt_index task = 0; task * RANGES_PER_TASK < job->range_count; task++) {
        if (job->failed[task]) {
            return mt_fail(job->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while pairing the edges of %u faces",
                           job->mesh->face_count);
        }
    }
    return MT_OK;
}

static mt_status run_stages(pairing *job)
{
    mt_context *context = job->context;
    mt_parallel_for(context, job->block_count, 1, count_blocks, job);
    mt_index side_count = place_blocks(job);
    job->sides = mt_allocate_array(context, side_count, sizeof *job->sides);
    if (!job->sides) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, job->block_count, 1, deal_blocks, job);
    mt_status status = mt_progress(context, "pairing edges", 0.5);
    if (status != MT_OK) {
        return status;
    }
    mt_parallel_for(context, job->range_count, RANGES_PER_TASK, pair_ranges, job);
    return check_tasks(job);
}

mt_status mt_edge_ranges_pair(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally)
{
    pairing job = {.context = context, .mesh = mesh, .pairs = pairs};
    choose_ranges(&job);
    uint64_t cursor_count = (uint64_t)job.block_count * job.range_count;
    job.cursors = mt_allocate_array(context, cursor_count, sizeof *job.cursors);
    job.range_begins = mt_allocate_array(context, (uint64_t)job.range_count + 1, sizeof *job.range_begins);
    job.tallies = mt_allocate_array_zeroed(context, job.range_count, sizeof *job.tallies);
    job.failed = mt_allocate_array_zeroed(context, job.range_count, sizeof *job.failed);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.cursors && job.range_begins && job.tallies && job.failed) {
        status = run_stages(&job);
        for (mt_index range = 0; range < job.range_count; range++) {
            edge_tally_add(tally, &job.tallies[range]);
        }
    }
    mt_free(context, job.sides);
    mt_free(context, job.failed);
    mt_free(context, job.tallies);
    mt_free(context, job.range_begins);
    mt_free(context, job.cursors);
    return status;
}
