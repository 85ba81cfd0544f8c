/* Edge pairing: by one pass of chains over the faces where those are near each other in memory, else by ranges. Both
 * give the same result: which sides lie on an edge, in ascending order, does not depend on how they were found.
 *
 * Cost: O(vertices + corners) time, 12 bytes a corner while it runs. */
#include "lib/topology/edge_chain.h"
#include "lib/topology/edge_ranges.h"

/* With more threads than this, ranges are faster for every mesh. */
#define CHAIN_THREADS 2

/* What the pass over the faces carries along. */
typedef struct chain_pairing {
    edge_chains chains;
    mt_index *next_side;
    const mt_index *corner_vertices;
    mt_index regular, misoriented, non_manifold;
} chain_pairing;

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

MT_ALWAYS_INLINE void add_side(chain_pairing *pairing, mt_index tail, mt_index head, mt_index corner)
{
    if (tail == head) {
        pairing->next_side[corner] = MT_NONE;
        return;
    }
    mt_index count = pairing->chains.entry_count;
    mt_index edge = edge_chain_find(&pairing->chains, tail < head ? tail : head, tail < head ? head : tail);
    chain_entry *entry = &pairing->chains.entries[edge];
    if (edge == count) {
        entry->note = corner;
        pairing->next_side[corner] = corner;
    } else {
        extend_ring(pairing, entry->note, tail, corner);
    }
}

MT_ALWAYS_INLINE void add_face(chain_pairing *pairing, const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    mt_index end = mt_mesh_face_end(mesh, face);
    const mt_index *vertices = mesh->corner_vertices;
    if (end - begin == 3) {
        add_side(pairing, vertices[begin], vertices[begin + 1], begin);
        add_side(pairing, vertices[begin + 1], vertices[begin + 2], begin + 1);
        add_side(pairing, vertices[begin + 2], vertices[begin], begin + 2);
        return;
    }
    for (mt_index c = begin; c < end; c++) {
        add_side(pairing, vertices[c], vertices[c + 1 < end ? c + 1 : begin], c);
    }
}

/* False, with the result incomplete, when the chains grew long. A local copy lives in registers, which stores to
 * the lists cannot touch. */
static bool add_faces(chain_pairing *pairing, const mt_mesh *mesh)
{
    chain_pairing local = *pairing;
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    mt_index face = 0;
    for (; face < mesh->face_count && local.chains.steps <= step_limit; face++) {
        add_face(&local, mesh, face);
    }
    *pairing = local;
    return face == mesh->face_count;
}

static mt_status pair_by_chains(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally,
                                bool *done)
{
    chain_pairing pairing = {.next_side = pairs->next_side, .corner_vertices = mesh->corner_vertices};
    mt_status status = mt_edge_chains_init(context, mesh->vertex_count, mesh->corner_count, &pairing.chains);
    if (status == MT_OK) {
        *done = add_faces(&pairing, mesh);
        tally->regular = pairing.regular;
        tally->misoriented = pairing.misoriented;
        tally->non_manifold = pairing.non_manifold;
        tally->boundary = pairing.chains.entry_count - pairing.regular - pairing.misoriented - pairing.non_manifold;
    }
    mt_edge_chains_release(context, &pairing.chains);
    return status;
}

static mt_status find_pairs(mt_context *context, const mt_mesh *mesh, mt_edge_pairs *pairs, edge_tally *tally)
{
    bool done = false;
    if (mt_context_thread_count(context) <= CHAIN_THREADS && mt_edge_chains_suit(mesh)) {
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
