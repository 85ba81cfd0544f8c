/* Where all edges are boundary or regular the order of the faces tells most (fan_minima.c). Where it does not, a vertex
 * is walked around from side to side: it has one fan when the walk meets as many corners as name the vertex. Where an
 * irregular edge or a degenerate face touches a vertex a walk has no sense, and its faces are joined by union-find
 * instead (irregular_fans.c).
 *
 * Cost: O(vertices + corners) time. */
#include "lib/topology/fan_minima.h"
#include "lib/topology/irregular_fans.h"

#include <string.h>

#define GRAIN 16384
#define RANGES_MAXIMUM 4 /* threads that look at all corners, each for its own vertices */

typedef struct fan_walk {
    const mt_mesh *mesh;
    const mt_edge_pairs *pairs;
    const mt_index *next_corner; /* within the face; NULL when all faces have the same size */
    vertex_corners *corners;     /* per vertex */
    uint8_t *fans;
    mt_index range_count;
} fan_walk;

static inline mt_index next_in_face(const fan_walk *walk, mt_index corner)
{
    if (walk->next_corner) {
        return walk->next_corner[corner];
    }
    mt_index size = walk->mesh->face_size;
    bool last = size == 3 ? corner % 3 == 2 : corner % size == size - 1;
    return last ? corner - (size - 1) : corner + 1;
}

/* One thread's vertices: how many corners name each, and one of them. */
static void gather_range(const fan_walk *walk, mt_index range)
{
    uint64_t vertex_count = walk->mesh->vertex_count;
    mt_index begin = (mt_index)(vertex_count * range / walk->range_count);
    mt_index count = (mt_index)(vertex_count * (range + 1) / walk->range_count) - begin;
    vertex_corners *corners = walk->corners + begin;
    memset(corners, 0, count * sizeof *corners);
    const mt_index *corner_vertices = walk->mesh->corner_vertices;
    for (mt_index c = 0; c < walk->mesh->corner_count; c++) {
        mt_index vertex = corner_vertices[c] - begin;
        if (vertex < count) {
            corners[vertex].first = c;
            corners[vertex].count++;
        }
    }
}

static void gather_ranges(void *user, uint64_t begin, uint64_t end)
{
    for (uint64_t range = begin; range < end; range++) {
        gather_range(user, (mt_index)range);
    }
}

static void mark_irregular_corner(const fan_walk *walk, mt_index corner)
{
    walk->fans[walk->mesh->corner_vertices[corner]] = FANS_IRREGULAR;
    walk->fans[walk->mesh->corner_vertices[next_in_face(walk, corner)]] = FANS_IRREGULAR;
}

static void mark_irregular(const fan_walk *walk, const uint8_t *degenerate)
{
    const mt_mesh *mesh = walk->mesh;
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_edge_class edge_class = mt_edge_class_of(mesh, walk->pairs, c);
        if (edge_class != MT_EDGE_BOUNDARY && edge_class != MT_EDGE_REGULAR) {
            mark_irregular_corner(walk, c);
        }
    }
    for (mt_index face = 0; degenerate && face < mesh->face_count; face++) {
        if (degenerate[face]) {
            for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
                walk->fans[mesh->corner_vertices[c]] = FANS_IRREGULAR;
            }
        }
    }
}

/* An open fan is walked from the corner where a boundary side arrives. Two of those are two fans. */
static void begin_at_boundary(const fan_walk *walk)
{
    for (mt_index c = 0; c < walk->mesh->corner_count; c++) {
        if (walk->pairs->next_side[c] != c) {
            continue;
        }
        mt_index begin = next_in_face(walk, c);
        mt_index vertex = walk->mesh->corner_vertices[begin];
        uint8_t *fans = &walk->fans[vertex];
        if (*fans == FANS_OPEN) {
            *fans = MT_FANS_SEVERAL;
        } else if (*fans == MT_FANS_NONE) {
            *fans = FANS_OPEN;
            walk->corners[vertex].first = begin;
        }
    }
}

/* Walks that go on at once, since each step must wait for memory. */
#define WALKERS 16

typedef struct walker {
    mt_index corner, first;
    mt_index left; /* corners not met yet, if there is one fan */
    mt_index vertex;
    bool is_short; /* came to an end, or back, before it had met all */
} walker;

static inline bool start_walk(const fan_walk *walk, walker *own, mt_index vertex)
{
    vertex_corners corners = walk->corners[vertex];
    uint8_t fans = walk->fans[vertex];
    if (corners.count == 0 || (fans != MT_FANS_NONE && fans != FANS_OPEN)) {
        return false;
    }
    own->corner = own->first = corners.first;
    own->left = corners.count - 1;
    own->vertex = vertex;
    own->is_short = false;
    return true;
}

