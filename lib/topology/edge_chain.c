/* The memory of chains, and when they are the right choice. */
#include "lib/topology/edge_chain.h"

#include <string.h>

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

bool mt_edge_chains_suit(const mt_mesh *mesh)
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

mt_status mt_edge_chains_init(mt_context *context, mt_index vertex_count, mt_index edge_room, edge_chains *chains)
{
    *chains = (edge_chains){0};
    chains->heads = mt_allocate_array(context, vertex_count, sizeof *chains->heads);
    chains->entries = mt_allocate_array(context, edge_room, sizeof *chains->entries);
    if (!chains->heads || !chains->entries) {
        return mt_context_error(context)->status;
    }
    memset(chains->heads, 0xff, vertex_count * sizeof *chains->heads);
    return MT_OK;
}

void mt_edge_chains_release(mt_context *context, edge_chains *chains)
{
    mt_free(context, chains->heads);
    mt_free(context, chains->entries);
}
