/* Edge pairing: by one pass of chains over the faces where those are near each other in memory, else by ranges. Both
 * give the same result: which sides lie on an edge, in ascending order, does not depend on how they were found.
 *
 * Cost: O(vertices + corners) time, 12 bytes a corner while it runs. */
#include "lib/topology/chain_pairs.h"
#include "lib/topology/edge_chain.h"
#include "lib/topology/edge_ranges.h"

/* With more threads than this, ranges are faster for every mesh. */
#define CHAIN_THREADS 2

static mt_index count_degenerate_sides(const mt_edge_pairs *pairs)
{
    mt_index count = 0;
    for (mt_index c = 0; c < pairs->corner_count; c++) {
        count += pairs->next_side[c] == MT_NONE;
    }
    return count;
}

static mt_status find_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally)
{
    bool done = false;
    if (mt_context_thread_count(context) <= CHAIN_THREADS && mt_edge_chains_suit(mesh)) {
        mt_status status = mt_chain_pairs(context, mesh, pairs, tally, &done);
        if (status != MT_OK || done) {
            return status;
        }
    }
    mt_status status = mt_edge_ranges_pair(context, mesh, pairs, tally);
    pairs->degenerate_side_count = count_degenerate_sides(pairs);
    return status;
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

mt_index mt_edge_faces(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first, mt_index room, mt_index *faces)
{
    mt_index count = 1;
    for (mt_index c = pairs->next_side[first]; c != first; c = pairs->next_side[c]) {
        count++;
    }
    mt_index c = first;
    for (mt_index rank = count; rank-- > 0;) {
        c = pairs->next_side[c];
        if (rank < room) {
            faces[rank] = mt_mesh_corner_face(mesh, c);
        }
    }
    return count;
}
