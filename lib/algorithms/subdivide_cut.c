/* Vertices are numbered as if they had never been cut: copies follow the vertex that they are a copy of within the old
 * ones, and edge points of an edge's later sides those of its first, so that leaving the copies out changes no order.
 * Cost: that of mt_split_non_manifold, then O(shared edges) a level, then O(result). */
#include "lib/algorithms/subdivide_cut.h"

#include "lib/algorithms/subdivide_rule.h"

#include <meshtool/derive.h>

#include <string.h>

void mt_subdivide_cut_release(mt_context *context, mt_subdivide_cut *cut)
{
    mt_mesh_destroy(context, cut->mesh);
    mt_free(context, cut->sources);
    mt_free(context, cut->sides);
    mt_free(context, cut->joins);
    memset(cut, 0, sizeof *cut);
}

static bool add_join(mt_context *context, mt_subdivide_cut *cut, mt_index vertex, mt_index joined)
{
    if (vertex == joined) {
        return true;
    }
    if (cut->join_count == cut->join_room) {
        uint64_t room = cut->join_room ? 2 * cut->join_room : 64;
        void *grown = mt_reallocate(context, cut->joins, room * sizeof *cut->joins);
        if (!grown) {
            return false;
        }
        cut->joins = grown;
        cut->join_room = room;
    }
    cut->joins[cut->join_count][0] = vertex;
    cut->joins[cut->join_count++][1] = joined;
    return true;
}

/* Joins the edge points of each shared edge. */
static bool join_points(mt_context *context, const mt_subdivide_topology *topology, mt_subdivide_cut *cut,
                        mt_index *lowest)
{
    mt_index base = mt_subdivide_first_edge_point(topology);
    for (mt_index edge = 0; edge < cut->edge_count; edge++) {
        lowest[edge] = MT_NONE;
    }
    for (mt_index i = 0; i < cut->side_count; i++) {
        mt_index point = base + mt_subdivide_edge(topology, cut->sides[i].side, topology->face_size);
        mt_index *low = &lowest[cut->sides[i].edge];
        *low = point < *low ? point : *low;
    }
    bool complete = true;
    for (mt_index i = 0; complete && i < cut->side_count; i++) {
        mt_index point = base + mt_subdivide_edge(topology, cut->sides[i].side, topology->face_size);
        complete = add_join(context, cut, point, lowest[cut->sides[i].edge]);
    }
    return complete;
}

mt_status mt_subdivide_cut_refine(mt_context *context, const mt_subdivide_topology *topology, mt_subdivide_cut *cut)
{
    mt_index *lowest = mt_allocate_array(context, cut->edge_count, sizeof *lowest);
    mt_cut_side *halves = mt_allocate_array(context, 2 * (uint64_t)cut->side_count, sizeof *halves);
    bool complete = lowest && halves && join_points(context, topology, cut, lowest);
    mt_free(context, lowest);
    if (!complete) {
        mt_free(context, halves);
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < cut->side_count; i++) {
        const mt_cut_side *old = &cut->sides[i];
        mt_index next = mt_subdivide_next(topology, old->side, topology->face_size);
        mt_index first = 2 * old->edge + old->flipped;
        halves[2 * (size_t)i] = (mt_cut_side){4 * old->side, first, old->flipped};
        halves[2 * (size_t)i + 1] =
            (mt_cut_side){mt_subdivide_child_previous(topology, 4 * next), first ^ 1, old->flipped};
    }
    mt_free(context, cut->sides);
    cut->sides = halves;
    cut->side_count *= 2;
    cut->edge_count *= 2;
    return MT_OK;
}

/* Per vertex its number when the copies are left out; sources of the new ones. Returns their count. */
static mt_index number_joined(const mt_subdivide_cut *cut, mt_index count, mt_index *targets, mt_index *sources)
{
    mt_index copies = cut->mesh->vertex_count;
    for (mt_index vertex = 0; vertex < count; vertex++) {
        targets[vertex] = vertex < copies ? cut->sources[vertex] : vertex;
    }
    for (uint64_t i = 0; i < cut->join_count; i++) {
        targets[cut->joins[i][0]] = cut->joins[i][1];
    }
    mt_index used = 0;
    for (mt_index vertex = 0; vertex < count; vertex++) {
        bool first = targets[vertex] == vertex; /* else a lower one, which has its number already */
        mt_index number = first ? used : targets[targets[vertex]];
        if (first) {
            sources[used++] = vertex;
        }
        targets[vertex] = number;
    }
    return used;
}

mt_status mt_subdivide_cut_join(mt_context *context, const mt_subdivide_cut *cut, mt_mesh **result)
{
    mt_index count = (*result)->vertex_count;
    mt_index *targets = mt_allocate_array(context, count, sizeof *targets);
    mt_index *sources = mt_allocate_array(context, count, sizeof *sources);
    mt_mesh *joined = NULL;
    mt_status status = targets && sources ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        mt_derivation derivation = {.vertex_count = number_joined(cut, count, targets, sources),
                                    .vertex_sources = sources,
                                    .vertex_targets = targets,
                                    .face_count = (*result)->face_count,
                                    .face_size = (*result)->face_size,
                                    .face_offsets = (*result)->face_offsets,
                                    .corner_count = (*result)->corner_count};
        status = mt_mesh_derive(context, *result, &derivation, &joined);
    }
    mt_free(context, targets);
    mt_free(context, sources);
    if (status == MT_OK) {
        mt_mesh_destroy(context, *result);
        *result = joined;
    }
    return status;
}
