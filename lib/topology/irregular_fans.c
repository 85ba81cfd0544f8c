/* The link of a vertex has its neighbours as nodes and its faces as arcs between the two that they hold. Faces that
 * share an edge at the vertex share a node, so the fans are the connected sets of arcs, whatever the directions and
 * however many faces an edge has. Corners are dealt to the irregular vertices, then each vertex joins its own.
 *
 * Cost: O(vertices + corners) time, nearly; 4 bytes a vertex and 16 a corner at irregular vertices. */
#include "lib/topology/irregular_fans.h"

#include <string.h>

/* A face at a vertex: the neighbours before and after it, MT_NONE where that is the vertex itself. */
typedef struct link_arc {
    mt_index before, after;
    mt_index face;
    mt_index parent; /* within the vertex's arcs */
} link_arc;

typedef struct fan_joining {
    const mt_mesh *mesh;
    vertex_corners *corners; /* of irregular vertices: first is where their next arc goes, then their last's end */
    uint8_t *fans;
    link_arc *arcs;
    mt_index *node_arc; /* per vertex of the mesh an arc at it, MT_NONE: none at the vertex being joined */
} fan_joining;

static mt_index place_arcs(fan_joining *job)
{
    mt_index at = 0;
    for (mt_index vertex = 0; vertex < job->mesh->vertex_count; vertex++) {
        if (job->fans[vertex] == FANS_IRREGULAR) {
            job->corners[vertex].first = at;
            at += job->corners[vertex].count;
        }
    }
    return at;
}

static void deal_face(fan_joining *job, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(job->mesh, face);
    mt_index sides = mt_mesh_face_sides(job->mesh, face);
    const mt_index *vertices = job->mesh->corner_vertices + begin;
    for (mt_index i = 0; i < sides; i++) {
        mt_index vertex = vertices[i];
        if (job->fans[vertex] == FANS_IRREGULAR) {
            mt_index before = vertices[i ? i - 1 : sides - 1];
            mt_index after = vertices[i + 1 < sides ? i + 1 : 0];
            before = before == vertex ? MT_NONE : before;
            after = after == vertex ? MT_NONE : after;
            job->arcs[job->corners[vertex].first++] = (link_arc){before, after, face, 0};
        }
    }
}

static mt_index find_root(link_arc *arcs, mt_index arc)
{
    while (arcs[arc].parent != arc) {
        arcs[arc].parent = arcs[arcs[arc].parent].parent;
        arc = arcs[arc].parent;
    }
    return arc;
}

/* 1 when that joined two sets, 0 when they were one already. */
static mt_index join_arcs(link_arc *arcs, mt_index a, mt_index b)
{
    mt_index low = find_root(arcs, a);
    mt_index high = find_root(arcs, b);
    if (low == high) {
        return 0;
    }
    arcs[low < high ? high : low].parent = low < high ? low : high;
    return 1;
}

static mt_index join_at_node(fan_joining *job, link_arc *arcs, mt_index node, mt_index arc)
{
    if (node == MT_NONE) {
        return 0;
    }
    if (job->node_arc[node] == MT_NONE) {
        job->node_arc[node] = arc;
        return 0;
    }
    return join_arcs(arcs, job->node_arc[node], arc);
}

static mt_index count_sets(fan_joining *job, link_arc *arcs, mt_index count)
{
    mt_index sets = count;
    for (mt_index i = 0; i < count; i++) {
        arcs[i].parent = i;
        sets -= join_at_node(job, arcs, arcs[i].before, i);
        sets -= join_at_node(job, arcs, arcs[i].after, i);
        if (i && arcs[i].face == arcs[i - 1].face) {
            sets -= join_arcs(arcs, i, i - 1);
        }
    }
    for (mt_index i = 0; i < count; i++) {
        if (arcs[i].before != MT_NONE) {
            job->node_arc[arcs[i].before] = MT_NONE;
        }
        if (arcs[i].after != MT_NONE) {
            job->node_arc[arcs[i].after] = MT_NONE;
        }
    }
    return sets;
}

static void join_vertices(fan_joining *job)
{
    for (mt_index face = 0; face < job->mesh->face_count; face++) {
        deal_face(job, face);
    }
    memset(job->node_arc, 0xff, job->mesh->vertex_count * sizeof *job->node_arc);
    for (mt_index vertex = 0; vertex < job->mesh->vertex_count; vertex++) {
        if (job->fans[vertex] == FANS_IRREGULAR) {
            vertex_corners own = job->corners[vertex];
            mt_index sets = count_sets(job, job->arcs + (own.first - own.count), own.count);
            job->fans[vertex] = sets > 1 ? MT_FANS_SEVERAL : MT_FANS_ONE;
        }
    }
}

mt_status mt_irregular_fans_join(mt_context *context, const mt_mesh *mesh, vertex_corners *corners, uint8_t *fans)
{
    fan_joining job = {.mesh = mesh, .corners = corners, .fans = fans};
    mt_index arc_count = place_arcs(&job);
    job.arcs = mt_allocate_array(context, arc_count, sizeof *job.arcs);
    job.node_arc = mt_allocate_array(context, mesh->vertex_count, sizeof *job.node_arc);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.arcs && job.node_arc) {
        join_vertices(&job);
        status = MT_OK;
    }
    mt_free(context, job.arcs);
    mt_free(context, job.node_arc);
    return status;
}
