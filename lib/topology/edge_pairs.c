/* Edge pairing: by one pass of chains over the faces where those are near each other in memory, else by ranges. Both
 * give the same result: which sides lie on an edge, in ascending order, does not depend on how they were found.
 *
 * Cost: O(vertices + corners) time, 12 bytes a corner while it runs. */
#include "lib/topology/edge_chain.h"
#include "lib/topology/edge_ranges.h"

#include <string.h>

/* With more threads than this, ranges are faster for every mesh. */
#define CHAIN_THREADS 2

/* Meshes of fewer corners fit the cache whatever their order. */
#define SMALL_CORNER_COUNT 100000

/* Windows of the list of corners that are looked at to judge its order. */
#define WINDOW_COUNT 16
#define WINDOW_SIZE 4096

/* The cache that is pretended while looking: lines of 16 vertices. */
#define LINE_SHIFT 4
#define LINE_COUNT 512

/* How many of a window's corners name a vertex whose line was touched shortly before. */
static mt_index count_hits(const mt_index *corner_vertices)
{
    mt_index lines[LINE_COUNT];
    memset(lines, 0xff, sizeof lines);
    mt_index hits = 0;
    for (mt_index c = 0; c < WINDOW_SIZE; c++) {
        mt_index line = corner_vertices[c] >> LINE_SHIFT;
        hits += lines[line % LINE_COUNT] == line;
        lines[line % LINE_COUNT] = line;
    }
    return hits;
}

/* Whether faces that follow each other mostly name the same vertices and their neighbours. */
static bool is_local(const mt_mesh *mesh)
{
    if (mesh->corner_count < SMALL_CORNER_COUNT) {
        return true;
    }
    mt_index stride = mesh->corner_count / WINDOW_COUNT;
    mt_index hits = 0;
    for (mt_index window = 0; window < WINDOW_COUNT; window++) {
        hits += count_hits(mesh->corner_vertices + (size_t)window * stride);
    }
    return hits > WINDOW_COUNT * WINDOW_SIZE / 4 * 3;
}

static inline __attribute__((always_inline)) void add_side(edge_chains *chains, mt_index a, mt_index b, mt_index corner)
{
    if (a != b) {
        edge_chain_add(chains, a < b ? a : b, a < b ? b : a, a, corner);
    } else {
        chains->next_side[corner] = MT_NONE;
    }
}

static inline __attribute__((always_inline)) void add_face(edge_chains *chains, const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    mt_index end = mt_mesh_face_end(mesh, face);
    const mt_index *vertices = mesh->corner_vertices;
    if (end - begin == 3) {
        add_side(chains, vertices[begin], vertices[begin + 1], begin);
        add_side(chains, vertices[begin + 1], vertices[begin + 2], begin + 1);
        add_side(chains, vertices[begin + 2], vertices[begin], begin + 2);
        return;
    }
    for (mt_index c = begin; c < end; c++) {
        add_side(chains, vertices[c], vertices[c + 1 < end ? c + 1 : begin], c);
    }
}

/* False, with the result incomplete, when the chains grew long. A local copy lives in registers, which stores to
 * the lists cannot touch. */
static bool add_faces(edge_chains *chains, const mt_mesh *mesh)
{
    edge_chains local = *chains;
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    mt_index face = 0;
    for (; face < mesh->face_count && local.steps <= step_limit; face++) {
        add_face(&local, mesh, face);
    }
    *chains = local;
    return face == mesh->face_count;
}

static mt_status pair_by_chains(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally,
                                bool *done)
{
    edge_chains chains = {.next_side = pairs->next_side, .corner_vertices = mesh->corner_vertices};
    chains.heads = mt_allocate_array(context, mesh->vertex_count, sizeof *chains.heads);
    chains.entries = mt_allocate_array(context, mesh->corner_count, sizeof *chains.entries);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (chains.heads && chains.entries) {
        memset(chains.heads, 0xff, mesh->vertex_count * sizeof *chains.heads);
        *done = add_faces(&chains, mesh);
        tally->regular = chains.regular;
        tally->misoriented = chains.misoriented;
        tally->non_manifold = chains.non_manifold;
        tally->boundary = chains.entry_count - chains.regular - chains.misoriented - chains.non_manifold;
        status = MT_OK;
    }
    mt_free(context, chains.heads);
    mt_free(context, chains.entries);
    return status;
}

static mt_status find_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally)
{
    bool done = false;
    if (mt_context_thread_count(context) <= CHAIN_THREADS && is_local(mesh)) {
        mt_status status = pair_by_chains(context, mesh, pairs, tally, &done);
        if (status != MT_OK || done) {
            return status;
        }
    }
    *tally = (edge_tally){0};
    return mt_edge_ranges_pair(context, mesh, pairs, tally);
}

static mt_index count_degenerate_sides(const mt_edge_pairs *pairs)
{
    mt_index count = 0;
    for (mt_index c = 0; c < pairs->corner_count; c++) {
        count += pairs->next_side[c] == MT_NONE;
    }
    return count;
}

static mt_status pair_edges(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs)
{
    edge_tally tally = {0};
    mt_status status = find_pairs(context, mesh, pairs, &tally);
    if (status == MT_OK) {
        pairs->boundary_count = tally.boundary;
        pairs->regular_count = tally.regular;
        pairs->misoriented_count = tally.misoriented;
        pairs->non_manifold_count = tally.non_manifold;
        pairs->edge_count = tally.boundary + tally.regular + tally.misoriented + tally.non_manifold;
        pairs->degenerate_side_count = count_degenerate_sides(pairs);
    }
    return status;
}

mt_status mt_edge_pairs_create(mt_context *context, const mt_mesh *mesh, mt_edge_pairs **out)
{
    *out = NULL;
    int part = mt_part_begin(context, "edge pairs", "which sides share an edge");
    mt_edge_pairs *pairs = mt_allocate_zeroed(context, sizeof *pairs);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (pairs) {
        pairs->corner_count = mesh->corner_count;
        pairs->next_side = mt_allocate_array(context, mesh->corner_count, sizeof *pairs->next_side);
        status = pairs->next_side ? pair_edges(context, mesh, pairs) : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        *out = pairs;
    } else {
        mt_edge_pairs_destroy(context, pairs);
    }
    mt_part_end(context, part);
    return status;
}

void mt_edge_pairs_destroy(mt_context *context, mt_edge_pairs *pairs)
{
    if (pairs) {
        mt_free(context, pairs->next_side);
        mt_free(context, pairs);
    }
}
