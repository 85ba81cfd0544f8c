/* Creases hang in a list at either end. An edge with a new vertex looks for its old one in the shorter of the two
 * lists: on a surface some vertex of each edge has few.
 *
 * Cost: O(vertices + corners) time, nearly; the pairing of edges, 8 bytes a vertex and 8 a crease meanwhile. */
#include "lib/topology/split_creases.h"

#include <meshtool/edge_pairs.h>

#include <string.h>

typedef struct crease_lists {
    const mt_mesh *mesh;
    mt_index *heads;  /* per old vertex 2 * crease + end, MT_NONE: none */
    mt_index *counts; /* per old vertex */
    mt_index *links;  /* per crease and end the next one */
} crease_lists;

static mt_index crease_end(const mt_edge_value *crease, mt_index end)
{
    return end ? crease->b : crease->a;
}

static void hang_creases(crease_lists *lists)
{
    memset(lists->heads, 0xff, lists->mesh->vertex_count * sizeof *lists->heads);
    memset(lists->counts, 0, lists->mesh->vertex_count * sizeof *lists->counts);
    for (mt_index at = 2 * lists->mesh->crease_count; at-- > 0;) {
        mt_index vertex = crease_end(&lists->mesh->creases[at / 2], at % 2);
        lists->links[at] = lists->heads[vertex];
        lists->heads[vertex] = at;
        lists->counts[vertex]++;
    }
}

static const mt_edge_value *find_crease(const crease_lists *lists, mt_index a, mt_index b)
{
    mt_index vertex = lists->counts[a] <= lists->counts[b] ? a : b;
    mt_index other = vertex == a ? b : a;
    mt_index at = lists->heads[vertex];
    while (at != MT_NONE && crease_end(&lists->mesh->creases[at / 2], 1 - at % 2) != other) {
        at = lists->links[at];
    }
    return at == MT_NONE ? NULL : &lists->mesh->creases[at / 2];
}

/* Counts the creases of new edges, and writes them where there is room. */
static mt_index list_new_creases(const crease_lists *lists, const mt_edge_pairs *pairs, const mt_index *sources,
                                 const mt_mesh *split, mt_edge_value *room)
{
    mt_index old_count = lists->mesh->vertex_count, count = 0;
    for (mt_index face = 0; face < split->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(split, face), end = mt_mesh_face_end(split, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index a = split->corner_vertices[corner];
            mt_index b = split->corner_vertices[corner + 1 < end ? corner + 1 : begin];
            if ((a < old_count && b < old_count) || !mt_edge_is_first(pairs, corner)) {
                continue;
            }
            const mt_edge_value *crease = find_crease(lists, sources[a], sources[b]);
            if (crease && room) {
                room[count] = (mt_edge_value){a, b, crease->value};
            }
            count += crease != NULL;
        }
    }
    return count;
}

static mt_status add_creases(mt_context *context, const crease_lists *lists, const mt_edge_pairs *pairs,
                             const mt_index *sources, mt_mesh *split)
{
    uint64_t added = list_new_creases(lists, pairs, sources, split, NULL);
    uint64_t count = added + split->crease_count;
    if (added == 0) {
        return MT_OK;
    }
    if (count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "splitting makes more creases than an index can number");
    }
    mt_edge_value *creases = mt_reallocate(context, split->creases, count * sizeof *creases);
    if (!creases) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    list_new_creases(lists, pairs, sources, split, creases + split->crease_count);
    split->creases = creases;
    split->crease_count = (mt_index)count;
    return MT_OK;
}

static mt_status split_edge_values(mt_context *context, const mt_mesh *mesh, const mt_index *sources, mt_mesh *split)
{
    if (2 * (uint64_t)mesh->crease_count > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%u creases have more ends than an index can number",
                       mesh->crease_count);
    }
    crease_lists lists = {.mesh = mesh};
    mt_edge_pairs *pairs = NULL;
    lists.heads = mt_allocate_array(context, mesh->vertex_count, sizeof *lists.heads);
    lists.counts = mt_allocate_array(context, mesh->vertex_count, sizeof *lists.counts);
    lists.links = mt_allocate_array(context, 2 * (uint64_t)mesh->crease_count, sizeof *lists.links);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (lists.heads && lists.counts && lists.links) {
        hang_creases(&lists);
        status = mt_edge_pairs_create(context, split, &pairs);
    }
    if (status == MT_OK) {
        status = add_creases(context, &lists, pairs, sources, split);
    }
    mt_edge_pairs_destroy(context, pairs);
    mt_free(context, lists.heads);
    mt_free(context, lists.counts);
    mt_free(context, lists.links);
    return status;
}

/* Per old vertex its place in the list of sharp ones. */
static mt_index *list_sharp_vertices(mt_context *context, const mt_mesh *mesh)
{
    mt_index *places = mt_allocate_array(context, mesh->vertex_count, sizeof *places);
    if (places) {
        memset(places, 0xff, mesh->vertex_count * sizeof *places);
        for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
            places[mesh->sharp_vertices[i].vertex] = i;
        }
    }
    return places;
}

static mt_status split_vertex_values(mt_context *context, const mt_mesh *mesh, const mt_index *sources, mt_mesh *split)
{
    uint64_t most = (uint64_t)split->sharp_vertex_count + split->vertex_count - mesh->vertex_count;
    mt_index *places = list_sharp_vertices(context, mesh);
    mt_vertex_value *values =
        places ? mt_reallocate(context, split->sharp_vertices, most * sizeof *split->sharp_vertices) : NULL;
    if (values) {
        split->sharp_vertices = values;
        for (mt_index vertex = mesh->vertex_count; vertex < split->vertex_count; vertex++) {
            mt_index place = places[sources[vertex]];
            if (place != MT_NONE) {
                values[split->sharp_vertex_count++] = (mt_vertex_value){vertex, mesh->sharp_vertices[place].value};
            }
        }
    }
    mt_free(context, places);
    return values ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

mt_status mt_split_creases(mt_context *context, const mt_mesh *mesh, const mt_index *sources, mt_mesh *split)
{
    mt_status status = mesh->crease_count ? split_edge_values(context, mesh, sources, split) : MT_OK;
    if (status == MT_OK && mesh->sharp_vertex_count) {
        status = split_vertex_values(context, mesh, sources, split);
    }
    return status;
}
