/* Pairing by chains. With two threads each takes the edges whose higher vertex is on its side of a cut: both read all
 * faces, which is cheap beside looking for edges, and neither touches what the other writes. Which sides lie on an edge
 * does not depend on the cut, so it may come from a sample.
 *
 * Cost: O(vertices + corners) time as long as the lists stay short, else it stops; 12 bytes a corner while it runs. */
#include "lib/topology/chain_pairs.h"
#include "lib/topology/edge_chain.h"

#include <string.h>

#define RANGES_MAXIMUM 2
#define RANGE_CORNERS 30000 /* below, a second thread takes longer to wake than to help */

#define BLOCK_FACES 64 /* looked at together: most blocks concern only one range */

/* Of the higher vertices of sampled sides. */
#define BIN_COUNT 256
#define SAMPLE_COUNT 4096

/* What a pass over the faces carries along. */
typedef struct chain_pairing {
    edge_chains chains;
    mt_index room;         /* entries of the chains */
    mt_index begin, count; /* the higher vertices whose edges it pairs */
    mt_index *next_side;
    const mt_index *corner_vertices;
    mt_index regular, misoriented, non_manifold, degenerate;
} chain_pairing;

typedef struct chain_job {
    const mt_mesh *mesh;
    chain_pairing ranges[RANGES_MAXIMUM];
    bool done[RANGES_MAXIMUM];
    mt_index range_count;
} chain_job;

/* Hangs a further side into the ring of its edge. Sides come in the order of corners, so rings descend by themselves.
 */
MT_ALWAYS_INLINE void extend_ring(chain_pairing *pairing, mt_index first, mt_index tail, mt_index corner)
{
    mt_index *next_side = pairing->next_side;
    mt_index last = next_side[first];
    mt_index same = pairing->corner_vertices[first] == tail;
    if (first == last) {
        pairing->misoriented += same;
        pairing->regular += 1 - same;
    } else if (next_side[last] == first) {
        mt_index was_same = pairing->corner_vertices[first] == pairing->corner_vertices[last];
        pairing->misoriented -= was_same;
        pairing->regular -= 1 - was_same;
        pairing->non_manifold++;
    }
    next_side[first] = corner;
    next_side[corner] = last;
}

MT_ALWAYS_INLINE void add_side(chain_pairing *pairing, mt_index tail, mt_index head, mt_index corner, bool whole)
{
    mt_index lower = tail < head ? tail : head, higher = tail < head ? head : tail;
    if (!whole && higher - pairing->begin >= pairing->count) {
        return;
    }
    if (tail == head) {
        pairing->next_side[corner] = MT_NONE;
        pairing->degenerate++;
        return;
    }
    mt_index count = pairing->chains.entry_count;
    mt_index edge = edge_chain_find(&pairing->chains, lower, higher);
    chain_entry *entry = &pairing->chains.entries[edge];
    if (edge == count) {
        entry->note = corner;
        pairing->next_side[corner] = corner;
    } else {
        extend_ring(pairing, entry->note, tail, corner);
    }
}

MT_ALWAYS_INLINE void add_face(chain_pairing *pairing, const mt_mesh *mesh, mt_index face, bool whole)
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    mt_index end = mt_mesh_face_end(mesh, face);
    const mt_index *vertices = mesh->corner_vertices;
    if (end - begin == 3) {
        add_side(pairing, vertices[begin], vertices[begin + 1], begin, whole);
        add_side(pairing, vertices[begin + 1], vertices[begin + 2], begin + 1, whole);
        add_side(pairing, vertices[begin + 2], vertices[begin], begin + 2, whole);
        return;
    }
    for (mt_index c = begin; c < end; c++) {
        add_side(pairing, vertices[c], vertices[c + 1 < end ? c + 1 : begin], c, whole);
    }
}

/* Whether a side of a block of corners may have its higher vertex in the range. */
static bool concerns_range(const chain_pairing *pairing, const mt_index *vertices, mt_index count)
{
    mt_index lowest = MT_NONE, highest = 0;
    for (mt_index i = 0; i < count; i++) {
        lowest = vertices[i] < lowest ? vertices[i] : lowest;
        highest = vertices[i] > highest ? vertices[i] : highest;
    }
    return highest >= pairing->begin && lowest < (uint64_t)pairing->begin + pairing->count;
}

/* False when there may be too little room. */
MT_ALWAYS_INLINE bool add_block(chain_pairing *pairing, const mt_mesh *mesh, mt_index face, mt_index end, bool whole)
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    mt_index corner_count = mt_mesh_face_begin(mesh, end) - begin;
    if (!whole && !concerns_range(pairing, mesh->corner_vertices + begin, corner_count)) {
        return true;
    }
    if (pairing->room - pairing->chains.entry_count < corner_count) {
        return false;
    }
    for (; face < end; face++) {
        add_face(pairing, mesh, face, whole);
    }
    return true;
}

