/* Cost: O(corners of the vertices that may be irregular) to find the large rings, then that of each ring. */
#include "lib/algorithms/subdivide_limit_rings.h"

static mt_index next(const mt_subdivide_topology *topology, mt_index corner)
{
    return mt_subdivide_next(topology, corner, topology->face_size);
}

/* The corner counter-clockwise of this one; itself when the boundary lies there. */
static mt_index turn(const mt_subdivide_topology *topology, mt_index corner)
{
    mt_index previous = mt_subdivide_previous(topology, corner, topology->face_size);
    return topology->twins[previous] == previous ? corner : topology->twins[previous];
}

static mt_index ring_size(const mt_subdivide_topology *topology, mt_index start)
{
    mt_index count = 1;
    for (mt_index at = start, after = turn(topology, at); after != start && after != at; count++) {
        at = after;
        after = turn(topology, at);
    }
    return count;
}

/* Finds the large rings; returns the size of the largest. */
static mt_index find_large(const mt_limit_rings *rings, mt_index *large, mt_index *large_count)
{
    const mt_subdivide_topology *topology = rings->topology;
    mt_index largest = MT_LIMIT_SMALL_RING;
    for (mt_index vertex = 0; vertex < rings->irregular_count; vertex++) {
        mt_index start = topology->vertex_corners[vertex];
        mt_index size = start == MT_NONE ? 0 : ring_size(topology, start);
        if (size > MT_LIMIT_SMALL_RING) {
            if (large) {
                large[*large_count] = vertex;
            }
            ++*large_count;
            largest = size > largest ? size : largest;
        }
    }
    return largest;
}

static mt_status allocate_ring(mt_context *context, mt_index face_count, mt_limit_rings *rings)
{
    uint64_t room = (uint64_t)face_count + 1;
    rings->ring.ring.ends = mt_allocate_array(context, room, sizeof(mt_vec3));
    rings->ring.ring.diagonals = mt_allocate_array(context, room, sizeof(mt_vec3));
    rings->ring.spokes = mt_allocate_array(context, room, sizeof *rings->ring.spokes);
    rings->corners = mt_allocate_array(context, room, sizeof(mt_index));
    rings->starts = mt_allocate_array(context, room, sizeof(mt_index));
    bool complete =
        rings->ring.ring.ends && rings->ring.ring.diagonals && rings->ring.spokes && rings->corners && rings->starts;
    return complete ? MT_OK : mt_context_error(context)->status;
}

static mt_status number_edges(mt_context *context, mt_limit_rings *rings)
{
    const mt_subdivide_topology *topology = rings->topology;
    if (rings->sharp->edge_count == 0) {
        return MT_OK;
    }
    rings->edge_slots = mt_allocate_array(context, topology->edge_count, sizeof(mt_index));
    if (!rings->edge_slots) {
        return mt_context_error(context)->status;
    }
    for (mt_index edge = 0; edge < topology->edge_count; edge++) {
        rings->edge_slots[edge] = MT_NONE;
    }
    for (mt_index slot = 0; slot < rings->sharp->edge_count; slot++) {
        rings->edge_slots[mt_subdivide_edge(topology, rings->sharp->edges[slot].side, topology->face_size)] = slot;
    }
    return MT_OK;
}

mt_status mt_limit_rings_create(mt_context *context, mt_limit_rings *rings)
{
    mt_index largest = find_large(rings, NULL, &rings->large_count);
    mt_status status = allocate_ring(context, largest, rings);
    if (status == MT_OK) {
        rings->large = mt_allocate_array(context, rings->large_count, sizeof *rings->large);
        status = rings->large ? number_edges(context, rings) : mt_context_error(context)->status;
    }
    if (status != MT_OK) {
        mt_limit_rings_release(context, rings);
        return status;
    }
    rings->large_count = 0;
    find_large(rings, rings->large, &rings->large_count);
    return MT_OK;
}

void mt_limit_rings_release(mt_context *context, mt_limit_rings *rings)
{
    mt_free(context, rings->edge_slots);
    mt_free(context, rings->large);
    mt_free(context, rings->ring.ring.ends);
    mt_free(context, rings->ring.ring.diagonals);
    mt_free(context, rings->ring.spokes);
    mt_free(context, rings->corners);
    mt_free(context, rings->starts);
    *rings = (mt_limit_rings){0};
}

static mt_vec3 difference(const mt_limit_rings *rings, mt_index corner, mt_vec3 center)
{
    return mt_vec3_subtract(mt_mesh_position(rings->mesh, rings->topology->corner_vertices[corner]), center);
}

