/* Edge pairs of the shared triangulation, as a graph of triangles with at most three neighbours. O(vertices + corners).
 * Where an edge has more than two sides, those that run in opposite directions are paired in their order. */
#include "lib/algorithms/strips_graph.h"

#include <meshtool/edge_pairs.h>

#include <string.h>

#define TRIANGLE_BLOCK 16384

typedef struct graph_job {
    const mt_mesh *mesh; /* of triangles */
    const mt_edge_pairs *pairs;
    strip_graph *graph;
    const mt_mesh *source;
} graph_job;

static strip_side side_of_corner(mt_index corner)
{
    return corner / 3 * 4 + corner % 3;
}

static void find_across(void *user, uint64_t begin, uint64_t end)
{
    const graph_job *job = user;
    strip_side *across = job->graph->across;
    for (mt_index t = (mt_index)begin; t < end; t++) {
        for (mt_index s = 0; s < 3; s++) {
            mt_index twin = mt_edge_twin(job->mesh, job->pairs, 3 * t + s);
            across[4 * (size_t)t + s] = twin == MT_NONE || twin / 3 == t ? MT_NONE : side_of_corner(twin);
        }
        across[4 * (size_t)t + 3] = MT_NONE;
    }
}

static bool names_vertex_twice(const mt_index *vertices)
{
    return vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0];
}

/* The sides of one edge that wait for one running the other way form a stack, all in one direction. Its links go
 * through `across` itself, which is free until a side is paired. */
static void pair_sides(const graph_job *job, mt_index first)
{
    strip_side *across = job->graph->across, stack = MT_NONE;
    const mt_index *vertices = job->mesh->corner_vertices;
    mt_index direction = MT_NONE; /* the vertex at which the sides in the stack start */
    mt_index corner = first;
    do {
        strip_side side = side_of_corner(corner);
        if (names_vertex_twice(vertices + corner / 3 * (size_t)3)) {
            /* it would be taken for a swap */
        } else if (stack == MT_NONE || vertices[corner] == direction) {
            across[side] = stack;
            stack = side;
            direction = vertices[corner];
        } else {
            strip_side partner = stack;
            stack = across[partner];
            across[partner] = side;
            across[side] = partner;
        }
        corner = job->pairs->next_side[corner];
    } while (corner != first);
    while (stack != MT_NONE) {
        strip_side below = across[stack];
        across[stack] = MT_NONE;
        stack = below;
    }
}

static void pair_non_manifold(const graph_job *job)
{
    mt_index corner_count = job->pairs->non_manifold_count ? job->pairs->corner_count : 0;
    for (mt_index c = 0; c < corner_count; c++) {
        if (mt_edge_is_first(job->pairs, c) && mt_edge_class_of(job->mesh, job->pairs, c) == MT_EDGE_NON_MANIFOLD) {
            pair_sides(job, c);
        }
    }
}

static void gather_vertices(void *user, uint64_t begin, uint64_t end)
{
    const graph_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        job->graph->own_vertices[i] = job->source->corner_vertices[job->graph->triangulation.corners[i]];
    }
}

static mt_status set_vertices(mt_context *context, const mt_mesh *mesh, strip_graph *graph)
{
    graph->vertices = mesh->corner_vertices;
    if (graph->triangulation.corners) {
        graph->own_vertices = mt_allocate_array(context, 3 * (uint64_t)graph->triangle_count, sizeof(mt_index));
        if (!graph->own_vertices) {
            return mt_context_error(context)->status;
        }
        graph_job job = {.graph = graph, .source = mesh};
        mt_parallel_for(context, 3 * (uint64_t)graph->triangle_count, 3 * TRIANGLE_BLOCK, gather_vertices, &job);
        graph->vertices = graph->own_vertices;
    }
    return MT_OK;
}

static mt_status connect(mt_context *context, strip_graph *graph)
{
    mt_mesh triangles = {.vertex_count = graph->vertex_count,
                         .face_count = graph->triangle_count,
                         .corner_count = 3 * graph->triangle_count,
                         .face_size = 3,
                         .corner_vertices = (mt_index *)(uintptr_t)graph->vertices};
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, &triangles, &pairs);
    graph->across = status == MT_OK ? mt_allocate_array(context, graph->triangle_count, 4 * sizeof(strip_side)) : NULL;
    if (!graph->across) {
        mt_edge_pairs_destroy(context, pairs);
        return mt_context_error(context)->status;
    }
    graph_job job = {.mesh = &triangles, .pairs = pairs, .graph = graph};
    mt_parallel_for(context, graph->triangle_count, TRIANGLE_BLOCK, find_across, &job);
    pair_non_manifold(&job);
    mt_edge_pairs_destroy(context, pairs);
    return MT_OK;
}

mt_status mt_strip_graph_init(mt_context *context, const mt_mesh *mesh, strip_graph *graph)
{
    *graph = (strip_graph){.vertex_count = mesh->vertex_count, .face_count = mesh->face_count};
    mt_status status = mt_triangulation_init(context, mesh, &graph->triangulation);
    graph->triangle_count = graph->triangulation.triangle_count;
    if (status == MT_OK && graph->triangle_count > STRIP_TRIANGLE_MAXIMUM) {
        status = mt_fail(context, MT_ERROR_TOO_LARGE, "strips of %u triangles were asked for, and can be made of %u",
                         graph->triangle_count, STRIP_TRIANGLE_MAXIMUM);
    }
    if (status == MT_OK) {
        status = set_vertices(context, mesh, graph);
    }
    if (status == MT_OK) {
        status = connect(context, graph);
    }
    if (status != MT_OK) {
        mt_strip_graph_release(context, graph);
    }
    return status;
}

void mt_strip_graph_release(mt_context *context, strip_graph *graph)
{
    mt_triangulation_release(context, &graph->triangulation);
    mt_free(context, graph->own_vertices);
    mt_free(context, graph->across);
    *graph = (strip_graph){0};
}