/* False, with the result incomplete, when the chains grew long or too many. A local copy lives in registers, which
 * stores to the lists cannot touch. */
MT_ALWAYS_INLINE bool add_faces(chain_pairing *pairing, const mt_mesh *mesh, bool whole)
{
    chain_pairing local = *pairing;
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    mt_index face = 0;
    while (face < mesh->face_count && local.chains.steps <= step_limit) {
        mt_index end = mesh->face_count - face > BLOCK_FACES ? face + BLOCK_FACES : mesh->face_count;
        if (!add_block(&local, mesh, face, end, whole)) {
            break;
        }
        face = end;
    }
    *pairing = local;
    return face == mesh->face_count;
}

static void pair_ranges(void *user, uint64_t begin, uint64_t end)
{
    chain_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        chain_pairing *range = &job->ranges[i];
        memset(range->chains.heads + range->begin, 0xff, range->count * sizeof *range->chains.heads);
        bool whole = job->range_count == 1;
        job->done[i] = whole ? add_faces(range, job->mesh, true) : add_faces(range, job->mesh, false);
    }
}

static mt_index higher_vertex(const mt_mesh *mesh, mt_index corner)
{
    mt_index a = mesh->corner_vertices[corner], b = mesh->corner_vertices[corner + 1];
    return a > b ? a : b;
}

/* A vertex with about as many sides below it as above, by where their higher ends lie. */
static mt_index choose_cut(const mt_mesh *mesh)
{
    mt_index bins[BIN_COUNT] = {0};
    mt_index stride = mesh->corner_count / SAMPLE_COUNT;
    mt_index width = mesh->vertex_count / BIN_COUNT + 1;
    for (mt_index i = 0; i < SAMPLE_COUNT; i++) {
        bins[higher_vertex(mesh, i * stride) / width]++;
    }
    mt_index bin = 0;
    for (mt_index below = 0; below < SAMPLE_COUNT / 2; bin++) {
        below += bins[bin];
    }
    uint64_t cut = (uint64_t)bin * width;
    return cut < mesh->vertex_count ? (mt_index)cut : mesh->vertex_count;
}

/* Deals heads and entries to the ranges. */
static void prepare_ranges(chain_job *job, const edge_chains *chains, mt_index room, mt_index *next_side)
{
    const mt_mesh *mesh = job->mesh;
    mt_index cut = job->range_count == 1 ? mesh->vertex_count : choose_cut(mesh);
    for (mt_index i = 0; i < job->range_count; i++) {
        chain_pairing *range = &job->ranges[i];
        *range = (chain_pairing){.room = room, .next_side = next_side, .corner_vertices = mesh->corner_vertices};
        range->chains.heads = chains->heads;
        range->chains.entries = chains->entries + (size_t)i * room;
        range->begin = i ? cut : 0;
        range->count = i ? mesh->vertex_count - cut : cut;
    }
}

static void sum_ranges(const chain_job *job, mt_edge_pairs *pairs, edge_tally *tally)
{
    for (mt_index i = 0; i < job->range_count; i++) {
        const chain_pairing *range = &job->ranges[i];
        mt_index shared = range->regular + range->misoriented + range->non_manifold;
        edge_tally own = {range->chains.entry_count - shared, range->regular, range->misoriented, range->non_manifold};
        edge_tally_add(tally, &own);
        pairs->degenerate_side_count += range->degenerate;
    }
}

mt_status mt_chain_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally, bool *done)
{
    chain_job job = {.mesh = mesh, .range_count = 1};
    if (mt_context_thread_count(context) > 1 && mesh->corner_count >= RANGE_CORNERS) {
        job.range_count = 2;
    }
    /* With room for half of all corners a range of a soup may fall short, and then stops. */
    mt_index room = job.range_count == 1 ? mesh->corner_count : (mt_index)edge_chain_room(mesh);
    edge_chains chains = {0};
    chains.heads = mt_allocate_array(context, mesh->vertex_count, sizeof *chains.heads);
    chains.entries = mt_allocate_array(context, (uint64_t)room * job.range_count, sizeof *chains.entries);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (chains.heads && chains.entries) {
        prepare_ranges(&job, &chains, room, pairs->next_side);
        mt_parallel_for(context, job.range_count, 1, pair_ranges, &job);
        *done = job.done[0] && (job.range_count == 1 || job.done[1]);
        if (*done) {
            sum_ranges(&job, pairs, tally);
        }
        status = MT_OK;
    } else {
        status = mt_context_error(context)->status;
    }
    mt_edge_chains_release(context, &chains);
    return status;
}