bool mt_limit_ring_gather(const mt_limit_rings *rings, mt_index vertex, mt_index room, mt_limit_ring *ring,
                          mt_index *corners)
{
    const mt_subdivide_topology *topology = rings->topology;
    mt_index start = topology->vertex_corners[vertex], corner = start, after = start;
    ring->center = mt_mesh_position(rings->mesh, vertex);
    ring->scale = 1;
    ring->triangles = topology->face_size == 3;
    ring->face_count = 0;
    do {
        if (ring->face_count == room) {
            return false;
        }
        corner = after;
        mt_index end = next(topology, corner);
        ring->ends[ring->face_count] = difference(rings, end, ring->center);
        if (!ring->triangles) {
            ring->diagonals[ring->face_count] = difference(rings, next(topology, end), ring->center);
        }
        if (corners) {
            corners[ring->face_count] = corner;
        }
        ring->face_count++;
        after = turn(topology, corner);
    } while (after != start && after != corner);
    ring->closed = after == start && topology->twins[start] != start;
    if (!ring->closed) {
        ring->ends[ring->face_count] =
            difference(rings, mt_subdivide_previous(topology, corner, topology->face_size), ring->center);
    }
    return true;
}

static mt_limit_spoke spoke_at(const mt_limit_rings *rings, mt_index vertex, mt_index side)
{
    if (rings->topology->twins[side] == side) {
        mt_limit_spoke boundary = {MT_SHARPNESS_INFINITE, MT_SHARPNESS_INFINITE, MT_SHARPNESS_INFINITE};
        return boundary;
    }
    mt_index slot = rings->edge_slots
                        ? rings->edge_slots[mt_subdivide_edge(rings->topology, side, rings->topology->face_size)]
                        : MT_NONE;
    mt_limit_spoke spoke = {0, 0, 0};
    if (slot != MT_NONE) {
        const mt_sharp_edge *edge = &rings->sharp->edges[slot];
        unsigned end = rings->topology->corner_vertices[edge->side] != vertex;
        spoke.sharpness = edge->sharpness;
        spoke.near = rings->halves[2 * slot + end];
        spoke.far = rings->halves[2 * slot + (end ^ 1)];
    }
    return spoke;
}

void mt_limit_rings_gather_sharp(mt_limit_rings *rings, mt_index number)
{
    const mt_subdivide_topology *topology = rings->topology;
    const mt_sharp_vertex *sharp = &rings->sharp->vertices[number];
    mt_index vertex = topology->corner_vertices[sharp->corner];
    mt_limit_ring *ring = &rings->ring.ring;
    mt_limit_ring_gather(rings, vertex, MT_INDEX_MAX, ring, rings->corners);
    rings->ring.sharpness = sharp->sharpness;
    rings->ring.chaikin = rings->sharp->chaikin;
    for (mt_index i = 0; i < ring->face_count; i++) {
        rings->ring.spokes[i] = spoke_at(rings, vertex, rings->corners[i]);
    }
    if (!ring->closed) {
        mt_index last = mt_subdivide_previous(topology, rings->corners[ring->face_count - 1], topology->face_size);
        rings->ring.spokes[ring->face_count] = spoke_at(rings, vertex, last);
    }
}

mt_index mt_limit_rings_part(mt_limit_rings *rings)
{
    const mt_limit_ring *ring = &rings->ring.ring;
    mt_index count = 0;
    for (mt_index i = 0; i < mt_limit_spoke_count(ring); i++) {
        if (rings->ring.spokes[i].sharpness > 0) {
            rings->starts[count++] = i;
        }
    }
    if (count == 0) {
        rings->starts[count++] = 0;
    }
    return ring->closed ? count : count - 1;
}

mt_limit_sector mt_limit_rings_sector(const mt_limit_rings *rings, mt_index number, mt_index sector_count)
{
    const mt_limit_ring *ring = &rings->ring.ring;
    mt_limit_sector sector = {rings->starts[number], 0};
    mt_index end =
        ring->closed && number + 1 == sector_count ? rings->starts[0] + ring->face_count : rings->starts[number + 1];
    sector.face_count = end - sector.first;
    return sector;
}

mt_index mt_limit_rings_extra_sectors(const mt_limit_rings *rings)
{
    const mt_subdivide_sharp *sharp = rings->sharp;
    mt_index extra = 0;
    for (mt_index i = 0; i < sharp->vertex_count; i++) {
        const mt_sharp_vertex *vertex = &sharp->vertices[i];
        mt_index infinite = 0;
        for (mt_index k = vertex->first_spoke; k < vertex[1].first_spoke; k++) {
            infinite += sharp->edges[sharp->spokes[k] >> 1].sharpness >= MT_SHARPNESS_INFINITE;
        }
        extra += vertex->boundary ? infinite : infinite - (infinite > 0);
    }
    return extra;
}
