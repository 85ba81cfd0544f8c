/* The corners of a fan hang together across sides; along those each has at most two neighbours. A corner is a minimum
 * when no neighbour lies in an earlier face: when both sides of its face at the vertex are the first of their edges. A
 * fan has at least one minimum, the corner in its first face, so a vertex with one minimum has one fan. In meshes whose
 * faces follow each other over the surface few vertices have more; each of those is walked around once, and has one
 * fan when the walk meets all of its minima.
 *
 * Minima are counted by several threads at once, without locks: the sum tells whether a count was lost, which makes all
 * void. It takes two threads at one vertex at one time.
 *
 * Cost: O(corners) time; 4 bytes for each vertex that may be walked. */
#include "lib/topology/fan_minima.h"

#include <stdatomic.h>

#define GRAIN 16384
#define COUNT_MAXIMUM 255

typedef struct minimum_scan {
    const mt_mesh *mesh;
    const mt_index *next_side;
    uint8_t *counts;    /* per vertex, of minima */
    mt_index *repeated; /* the second minimum of each vertex that has one */
    mt_index room;
    atomic_uint repeated_count; /* past the room: there were more */
    atomic_uint minimum_count;
    atomic_bool failed;
} minimum_scan;

static inline bool is_first(const minimum_scan *scan, mt_index corner)
{
    return scan->next_side[corner] >= corner;
}

static inline void count_minimum(minimum_scan *scan, mt_index corner)
{
    uint8_t *count = &scan->counts[scan->mesh->corner_vertices[corner]];
    uint8_t before = __atomic_load_n(count, __ATOMIC_RELAXED);
    if (before == 1) {
        mt_index at = atomic_fetch_add_explicit(&scan->repeated_count, 1, memory_order_relaxed);
        if (at < scan->room) {
            scan->repeated[at] = corner;
        }
    } else if (before == COUNT_MAXIMUM) {
        atomic_store_explicit(&scan->failed, true, memory_order_relaxed);
        return;
    }
    __atomic_store_n(count, (uint8_t)(before + 1), __ATOMIC_RELAXED);
}

static mt_index scan_triangle(minimum_scan *scan, mt_index begin)
{
    bool first[3] = {is_first(scan, begin), is_first(scan, begin + 1), is_first(scan, begin + 2)};
    if (first[0] + first[1] + first[2] < 2) {
        return 0;
    }
    mt_index count = 0;
    for (mt_index i = 0; i < 3; i++) {
        if (first[i] && first[i ? i - 1 : 2]) {
            count_minimum(scan, begin + i);
            count++;
        }
    }
    return count;
}

static mt_index scan_polygon(minimum_scan *scan, mt_index face)
{
    mt_index count = 0;
    mt_index end = mt_mesh_face_end(scan->mesh, face);
    bool was_first = is_first(scan, end - 1);
    for (mt_index corner = mt_mesh_face_begin(scan->mesh, face); corner < end; corner++) {
        bool first = is_first(scan, corner);
        if (first && was_first) {
            count_minimum(scan, corner);
            count++;
        }
        was_first = first;
    }
    return count;
}

static void scan_faces(void *user, uint64_t begin, uint64_t end)
{
    minimum_scan *scan = user;
    if (atomic_load_explicit(&scan->repeated_count, memory_order_relaxed) > scan->room) {
        return;
    }
    bool triangles = !scan->mesh->face_offsets && scan->mesh->face_size == 3;
    mt_index count = 0;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        count += triangles ? scan_triangle(scan, 3 * face) : scan_polygon(scan, face);
    }
    atomic_fetch_add_explicit(&scan->minimum_count, count, memory_order_relaxed);
}

/* Whether no count was lost. */
static bool counts_are_whole(const minimum_scan *scan)
{
    mt_index sum = 0;
    for (mt_index vertex = 0; vertex < scan->mesh->vertex_count; vertex++) {
        sum += scan->counts[vertex];
    }
    return sum == scan->minimum_count;
}

static mt_index side_after(const mt_mesh *mesh, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    return corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
}

static mt_index side_before(const mt_mesh *mesh, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    return corner > mt_mesh_face_begin(mesh, face) ? corner - 1 : mt_mesh_face_end(mesh, face) - 1;
}

static bool is_minimum(const minimum_scan *scan, mt_index corner)
{
    return is_first(scan, corner) && is_first(scan, side_before(scan->mesh, corner));
}

/* Whether the fan of a minimum has all minima of its vertex. A walk that comes to the boundary goes on from its start
 * the other way. */
static bool fan_has_all(const minimum_scan *scan, mt_index start)
{
    const mt_mesh *mesh = scan->mesh;
    mt_index met = 1;
    mt_index corner = start;
    for (;;) {
        mt_index across = scan->next_side[corner];
        if (across == corner) {
            break;
        }
        corner = side_after(mesh, across);
        if (corner == start) {
            return met == scan->counts[mesh->corner_vertices[start]];
        }
        met += is_minimum(scan, corner);
    }
    mt_index side = side_before(mesh, start);
    while (scan->next_side[side] != side) {
        corner = scan->next_side[side];
        met += is_minimum(scan, corner);
        side = side_before(mesh, corner);
    }
    return met == scan->counts[mesh->corner_vertices[start]];
}

/* Keeps of the listed minima those of vertices with several fans; returns how many. */
static mt_index keep_several(minimum_scan *scan)
{
    mt_index kept = 0;
    for (mt_index i = 0; i < scan->repeated_count; i++) {
        if (!fan_has_all(scan, scan->repeated[i])) {
            scan->repeated[kept++] = scan->repeated[i];
        }
    }
    return kept;
}

static void set_fans(const minimum_scan *scan, mt_index several_count)
{
    uint8_t *fans = scan->counts;
    for (mt_index vertex = 0; vertex < scan->mesh->vertex_count; vertex++) {
        fans[vertex] = fans[vertex] ? MT_FANS_ONE : MT_FANS_NONE;
    }
    for (mt_index i = 0; i < several_count; i++) {
        fans[scan->mesh->corner_vertices[scan->repeated[i]]] = MT_FANS_SEVERAL;
    }
}

mt_status mt_fans_by_minima(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, uint8_t *fans,
                            bool *done)
{
    minimum_scan scan = {.mesh = mesh, .next_side = pairs->next_side, .counts = fans};
    scan.room = mesh->vertex_count / 16 + 64;
    scan.repeated = mt_allocate_array(context, scan.room, sizeof *scan.repeated);
    if (!scan.repeated) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, mesh->face_count, GRAIN, scan_faces, &scan);
    *done = !scan.failed && scan.repeated_count <= scan.room && counts_are_whole(&scan);
    if (*done) {
        set_fans(&scan, keep_several(&scan));
    }
    mt_free(context, scan.repeated);
    return MT_OK;
}