static inline void step(const fan_walk *walk, walker *own)
{
    mt_index across = walk->pairs->next_side[own->corner];
    own->is_short |= across == own->corner;
    own->corner = next_in_face(walk, across);
    own->is_short |= own->corner == own->first;
    own->left = own->is_short ? 0 : own->left - 1;
}

static void walk_vertices(void *user, uint64_t begin, uint64_t end)
{
    const fan_walk *walk = user;
    walker walkers[WALKERS];
    unsigned active = 0;
    mt_index vertex = (mt_index)begin;
    while (active || vertex < end) {
        while (active < WALKERS && vertex < end) {
            active += start_walk(walk, &walkers[active], vertex++);
        }
        for (unsigned i = 0; i < active;) {
            if (walkers[i].left) {
                step(walk, &walkers[i]);
                i++;
            } else {
                walk->fans[walkers[i].vertex] = walkers[i].is_short ? MT_FANS_SEVERAL : MT_FANS_ONE;
                walkers[i] = walkers[--active];
            }
        }
    }
}

static bool is_irregular(const mt_edge_pairs *pairs, const uint8_t *degenerate)
{
    return pairs->misoriented_count || pairs->non_manifold_count || pairs->degenerate_side_count || degenerate;
}

static mt_status walk_fans(mt_context *context, fan_walk *walk, const uint8_t *degenerate)
{
    unsigned threads = mt_context_thread_count(context);
    walk->range_count = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM;
    mt_parallel_for(context, walk->range_count, 1, gather_ranges, walk);
    bool irregular = is_irregular(walk->pairs, degenerate);
    if (irregular) {
        mark_irregular(walk, degenerate);
    }
    if (walk->pairs->boundary_count) {
        begin_at_boundary(walk);
    }
    mt_parallel_for(context, walk->mesh->vertex_count, GRAIN, walk_vertices, walk);
    return irregular ? mt_irregular_fans_join(context, walk->mesh, walk->corners, walk->fans) : MT_OK;
}

static mt_index *list_next_corners(mt_context *context, const mt_mesh *mesh)
{
    mt_index *next_corner = mt_allocate_array(context, mesh->corner_count, sizeof *next_corner);
    for (mt_index face = 0; next_corner && face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), last = mt_mesh_face_end(mesh, face) - 1;
        for (mt_index c = begin; c < last; c++) {
            next_corner[c] = c + 1;
        }
        next_corner[last] = begin;
    }
    return next_corner;
}

static mt_status prepare_and_walk(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                  const uint8_t *degenerate, mt_vertex_fans *fans)
{
    mt_index *next_corner = mesh->face_offsets ? list_next_corners(context, mesh) : NULL;
    fan_walk walk = {.mesh = mesh, .pairs = pairs, .next_corner = next_corner, .fans = fans->fans};
    walk.corners = mt_allocate_array(context, mesh->vertex_count, sizeof *walk.corners);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (walk.corners && (next_corner || !mesh->face_offsets)) {
        status = walk_fans(context, &walk, degenerate);
    }
    mt_free(context, walk.corners);
    mt_free(context, next_corner);
    return status;
}

static mt_status find_fans(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                           const uint8_t *degenerate, mt_vertex_fans *fans)
{
    bool done = false;
    if (!is_irregular(pairs, degenerate)) {
        mt_status status = mt_fans_by_minima(context, mesh, pairs, fans->fans, &done);
        if (status != MT_OK || done) {
            return status;
        }
        memset(fans->fans, 0, mesh->vertex_count);
    }
    return prepare_and_walk(context, mesh, pairs, degenerate, fans);
}

mt_status mt_vertex_fans_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                const uint8_t *degenerate, mt_vertex_fans **out)
{
    *out = NULL;
    mt_vertex_fans *fans = mt_allocate_zeroed(context, sizeof *fans);
    if (!fans) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    fans->vertex_count = mesh->vertex_count;
    fans->fans = mt_allocate_zeroed(context, mesh->vertex_count);
    mt_status status = fans->fans ? find_fans(context, mesh, pairs, degenerate, fans) : MT_ERROR_OUT_OF_MEMORY;
    if (status != MT_OK) {
        mt_vertex_fans_destroy(context, fans);
        return status;
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        fans->isolated_count += fans->fans[vertex] == MT_FANS_NONE;
        fans->several_count += fans->fans[vertex] == MT_FANS_SEVERAL;
    }
    *out = fans;
    return MT_OK;
}

void mt_vertex_fans_destroy(mt_context *context, mt_vertex_fans *fans)
{
    if (fans) {
        mt_free(context, fans->fans);
        mt_free(context, fans);
    }
}
